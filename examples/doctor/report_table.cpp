#include <algorithm>
#include <cstdio>

#include "bumper/base/printing.h"
#include "number_text.h"
#include "report.h"

namespace bumper::doctor {

namespace {

/// One line: what, and a column each for contact joints and Bumper.
void compare(const char* what, const std::string& joints, const std::string& bumper) {
  std::printf("  %-34s %20s %24s\n", what, joints.c_str(), bumper.c_str());
}

void state(const char* what, std::size_t count, const std::string& words = "") {
  std::printf("  %-34s %20zu   %s\n", what, count, printable(words).c_str());
}

std::string of(std::size_t count, std::size_t all) {
  return std::to_string(count) + " of " + std::to_string(all);
}

std::string speedOf(const Tunnelling& tunnelling, double highest) {
  return tunnelling.speed ? "from " + fixed(*tunnelling.speed, 1) + " m/s"
                          : "not to " + fixed(highest, 0) + " m/s";
}

std::string at(const EdgeCount& edges) {
  return edges.count == 0 ? "" : "the longest at " + placeText(edges.place);
}

void printMesh(const Report& report) {
  const Examination& examination = report.examination;
  std::printf("\nThe mesh\n");
  state("triangles", report.subject.scene.triangles.size());
  state("- without area", examination.load.droppedDegenerate);
  state("- there twice", examination.load.droppedDuplicate);
  state("edges beside a flipped triangle", examination.edges.flipped.count,
        at(examination.edges.flipped));
  state("edges of one triangle alone", examination.edges.open.count, at(examination.edges.open));
  state("edges of three and more", examination.edges.nonManifold.count,
        at(examination.edges.nonManifold));
  const auto& features = examination.features;
  const std::string limit = "steps and gaps below " + millimetres(report.subject.smallestFeature());
  state(limit.c_str(), features.size(),
        features.empty() ? ""
                         : "the largest, " + millimetres(features.front().size) + ", at " +
                               placeText(features.front().place));
}

void printWalls(const Report& report) {
  const WallReport& walls = report.examination.walls.report;
  std::printf("\nWhat Bumper takes for walls\n");
  state("walls", walls.walls,
        "from " + fixed(walls.lowestFoot, 1) + " to " + fixed(walls.highestTop, 1) + " m");
  state("- kept without ground nearby", walls.withoutGround);
  state("- kept in doubt", walls.inDoubt);
  state("dropped: too flat", walls.droppedFlat - walls.droppedOnGuess);
  if (walls.droppedDegenerate > 0) state("dropped: no area", walls.droppedDegenerate);
  for (const DroppedGroup& group : report.examination.dropped) {
    state("dropped", group.triangles, group.reason + "; the largest at " + placeText(group.place));
  }
}

void printDrives(const Report& report) {
  const Examination& e = report.examination;
  const double speed = report.subject.speed;
  std::printf("\n%s, %s m of walls driven along\n", counted(e.places.size(), "place").c_str(),
              fixed(e.distance, 0).c_str());
  compare("", "contact joints", "Bumper");
  compare("wrong contact normals (over 10°)",
          fixed(100.0 * e.normals.share(), 1) + " % of " + std::to_string(e.normals.contacts),
          "the faces' own");
  compare("poses without a right normal", of(e.normals.posesWithoutRight, e.normals.poses), "-");
  compare("slides caught", of(e.joints.caught(speed), e.joints.slides.size()),
          of(e.bumper.caught(speed), e.bumper.slides.size()));
  compare("largest loss of speed within 0.1 s", fixed(e.joints.worstLoss(), 2) + " m/s",
          fixed(e.bumper.worstLoss(), 2) + " m/s");
  compare("impacts that gained energy", of(e.joints.gained(), e.joints.impacts.size()),
          of(e.bumper.gained(), e.bumper.impacts.size()));
  compare("most energy after, before = 1", fixed(e.joints.mostEnergy(), 3),
          fixed(e.bumper.mostEnergy(), 3));
  compare("impacts that led through", of(e.joints.through(), e.joints.impacts.size()),
          of(e.bumper.through(), e.bumper.impacts.size()));
  const double highest = searchedSpeeds(report.subject).highest;
  compare("through a wall head-on", speedOf(e.joints.front, highest),
          speedOf(e.bumper.front, highest));
  compare("through a wall sideways", speedOf(e.joints.side, highest),
          speedOf(e.bumper.side, highest));
}

void printWorst(const Report& report) {
  if (report.worst.empty()) return;
  std::printf("\nWorst places\n");
  for (std::size_t i = 0; i < report.worst.size(); ++i) {
    const WorstPlace& worst = report.worst[i];
    std::printf("  %2zu  %s, at %s\n", i + 1, printable(worst.words).c_str(),
                placeText(worst.position).c_str());
    if (i < report.pictures.size())
      std::printf("      %s\n", printable(report.pictures[i]).c_str());
  }
}

void printVerdict(const Report& report) {
  std::printf("\n");
  for (const Check& check : report.checks) {
    const bool isAsked = std::ranges::find(report.problems, check.name) != report.problems.end();
    const char* verdict = isAsked ? "PROBLEM" : check.isProblem ? "note" : "ok";
    std::printf("  %-9.*s %-8s %s\n", static_cast<int>(check.name.size()), check.name.data(),
                verdict, printable(check.reason).c_str());
  }
  if (report.problems.empty()) {
    std::printf("healthy\n");
    return;
  }
  std::string all;
  for (const std::string& problem : report.problems) all += (all.empty() ? "" : ", ") + problem;
  std::printf("problems: %s\n", all.c_str());
}

}  // namespace

void printTable(const Report& report) {
  const VehicleParameters& vehicle = report.subject.vehicle;
  std::printf("%s: a %s of %s x %s m, %s kg, %s kg m², at %s m/s in steps of %s ms\n",
              printable(report.file).c_str(), report.vehicle.c_str(),
              fixed(report.subject.length(), 2).c_str(), fixed(vehicle.width, 2).c_str(),
              fixed(vehicle.mass, 0).c_str(), fixed(vehicle.yawInertia, 0).c_str(),
              fixed(report.subject.speed, 1).c_str(),
              fixed(1000.0 * report.subject.step, 2).c_str());
  printMesh(report);
  printWalls(report);
  printDrives(report);
  printWorst(report);
  printVerdict(report);
}

}  // namespace bumper::doctor
