#include "nearby_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wall_cut.h"

namespace bumper {

namespace {

// How far the region goes beyond the reach, m: on all sides, and ahead by the distance covered in
// this time, s, up to a limit.
constexpr double allAround = 1.0;
constexpr double timeCovered = 0.2;
constexpr double mostCovered = 6.0;

// The section of a wall that leans lies in the rectangle around its part in the band.
constexpr double aroundCorner = 1.4143;

}  // namespace

bool NearbyWalls::covers(const Envelope& vehicle, const VehicleState& state, double reach) const {
  if (!isKnown_) return false;
  const Eigen::Vector3d moved = axes_.transpose() * (state.massCentre - centre_);
  const double turned = vehicle.radius() * (state.axes - axes_).norm();
  const double needed = reach + vehicle.bandHeight() + turned;
  return moved.x() + needed <= margins_.front && -moved.x() + needed <= margins_.rear &&
         std::abs(moved.y()) + needed <= margins_.side &&
         std::abs(moved.z()) + turned <= margins_.height;
}

void NearbyWalls::list(const Envelope& vehicle,
                       const std::vector<std::unique_ptr<Barrier>>& barriers,
                       const VehicleState& state, double reach) {
  centre_ = state.massCentre;
  axes_ = state.axes;
  // A spinning vehicle turns out of the region before it has crossed it.
  const double spin = std::abs(state.yawRate) * 1.5 * vehicle.radius();
  const double time = std::min(timeCovered, allAround / std::max(spin, 1e-9));
  const double way =
      std::clamp(time * state.axes.col(0).dot(state.velocity), -mostCovered, mostCovered);
  const double needed = reach + vehicle.bandHeight() + allAround;
  margins_ = {.front = needed + std::max(way, 0.0),
              .rear = needed + std::max(-way, 0.0),
              .side = needed,
              .height = allAround};
  const double radius =
      vehicle.radius() + std::max(margins_.front, margins_.rear) + margins_.side + margins_.height;
  faces_.clear();
  withFine_.clear();
  surfaces_.clear();
  owners_.clear();
  for (const std::unique_ptr<Barrier>& barrier : barriers) {
    if (barrier->frame().moves() || !barrier->mayComeWithin(centre_, radius)) continue;
    listWalls(*barrier, vehicle, state, margins_);
  }
  standingFine_ = withFine_.size();
  standingFaces_ = faces_.size();
  standingSurfaces_ = surfaces_.size();
  isKnown_ = true;
}

// Of those that move the walls within reach, as they are now.
void NearbyWalls::listMoving(const Envelope& vehicle, std::span<Barrier* const> moving,
                             const VehicleState& state, double reach) {
  const double needed = reach + vehicle.bandHeight();
  const WallQuery::Margins margins{
      .front = needed, .rear = needed, .side = needed, .height = allAround};
  for (const Barrier* barrier : moving) {
    const VehicleState seen = barrier->frame().toFrame(state);
    if (!barrier->mayComeWithin(seen.massCentre, vehicle.radius() + 2.0 * needed + allAround)) {
      continue;
    }
    const std::size_t first = surfaces_.size();
    listWalls(*barrier, vehicle, seen, margins);
    const PlanarMotion motion = barrier->frame().inYawPlane(state);
    for (std::size_t i = first; i < surfaces_.size(); ++i) {
      surfaces_[i].moves = true;
      surfaces_[i].motion = motion;
    }
  }
}

// The faces of a barrier's walls around a vehicle, which its frame sees so.
void NearbyWalls::listWalls(const Barrier& barrier, const Envelope& vehicle,
                            const VehicleState& state, const WallQuery::Margins& margins) {
  if (barrier.mesh() != nullptr) {
    listFaces(barrier, query_.list(*barrier.mesh(), vehicle, state, margins));
    const FineWalls& fine = barrier.mesh()->fineWalls();
    if (fine.isEmpty()) return;
    withFine_.push_back(&barrier);
    fine.forEachMesh([&](int wall) { surfaceNumber(barrier, wall); });
    return;
  }
  faces_.push_back({.barrier = &barrier,
                    .centre = state.massCentre,
                    .radius = std::numeric_limits<double>::infinity(),
                    .surface = surfaceNumber(barrier, 0)});
}

// The local number of a barrier wall's surface.
int NearbyWalls::surfaceNumber(const Barrier& barrier, int wall) {
  const Owner owner{.barrier = barrier.id(), .settings = barrier.settingsNumberOf(wall)};
  const auto known = std::find(owners_.begin(), owners_.end(), owner);
  if (known == owners_.end()) {
    owners_.push_back(owner);
    surfaces_.push_back({.settings = &barrier.settings(owner.settings)});
    return static_cast<int>(owners_.size()) - 1;
  }
  return static_cast<int>(known - owners_.begin());
}

// The faces that walls belong to, which come in order.
void NearbyWalls::listFaces(const Barrier& barrier, std::span<const int> walls) {
  const WallTable& table = barrier.mesh()->walls();
  std::size_t done = 0;
  for (const int number : walls) {
    const auto wall = static_cast<std::size_t>(number);
    if (wall < done) continue;
    Near near{.barrier = &barrier, .walls = table.faceOf(wall)};
    near.face = table.face(near.walls);
    near.surface = surfaceNumber(barrier, number);
    Eigen::Vector3d low = near.face.corners().front();
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& corner : near.face.corners()) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    near.centre = 0.5 * (low + high);
    near.radius = aroundCorner * 0.5 * (high - low).norm();
    faces_.push_back(near);
    done = near.walls.last;
  }
}

