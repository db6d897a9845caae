#include "fine_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace bumper {

namespace {

// Faces no larger than this, m, are fine where there are more than so many in a cube of such a
// size, m.
constexpr double largestFine = 0.2;
constexpr double cubeSize = 0.4;
constexpr std::uint32_t crowded = 64;

// Groups are divided until they are no wider and no taller than this, m.
constexpr double narrowest = 0.2;
constexpr double lowest = 0.02;

// Crowds that are so many times as wide, or more, need not end exactly where the band does.
constexpr double wide = 4.0;

// Crowds are doubled in size so often, and then are what a mesh is in all.
constexpr int coarsenings = 8;

// A group counts as a whole if its foot and its top lie closer together, as the vehicle sees it, m.
constexpr double mostLean = 0.02;

std::uint64_t cubeOf(const Eigen::Vector3d& point, const Eigen::Vector3d& zero) {
  constexpr double end = (1 << 20) - 1;
  std::uint64_t number = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double place = std::floor((point[i] - zero[i]) / cubeSize);
    number = number << 21U | static_cast<std::uint64_t>(std::clamp(place, -end, end) + end);
  }
  return number;
}

Eigen::Vector3d middleOf(const Wall& wall) {
  return (wall.corners[0] + wall.corners[1] + wall.corners[2]) / 3.0;
}

Eigen::Vector3d cornerAt(const WallTable& walls, std::uint32_t number) {
  const double* vertex = &walls.vertices()[std::size_t{3} * number];
  return walls.origin() + Eigen::Vector3d(vertex[0], vertex[1], vertex[2]);
}

bool isSmall(const Wall& wall) {
  for (std::size_t k = 0; k < 3; ++k) {
    if ((wall.corners[(k + 1) % 3] - wall.corners[k]).norm() > largestFine) return false;
  }
  return true;
}

}  // namespace

// In the vehicle's frame.
struct FineWalls::View {
  const Envelope& vehicle;
  const VehicleState& state;
  const PlanRectangle& within;
  double coarseness = 1.0;  // of the crowds, in units of the narrowest

  // A group's middle, and how far it goes on each side of it.
  struct Place {
    Eigen::Vector3d middle;
    Eigen::Vector3d half;
  };
  [[nodiscard]] Place placeOf(const Group& group) const {
    const Eigen::Matrix3d inverse = state.axes.transpose();
    return {.middle = inverse * (group.middle - state.massCentre),
            .half = inverse.cwiseAbs() * group.half};
  }
  [[nodiscard]] bool mayMeet(const Place& place) const {
    const Vector2 away = (place.middle.head<2>() - within.middle).cwiseAbs();
    return ((away - within.half).array() <= place.half.head<2>().array()).all() &&
           place.middle.z() - place.half.z() <= vehicle.high() &&
           place.middle.z() + place.half.z() >= vehicle.low();
  }
  // All of it is in the band, and its foot is below its top; or little is not.
  [[nodiscard]] bool isWhole(const Group& group, const Place& place) const {
    const double slack = std::max(coarseness / wide, 1.0);
    if (2.0 * group.half.z() <= slack * lowest) return true;
    const double lean = state.up().head<2>().norm();
    return place.middle.z() - place.half.z() >= vehicle.low() &&
           place.middle.z() + place.half.z() <= vehicle.high() &&
           2.0 * group.half.z() * lean <= slack * mostLean;
  }
};

FineWalls::FineWalls(const WallTable& walls) {
  choose(walls);
  if (isFine_.empty()) return;
  groups_.emplace_back();  // number 0 is none
  std::vector<std::vector<Member>> byMesh;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!isFine_[i]) continue;
    const std::uint32_t mesh = walls.meshOf(i);
    if (mesh >= byMesh.size()) byMesh.resize(mesh + std::size_t{1});
    const Wall wall = walls[i];
    byMesh[mesh].push_back(
        {.wall = static_cast<std::uint32_t>(i),
         .low = wall.corners[0].cwiseMin(wall.corners[1]).cwiseMin(wall.corners[2]),
         .high = wall.corners[0].cwiseMax(wall.corners[1]).cwiseMax(wall.corners[2])});
  }
  for (std::vector<Member>& each : byMesh) {
    if (!each.empty()) roots_.push_back(group(walls, each.data(), each.data() + each.size()));
  }
  groups_.shrink_to_fit();
  // Only the corners that groups name are kept.
  std::unordered_map<std::uint32_t, std::uint32_t> kept;
  for (Group& each : groups_) {
    for (std::uint32_t& corner : each.corners) {
      const auto [entry, isNew] = kept.emplace(corner, static_cast<std::uint32_t>(corners_.size()));
      if (isNew) corners_.push_back(cornerAt(walls, corner));
      corner = entry->second;
    }
  }
  corners_.shrink_to_fit();
}

// Faces stay whole, so that a wall and what makes one face with it go the same way.
void FineWalls::choose(const WallTable& walls) {
  if (walls.size() <= crowded) return;
  std::unordered_map<std::uint64_t, std::uint32_t> counts;
  for (const Wall& wall : walls) {
    if (isSmall(wall)) ++counts[cubeOf(middleOf(wall), walls.origin())];
  }
  for (std::size_t i = 0; i < walls.size();) {
    const WallTable::Stretch face = walls.faceOf(i);
    bool isFine = true;
    for (; isFine && i < face.last; ++i) {
      const Wall wall = walls[i];
      isFine = isSmall(wall) && counts[cubeOf(middleOf(wall), walls.origin())] > crowded;
    }
    i = face.last;
    if (!isFine) continue;
    isFine_.resize(walls.size());
    std::fill(isFine_.begin() + static_cast<std::ptrdiff_t>(face.first),
              isFine_.begin() + static_cast<std::ptrdiff_t>(face.last), true);
  }
}

