#pragma once

#include <string>
#include <vector>

#include "bumper/response/vehicle_parameters.h"
#include "bumper/scenes/scene.h"

namespace bumper::benchmark {

/// A scene of the benchmark by its short name.
struct NamedScene {
  std::string name;
  Scene scene;
};

/// The scenes that queries are measured on:
///   S1   the paper's test rail, 612 triangles
///   S2   the walls of the course alone, 1,838
///   S2g  the course, 8,780
///   S3   the course meshed finely, 100,000, of which 20,000 are walls (panels of 1.08 m)
///   S4   and more finely, 1,000,000, of which 40,000 are walls (0.54 m)
/// Throws Error for another name.
NamedScene makeScene(const std::string& name);

/// The course with about so many triangles, at least 1,000. One in five is a wall, until its panels
/// are 0.54 m long at 200,000: the rest is ground.
NamedScene courseOfSize(std::size_t triangles);

/// The walls of a scene alone, by the slope of its triangles; S2 of S2g.
Scene wallsAlone(const Scene& scene);

/// The same triangles as a modeller may have left them: in random order.
Scene shuffled(Scene scene);

/// The same triangles, square by square of 50 m.
Scene regrouped(Scene scene);

/// The vehicle of all queries: 4.4 × 1.8 m, mass centre in the middle, 0.55 m high.
VehicleParameters queryCar();

/// The heights at which it is hit, m above the ground: the same for every scheme.
inline constexpr double bandBottom = 0.3;
inline constexpr double bandTop = 0.75;

/// Size of every step, s.
inline constexpr double stepSize = 0.005;

}  // namespace bumper::benchmark