// Whether a face may be in a rectangle of the yaw plane, over the band.
bool NearbyWalls::mayMeet(const Near& near, const Envelope& vehicle, const VehicleState& state,
                          const PlanRectangle& around) {
  const Eigen::Vector3d away = near.centre - state.massCentre;
  const double x = state.axes.col(0).dot(away) - around.middle.x();
  const double y = state.axes.col(1).dot(away) - around.middle.y();
  if (std::abs(x) > around.half.x() + near.radius) return false;
  if (std::abs(y) > around.half.y() + near.radius) return false;
  if (near.face.corners().empty()) return true;
  // All of the rectangle on one side of the face's plane? Twice the band's height: a leaning face
  // projects from its line.
  const Eigen::Vector3d& normal = near.face.normal();
  const double normalX = state.axes.col(0).dot(normal);
  const double normalY = state.axes.col(1).dot(normal);
  const double normalZ = state.axes.col(2).dot(normal);
  const double offset = normal.dot(near.face.corners().front() - state.massCentre) -
                        normalX * around.middle.x() - normalY * around.middle.y() -
                        normalZ * vehicle.middleHeight();
  const double half = std::abs(normalX) * around.half.x() + std::abs(normalY) * around.half.y() +
                      std::abs(normalZ) * 2.0 * vehicle.bandHeight();
  return std::abs(offset) <= half + 2.0 * touchTolerance;
}

std::optional<Segment> NearbyWalls::pieceOf(const Near& near, const Envelope& vehicle,
                                            const VehicleState& state, double reach) {
  const Barrier& barrier = *near.barrier;
  const PrimitiveWall* primitive = barrier.primitive();
  std::optional<Segment> piece = primitive != nullptr ? primitive->cut(state, vehicle, reach)
                                                      : cutFace(near.face, state, vehicle);
  if (!piece) return piece;
  if (primitive == nullptr) piece->solid = barrier.mesh()->isSolid();
  piece->surface = near.surface;
  return piece;
}

void NearbyWalls::addFineWalls(const Envelope& vehicle, const VehicleState& state,
                               const PlanRectangle& within) {
  for (const Barrier* barrier : withFine_) {
    const BarrierFrame& frame = barrier->frame();
    const VehicleState seen = frame.moves() ? frame.toFrame(state) : state;
    const WallTable& table = barrier->mesh()->walls();
    barrier->mesh()->fineWalls().find(vehicle, seen, within, fine_);
    for (const FineWalls::Crowd& crowd : fine_) {
      Segment side;
      side.id = static_cast<int>(faces_.size());
      side.surface = surfaceNumber(*barrier, crowd.wall);
      faces_.push_back({.barrier = barrier,
                        .walls = table.faceOf(static_cast<std::size_t>(crowd.wall)),
                        .surface = side.surface});
      crowd.outside.forEachSide(
          [&](const Outside::Extreme& from, const Outside::Extreme& to, const Vector2& normal) {
            side.start = from.point;
            side.end = to.point;
            side.normal = normal;
            segments_.push_back(side);
          });
    }
  }
}

void NearbyWalls::collect(const Envelope& vehicle, const BarrierList& barriers,
                          const VehicleState& state, const Question& question) {
  if (!covers(vehicle, state, question.reach)) list(vehicle, barriers.all, state, question.reach);
  faces_.resize(standingFaces_);
  withFine_.resize(standingFine_);
  surfaces_.resize(standingSurfaces_);
  owners_.resize(standingSurfaces_);
  if (!barriers.moving.empty()) listMoving(vehicle, barriers.moving, state, question.reach);
  listedSurfaces_ = surfaces_.size();
  segments_.clear();
  listedFaces_ = faces_.size();
  const PlanRectangle within = vehicle.outline().enlarged(question.reach);
  if (!withFine_.empty()) addFineWalls(vehicle, state, within);
  VehicleState fromMoving;
  const auto seenFrom = [&](const Near& near) -> const VehicleState& {
    const BarrierFrame& frame = near.barrier->frame();
    if (!frame.moves()) return state;
    fromMoving = frame.toFrame(state);
    return fromMoving;
  };
  if (segments_.empty() && !question.evenIfNoneIsThere && !wasThere_) {
    const auto mayBeThere = [&](const Near& each) {
      return mayMeet(each, vehicle, seenFrom(each), question.around);
    };
    if (std::none_of(faces_.begin(), faces_.end(), mayBeThere)) return;
  }
  const auto meets = [](PlanRectangle rectangle, const Segment& piece) {
    rectangle.half.array() += piece.radius;
    return !rectangle.misses(piece.start, piece.end);
  };
  wasThere_ = std::any_of(segments_.begin(), segments_.end(),
                          [&](const Segment& piece) { return meets(question.around, piece); });
  for (std::size_t i = 0; i < listedFaces_; ++i) {
    const VehicleState& seen = seenFrom(faces_[i]);
    if (!mayMeet(faces_[i], vehicle, seen, within)) continue;
    const std::optional<Segment> piece = pieceOf(faces_[i], vehicle, seen, question.reach);
    if (!piece || !meets(within, *piece)) continue;
    wasThere_ = wasThere_ || meets(question.around, *piece);
    segments_.push_back(*piece);
    segments_.back().id = static_cast<int>(i);
  }
  if (!wasThere_ && !question.evenIfNoneIsThere) segments_.clear();
  crowds_.reduce(segments_, vehicle.outline());
}

}  // namespace bumper