// In plan first, so that what stands above one another stays together as long as it can.
std::uint32_t FineWalls::group(const WallTable& walls, Member* first, Member* last) {
  const auto number = static_cast<std::uint32_t>(groups_.size());
  groups_.emplace_back();
  Group made{.wall = first->wall};
  Eigen::Vector3d low = first->low;
  Eigen::Vector3d high = first->high;
  Eigen::Vector3d lowestMiddle = first->middle();
  Eigen::Vector3d highestMiddle = lowestMiddle;
  for (const Member* each = first; each != last; ++each) {
    low = low.cwiseMin(each->low);
    high = high.cwiseMax(each->high);
    lowestMiddle = lowestMiddle.cwiseMin(each->middle());
    highestMiddle = highestMiddle.cwiseMax(each->middle());
    made.wall = std::min(made.wall, each->wall);
  }
  made.middle = 0.5 * (low + high);
  made.half = 0.5 * (high - low);
  const Eigen::Vector3d size = high - low;
  const Eigen::Index wider = size.x() > size.y() ? 0 : 1;
  const Eigen::Index axis = size[wider] > narrowest ? wider : 2;
  if (size[axis] > (axis == 2 ? lowest : narrowest)) {
    const double cut = 0.5 * (lowestMiddle[axis] + highestMiddle[axis]);
    Member* middle = std::stable_partition(
        first, last, [&](const Member& each) { return each.middle()[axis] < cut; });
    if (middle != first && middle != last) {
      made.parts = {group(walls, first, middle), group(walls, middle, last)};
    }
  }
  findCorners(walls, {first, last}, made);
  groups_[number] = made;
  return number;
}

void FineWalls::findCorners(const WallTable& walls, std::span<const Member> members,
                            Group& made) const {
  std::array<double, Outside::directions> farthest;
  farthest.fill(-std::numeric_limits<double>::infinity());
  const auto include = [&](std::uint32_t corner) {
    const Eigen::Vector2d place = cornerAt(walls, corner).head<2>();
    for (std::size_t i = 0; i < farthest.size(); ++i) {
      const double distance = Outside::direction(i).dot(place);
      if (distance <= farthest[i]) continue;
      farthest[i] = distance;
      made.corners[i] = corner;
    }
  };
  if (made.hasParts()) {
    for (const std::uint32_t part : made.parts) {
      for (const std::uint32_t corner : groups_[part].corners) include(corner);
    }
    return;
  }
  for (const Member& each : members) {
    for (std::size_t k = 0; k < 3; ++k) {
      include(static_cast<std::uint32_t>(walls.indices()[std::size_t{3} * each.wall + k]));
    }
  }
}

void FineWalls::find(const Envelope& vehicle, const VehicleState& state,
                     const PlanRectangle& within, std::vector<Crowd>& crowds) const {
  View view{.vehicle = vehicle, .state = state, .within = within};
  for (int i = 0; i <= coarsenings; ++i, view.coarseness *= 2.0) {
    crowds.clear();
    const double size =
        i < coarsenings ? view.coarseness * narrowest : std::numeric_limits<double>::infinity();
    const bool areFew = std::all_of(roots_.begin(), roots_.end(), [&](std::uint32_t root) {
      return addCrowds(root, view, size, crowds);
    });
    if (areFew) return;
  }
}

// False if they are too many.
bool FineWalls::addCrowds(std::uint32_t number, const View& view, double size,
                          std::vector<Crowd>& crowds) const {
  const Group& group = groups_[number];
  if (!view.mayMeet(view.placeOf(group))) return true;
  if (2.0 * group.half.head<2>().maxCoeff() > size && group.hasParts()) {
    return addCrowds(group.parts[0], view, size, crowds) &&
           addCrowds(group.parts[1], view, size, crowds);
  }
  if (crowds.size() >= most && size < std::numeric_limits<double>::infinity()) return false;
  crowds.push_back({.wall = static_cast<int>(group.wall), .outside = {}});
  addOutside(group, view, crowds.back());
  return true;
}

// Of what stands out of the band, the parts.
void FineWalls::addOutside(const Group& group, const View& view, Crowd& crowd) const {
  const View::Place place = view.placeOf(group);
  if (!view.mayMeet(place)) return;
  if (group.hasParts() && !view.isWhole(group, place)) {
    for (const std::uint32_t part : group.parts) addOutside(groups_[part], view, crowd);
    return;
  }
  for (const std::uint32_t corner : group.corners) {
    const Eigen::Vector3d away = corners_[corner] - view.state.massCentre;
    crowd.outside.include((view.state.axes.transpose() * away).head<2>(), 0);
  }
}

std::size_t FineWalls::memory() const {
  return groups_.capacity() * sizeof(Group) + corners_.capacity() * sizeof(Eigen::Vector3d) +
         isFine_.capacity() / 8;
}

}  // namespace bumper
