#include "worst_places.h"

#include <algorithm>

#include "number_text.h"

namespace bumper::doctor {

namespace {

using List = std::vector<WorstPlace>;

/// What stands out at a place, in words; the mesh's edges if nothing does.
std::string featureNear(const Examination& examination, const Eigen::Vector3d& place,
                        double reach) {
  const SmallFeature* nearest = nullptr;
  double distance = reach;
  for (const SmallFeature& feature : examination.features) {
    const double apart = (feature.place - place).head<2>().norm();
    if (apart > distance) continue;
    distance = apart;
    nearest = &feature;
  }
  if (nearest == nullptr) return "at an edge of the mesh";
  return std::string("at a ") + (nearest->isGap ? "gap" : "step") + " of " +
         millimetres(nearest->size);
}

List catches(const Subject& subject, const Examination& examination, const MethodResult& method,
             const std::string& name) {
  std::vector<Slide> slides = method.slides;
  std::erase_if(slides, [&](const Slide& slide) { return !slide.isCaught(subject.speed); });
  std::ranges::stable_sort(slides, {}, [](const Slide& slide) { return -slide.loss.loss; });
  List list;
  for (const Slide& slide : slides) {
    TestDrive drive = slide.drive;
    // The end, with what followed from it.
    drive.steps = std::min(
        drive.steps, slide.loss.step + static_cast<std::size_t>(caughtWithin / subject.step) + 1);
    list.push_back({.kind = "catch",
                    .words = name + ": " + fixed(slide.loss.loss, 1) + " of " +
                             fixed(subject.speed, 1) + " m/s lost " +
                             featureNear(examination, slide.loss.place, 0.25 * subject.length()),
                    .position = slide.loss.place,
                    .drive = drive,
                    .out = drive.plane.axes.col(1)});
  }
  return list;
}

List impactList(const Subject& subject, const MethodResult& method, const std::string& name) {
  std::vector<ImpactTrial> trials = method.impacts;
  std::erase_if(trials, [](const ImpactTrial& t) { return !t.isGained() && !t.isThrough; });
  std::ranges::stable_sort(trials, {}, [](const ImpactTrial& trial) {
    return trial.isThrough ? -1e300 : -trial.energy;
  });
  List list;
  for (const ImpactTrial& trial : trials) {
    list.push_back(
        {.kind = trial.isThrough ? "through" : "energy",
         .words =
             name + (trial.isThrough
                         ? ": through the wall at " + fixed(subject.speed, 1) + " m/s"
                         : ": " + fixed(trial.energy, 2) + " times the energy after an impact at " +
                               fixed(trial.drive.attack / degree, 0) + "°"),
         .position = trial.drive.plane.origin,
         .drive = trial.drive,
         .out = trial.drive.plane.axes.col(1)});
  }
  return list;
}

List tunnellingList(const Subject& subject, const MethodResult& method, const std::string& name) {
  List list;
  for (const Approach approach : {Approach::front, Approach::side}) {
    const Tunnelling& each = approach == Approach::front ? method.front : method.side;
    if (!each.speed || *each.speed > 4.0 * subject.speed) continue;
    list.push_back({.kind = "through",
                    .words = name + ": through the wall from " + fixed(*each.speed, 1) + " m/s" +
                             (approach == Approach::front ? " head-on" : " sideways"),
                    .position = each.drive.plane.origin,
                    .drive = each.drive,
                    .out = each.drive.plane.axes.col(1)});
  }
  return list;
}

List normalList(const Examination& examination) {
  const NormalCount& normals = examination.normals;
  if (normals.worstWrong == 0) return {};
  const DrivingPlane& plane = examination.places[normals.worstPlace].plane;
  return {
      {.kind = "normals",
       .words = "contact joints: " + counted(normals.worstWrong, "wrong normal") + " in one pose",
       .position = plane.origin,
       .drive = normals.worstPose,
       .isStanding = true,
       .out = plane.axes.col(1)}};
}

List droppedList(const Subject& subject, const Examination& examination) {
  List list;
  for (const DroppedGroup& group : examination.dropped) {
    const Scene& scene = subject.scene;
    const Scene::Triangle& triangle = scene.triangles[group.largest];
    const Eigen::Vector3d out = (scene.corner(triangle, 1) - scene.corner(triangle, 0))
                                    .cross(scene.corner(triangle, 2) - scene.corner(triangle, 0));
    list.push_back({.kind = "dropped",
                    .words = "no wall for Bumper: " + counted(group.triangles, "triangle") + ", " +
                             group.reason +
                             (group.mesh.empty() ? "" : "; the largest in '" + group.mesh + "'"),
                    .position = group.place,
                    .triangle = group.largest,
                    .out = out.normalized()});
  }
  std::ranges::stable_sort(list, [](const WorstPlace& a, const WorstPlace& b) {
    return a.words.find("guess") != std::string::npos && b.words.find("guess") == std::string::npos;
  });
  return list;
}

List meshList(const Examination& examination) {
  List list;
  const EdgeCount& flipped = examination.edges.flipped;
  if (flipped.count > 0) {
    list.push_back({.kind = "flipped",
                    .words = counted(flipped.count, "edge") + " beside a flipped triangle",
                    .position = flipped.place});
  }
  return list;
}

List featureList(const Examination& examination) {
  List list;
  for (const SmallFeature& feature : examination.features) {
    list.push_back({.kind = feature.isGap ? "gap" : "step",
                    .words = std::string("a ") + (feature.isGap ? "gap" : "step") + " of " +
                             millimetres(feature.size),
                    .position = feature.place,
                    .out = examination.walls.walls[feature.wall].normal});
  }
  return list;
}

}  // namespace

std::vector<WorstPlace> worstPlaces(const Subject& subject, const Examination& examination,
                                    std::size_t most) {
  const std::vector<List> lists{impactList(subject, examination.bumper, "Bumper"),
                                catches(subject, examination, examination.bumper, "Bumper"),
                                catches(subject, examination, examination.joints, "contact joints"),
                                impactList(subject, examination.joints, "contact joints"),
                                tunnellingList(subject, examination.bumper, "Bumper"),
                                tunnellingList(subject, examination.joints, "contact joints"),
                                droppedList(subject, examination),
                                normalList(examination),
                                meshList(examination),
                                featureList(examination)};
  const double apart = 0.5 * subject.length();
  List worst;
  std::vector<std::size_t> next(lists.size(), 0);
  bool isMore = true;
  while (isMore) {
    isMore = false;
    for (std::size_t i = 0; i < lists.size() && worst.size() < most; ++i) {
      for (; next[i] < lists[i].size(); ++next[i]) {
        const WorstPlace& candidate = lists[i][next[i]];
        const bool isNew = std::ranges::none_of(worst, [&](const WorstPlace& other) {
          return other.kind == candidate.kind &&
                 (other.position - candidate.position).norm() < apart &&
                 other.words.substr(0, 6) == candidate.words.substr(0, 6);
        });
        if (!isNew) continue;
        worst.push_back(candidate);
        ++next[i];
        isMore = true;
        break;
      }
    }
  }
  return worst;
}

}  // namespace bumper::doctor
