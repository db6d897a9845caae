#include <cmath>
#include <nlohmann/json.hpp>

#include "report.h"

namespace bumper::doctor {

namespace {

using nlohmann::ordered_json;

ordered_json json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ordered_json json(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json json(const EdgeCount& edges) {
  ordered_json result{{"count", edges.count}};
  if (edges.count > 0) result["longest_at"] = json(edges.place);
  return result;
}

ordered_json json(const MethodResult& method, double speed) {
  return {{"slides", method.slides.size()},
          {"slides_caught", method.caught(speed)},
          {"largest_sudden_loss_m_s", method.worstLoss()},
          {"impacts", method.impacts.size()},
          {"impacts_that_gained_energy", method.gained()},
          {"most_energy_ratio", method.mostEnergy()},
          {"impacts_that_led_through", method.through()},
          {"tunnelling_speed_head_on_m_s", json(method.front.speed)},
          {"tunnelling_speed_sideways_m_s", json(method.side.speed)}};
}

ordered_json wallsJson(const Examination& examination) {
  const WallReport& walls = examination.walls.report;
  ordered_json groups = ordered_json::array();
  for (const DroppedGroup& group : examination.dropped) {
    groups.push_back({{"reason", group.reason},
                      {"triangles", group.triangles},
                      {"largest_at", json(group.place)},
                      {"mesh", group.mesh}});
  }
  return {{"kept", walls.walls},
          {"kept_without_ground", walls.withoutGround},
          {"kept_in_doubt", walls.inDoubt},
          {"dropped_flat", walls.droppedFlat},
          {"dropped_on_guess", walls.droppedOnGuess},
          {"dropped_no_area", walls.droppedDegenerate},
          {"dropped_scenery", walls.droppedScenery},
          {"dropped_repeated", walls.droppedDuplicate + walls.droppedRetriangulated},
          {"dropped_out_of_reach", walls.droppedOverhead + walls.droppedBuried},
          {"groups", groups}};
}

ordered_json featuresJson(const Report& report) {
  constexpr std::size_t most = 1000;
  ordered_json places = ordered_json::array();
  for (const SmallFeature& feature : report.examination.features) {
    if (places.size() == most) break;
    places.push_back({{"at", json(feature.place)},
                      {"size_m", feature.size},
                      {"kind", feature.isGap ? "gap" : "step"}});
  }
  return {{"smallest_m", report.subject.smallestFeature()},
          {"count", report.examination.features.size()},
          {"largest", places}};
}

}  // namespace

std::string jsonOf(const Report& report) {
  const Examination& e = report.examination;
  const Subject& subject = report.subject;
  const VehicleParameters& vehicle = subject.vehicle;
  ordered_json root{{"format", "bumper-doctor"},
                    {"version", 1},
                    {"file", report.file},
                    {"healthy", report.problems.empty()},
                    {"problems", report.problems},
                    {"vehicle",
                     {{"name", report.vehicle},
                      {"mass_kg", vehicle.mass},
                      {"yaw_inertia_kg_m2", vehicle.yawInertia},
                      {"mass_centre_to_front_m", vehicle.massCentreToFront},
                      {"mass_centre_to_rear_m", vehicle.massCentreToRear},
                      {"width_m", vehicle.width},
                      {"mass_centre_height_m", vehicle.massCentreHeight}}},
                    {"step_s", subject.step},
                    {"speed_m_s", subject.speed},
                    {"mesh",
                     {{"triangles", subject.scene.triangles.size()},
                      {"no_area", e.load.droppedDegenerate},
                      {"twice", e.load.droppedDuplicate},
                      {"flipped_edges", json(e.edges.flipped)},
                      {"open_edges", json(e.edges.open)},
                      {"edges_of_three_and_more", json(e.edges.nonManifold)}}},
                    {"walls", wallsJson(e)},
                    {"small_features", featuresJson(report)},
                    {"places", e.places.size()},
                    {"distance_m", e.distance},
                    {"contact_normals",
                     {{"contacts", e.normals.contacts},
                      {"wrong", e.normals.wrong},
                      {"poses", e.normals.poses},
                      {"poses_without_right_one", e.normals.posesWithoutRight}}},
                    {"contact_joints", json(e.joints, subject.speed)},
                    {"bumper", json(e.bumper, subject.speed)}};
  ordered_json checks = ordered_json::array();
  for (const Check& check : report.checks) {
    checks.push_back({{"name", check.name}, {"wrong", check.isProblem}, {"reason", check.reason}});
  }
  root["checks"] = checks;
  ordered_json worst = ordered_json::array();
  for (std::size_t i = 0; i < report.worst.size(); ++i) {
    ordered_json place{{"kind", report.worst[i].kind},
                       {"words", report.worst[i].words},
                       {"at", json(report.worst[i].position)}};
    if (i < report.pictures.size()) place["picture"] = report.pictures[i];
    worst.push_back(std::move(place));
  }
  root["worst_places"] = worst;
  // Names in a file need not be UTF-8.
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace bumper::doctor
