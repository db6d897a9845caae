#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "sheet.h"

namespace bumper {

namespace {

using Eigen::Vector2d;

constexpr double courseLength = 5400.0;
constexpr double wallHeight = 1.0;
constexpr double wallToCentre = 7.0;
constexpr double groundToCentre = 12.0;
constexpr double roadToCentre = 5.0;

/// Control points of a closed uniform cubic B-spline: its curvature is continuous. In turn: the
/// straight, first corner, the esses, the back straight with its chicane, the long right-hander,
/// the boot, and the last left and right.
constexpr std::array<std::array<double, 2>, 32> controlPoints{
    {{-250, 0},     {0, 0},        {250, 0},      {430, -10},    {510, -110},   {490, -250},
     {350, -330},   {310, -440},   {210, -520},   {-50, -560},   {-310, -600},  {-570, -640},
     {-830, -680},  {-970, -650},  {-1050, -740}, {-1210, -760}, {-1330, -650}, {-1310, -500},
     {-1150, -440}, {-1070, -340}, {-1150, -220}, {-1330, -160}, {-1530, -120}, {-1610, -10},
     {-1510, 90},   {-1330, 80},   {-1150, 20},   {-990, -60},   {-850, -180},  {-710, -200},
     {-630, -90},   {-450, -10}}};

struct Station {
  Vector2d position;
  Vector2d left;  ///< unit, across the course
};

/// A station by its place on the spline, before the course is scaled to its length: span and
/// parameter in [0, 1] within it.
Station splineStation(std::size_t span, double u) {
  const double v = 1.0 - u;
  const std::array<double, 4> weights{v * v * v, 3 * u * u * u - 6 * u * u + 4,
                                      3 * v * v * v - 6 * v * v + 4, u * u * u};
  const std::array<double, 4> slopes{-v * v, 3 * u * u - 4 * u, -3 * v * v + 4 * v, u * u};
  Vector2d position = Vector2d::Zero();
  Vector2d tangent = Vector2d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& point = controlPoints.at((span + k) % controlPoints.size());
    position += weights.at(k) / 6.0 * Vector2d(point[0], point[1]);
    tangent += slopes.at(k) / 2.0 * Vector2d(point[0], point[1]);
  }
  tangent.normalize();
  return {position, {-tangent.y(), tangent.x()}};
}

/// Stations at equal distances along the course, the first at the origin.
std::vector<Station> stations(std::size_t count) {
  // The spline is measured in chords short enough (0.3 m) that they are its length to a millimetre.
  constexpr std::size_t chordsPerSpan = 512;
  constexpr std::size_t chords = chordsPerSpan * controlPoints.size();
  std::vector<double> lengths{0.0};
  lengths.reserve(chords + 1);
  const Vector2d start = splineStation(0, 0.0).position;
  Vector2d previous = start;
  for (std::size_t i = 1; i <= chords; ++i) {
    const double u = static_cast<double>(i % chordsPerSpan) / chordsPerSpan;
    const Vector2d next = splineStation(i / chordsPerSpan, u).position;
    lengths.push_back(lengths.back() + (next - previous).norm());
    previous = next;
  }
  std::vector<Station> result;
  result.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double way = lengths.back() * static_cast<double>(i) / static_cast<double>(count);
    const auto after = std::upper_bound(lengths.begin(), lengths.end(), way);
    const auto chord = static_cast<std::size_t>(after - lengths.begin()) - 1;
    const double part = (way - lengths[chord]) / (lengths[chord + 1] - lengths[chord]);
    const double u = (static_cast<double>(chord % chordsPerSpan) + part) / chordsPerSpan;
    Station station = splineStation(chord / chordsPerSpan, u);
    station.position = (station.position - start) * (courseLength / lengths.back());
    result.push_back(station);
  }
  return result;
}

Eigen::Vector3d beside(const Station& station, double left, double height) {
  const Vector2d place = station.position + left * station.left;
  return {place.x(), place.y(), height};
}

/// A wall `left` of the centre line that faces it.
void addWall(Scene& scene, std::uint32_t mesh, double left, std::size_t panels) {
  Sheet sheet{{}, 2, true, {mesh}};
  const bool facesLeft = left < 0.0;
  for (const Station& station : stations(panels)) {
    sheet.points.push_back(beside(station, left, facesLeft ? 0.0 : wallHeight));
    sheet.points.push_back(beside(station, left, facesLeft ? wallHeight : 0.0));
  }
  addSheet(scene, sheet);
}

void addGround(Scene& scene, std::size_t along, std::size_t across) {
  const std::uint32_t road = addMesh(scene, "road", "asphalt", {0.35F, 0.36F, 0.38F});
  const std::uint32_t verge = addMesh(scene, "verge", "grass", {0.42F, 0.55F, 0.30F});
  const double width = 2.0 * groundToCentre / static_cast<double>(across);
  Sheet sheet{{}, across + 1, true, {}};
  for (std::size_t k = 0; k < across; ++k) {
    const double middle = groundToCentre - width * (static_cast<double>(k) + 0.5);
    sheet.meshes.push_back(std::abs(middle) < roadToCentre ? road : verge);
  }
  for (const Station& station : stations(along)) {
    for (std::size_t k = 0; k <= across; ++k) {
      sheet.points.push_back(beside(station, groundToCentre - width * static_cast<double>(k), 0.0));
    }
  }
  addSheet(scene, sheet);
}

void requireAtLeast(std::size_t least, std::size_t value, const char* name) {
  if (value >= least) return;
  throw Error(std::string(name) + " is " + std::to_string(value) + ": at least " +
              std::to_string(least) + " are needed");
}

}  // namespace

Scene course(const CourseMesh& mesh) {
  requireAtLeast(50, mesh.innerPanels, "CourseMesh::innerPanels");
  requireAtLeast(50, mesh.outerPanels, "CourseMesh::outerPanels");
  requireAtLeast(50, mesh.groundAlong, "CourseMesh::groundAlong");
  requireAtLeast(1, mesh.groundAcross, "CourseMesh::groundAcross");
  Scene scene;
  scene.name = "course";
  const Eigen::Vector3f concrete(0.76F, 0.74F, 0.69F);
  // Clockwise: the inside is on the right.
  addWall(scene, addMesh(scene, "inner_wall", "concrete", concrete), -wallToCentre,
          mesh.innerPanels);
  addWall(scene, addMesh(scene, "outer_wall", "concrete", concrete), wallToCentre,
          mesh.outerPanels);
  addGround(scene, mesh.groundAlong, mesh.groundAcross);
  return scene;
}

std::vector<Vector2d> courseCentreLine(std::size_t points) {
  requireAtLeast(3, points, "courseCentreLine: points");
  std::vector<Vector2d> line;
  line.reserve(points);
  for (const Station& station : stations(points)) line.push_back(station.position);
  return line;
}

}  // namespace bumper
