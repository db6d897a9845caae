#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "bumper/scenes/scene.h"
#include "reference_flight.h"
#include "yaw_plane_car.h"

namespace bumper::benchmark {

/// The wall of all cases, askew to the world's axes, and how finely it is meshed.
StraightWall theWall();
/// The numbers of triangles that it is meshed with.
inline constexpr int wallMeshes[] = {2, 1224};
/// As a mesh of one of these. Throws Error for another number.
Scene wallScene(int triangles);

enum class CaseKind {
  plain,       ///< contact at the point of first touch, fixed e and μ: what every peer can do
  driven,      ///< along the car's x axis, anywhere along the wall, past its ends too
  varied,      ///< … with side slip and yaw rate
  flush,       ///< a side parallel to the wall
  near_flush,  ///< … but for 1e-12 to 1e-2 rad
  wall_end,    ///< a corner within 1e-6 to 1 m of the wall's end; much nearer, corner and end touch
               ///< within the law's 1e-9 m, and it does not say whose normal counts
  bare_end     ///< the wall's end meets a side
};
inline constexpr int caseKinds = 7;
const char* nameOf(CaseKind kind);

/// How a case's wall answers.
struct CaseLaw {
  int id = 0;
  ResponseSettings settings{};
  double restitution = 0.0;  ///< where they are fixed
  double friction = 0.0;
};

/// One start that leads to an impact within 0.1 s.
struct ImpactCase {
  CaseKind kind = CaseKind::plain;
  examples::YawPlaneCarDesign car;
  CaseLaw law;
  double steering = 0.0;  ///< rad, with tyres
  PlanarMotion start;
};

/// The cars of the cases: 1500 kg with 2500 kg m², and those of a table like vehicles.csv whose
/// mass and yaw inertia are known. Throws Error if it cannot be read.
std::vector<examples::YawPlaneCarDesign> readCars(const std::filesystem::path& csv);

/// `plain` cases of kind plain, then others of every other kind up to `count`; always the same ones
/// for a seed. Cases of one law stand together. Half of the others have the library's defaults (the
/// paper's curves), half any fixed e, μ and penetration time.
std::vector<ImpactCase> makeCases(const std::vector<examples::YawPlaneCarDesign>& cars,
                                  std::size_t plain, std::size_t count, std::uint64_t seed);

}  // namespace bumper::benchmark
