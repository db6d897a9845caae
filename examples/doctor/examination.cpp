#include "examination.h"

#include <algorithm>

#include "bumper/engine_adapter/vehicle.h"

namespace bumper::doctor {

namespace {

Tunnelling lowestSpeed(const Subject& subject, const std::vector<Place>& places, Approach approach,
                       Rig& rig) {
  Tunnelling lowest;
  for (const Place& place : places) {
    const auto through = tunnellingSpeed(subject, place, approach, rig);
    if (through && (!lowest.speed || through->speed < *lowest.speed))
      lowest = {through->speed, through->drive};
  }
  return lowest;
}

}  // namespace

std::size_t MethodResult::caught(double speed) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(slides, [&](const Slide& slide) { return slide.isCaught(speed); }));
}

double MethodResult::worstLoss() const {
  double worst = 0.0;
  for (const Slide& slide : slides) worst = std::max(worst, slide.loss.loss);
  return worst;
}

std::size_t MethodResult::gained() const {
  return static_cast<std::size_t>(std::ranges::count_if(impacts, &ImpactTrial::isGained));
}

double MethodResult::mostEnergy() const {
  double most = 0.0;
  for (const ImpactTrial& trial : impacts) most = std::max(most, trial.energy);
  return most;
}

std::size_t MethodResult::through() const {
  return static_cast<std::size_t>(std::ranges::count_if(impacts, &ImpactTrial::isThrough));
}

Examination examine(const Subject& subject, const LoadReport& load, std::size_t places,
                    const std::function<void(Stage)>& progress) {
  const auto begin = [&](Stage stage) {
    if (progress) progress(stage);
  };
  validate(subject.vehicle);
  validate(subject.response);
  begin(Stage::mesh);
  Examination result{.load = load};
  BumperRig bumper(subject);
  result.warnings = bumper.warnings();
  result.walls = selectWalls(subject.scene, subject.selection());
  result.edges = examineEdges(subject.scene);
  result.dropped = droppedGroups(subject, result.walls);

  begin(Stage::features);
  const std::vector<Wall>& walls = result.walls.walls;
  const Band band = defaultBand(subject.vehicle);
  result.features = smallFeatures(walls, subject.smallestFeature(), 0.5 * (band.top - band.bottom));

  begin(Stage::places);
  const WallSections sections(walls);
  const Ground ground(subject);
  result.places = choosePlaces(subject, sections, ground, result.features, places);
  JointRig joints(subject, walls);

  begin(Stage::normals);
  result.normals = countNormals(subject, result.places, walls, joints);

  begin(Stage::slides);
  const Slides slides(subject, result.places);
  result.distance = slides.distance();
  result.joints.slides = slides.driven(joints);
  result.bumper.slides = slides.driven(bumper);

  begin(Stage::impacts);
  const Impacts impacts(subject, result.places);
  result.joints.impacts = impacts.driven(joints);
  result.bumper.impacts = impacts.driven(bumper);

  begin(Stage::tunnelling);
  for (const auto& [method, rig] :
       {std::pair<MethodResult*, Rig*>(&result.joints, &joints), {&result.bumper, &bumper}}) {
    method->front = lowestSpeed(subject, result.places, Approach::front, *rig);
    method->side = lowestSpeed(subject, result.places, Approach::side, *rig);
  }
  return result;
}

}  // namespace bumper::doctor
