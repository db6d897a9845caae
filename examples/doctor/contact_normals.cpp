#include "contact_normals.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bumper::doctor {

namespace {

constexpr std::array<double, 5> poseAngles{2.0, 10.0, 30.0, 60.0, 90.0};
constexpr double sameFace = 0.966;  // cos 15°

}  // namespace

Eigen::Vector3d trueNormal(const Wall& wall, const Eigen::Vector3d& inside) {
  return wall.normal.dot(inside - wall.corners[0]) < 0.0 ? Eigen::Vector3d(-wall.normal)
                                                         : wall.normal;
}

bool isOfWall(const Eigen::Vector3d& trueNormal, const DrivingPlane& plane) {
  return trueNormal.dot(plane.axes.col(1)) > sameFace;
}

NormalCount countNormals(const Subject& subject, std::span<const Place> places,
                         const std::vector<Wall>& walls, JointRig& rig) {
  NormalCount count;
  const VehicleParameters& vehicle = subject.vehicle;
  const Vector2 corner(vehicle.massCentreToFront, -0.5 * vehicle.width);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    for (const double angle : poseAngles) {
      const double yaw = -angle * degree;
      const double depth =
          std::max(5e-4 * subject.length(), 0.5 * subject.speed * subject.step * std::sin(-yaw));
      // Only in front of the wall: the place is at the middle of a front that is flush.
      const Vector2 front = angle < 90.0 ? corner : Vector2(vehicle.massCentreToFront, 0.0);
      TestDrive pose{.plane = place.plane, .start = {.yaw = yaw}};
      pose.start.position = Vector2(0.0, -depth) - rotated(front, yaw);
      const Eigen::Vector3d inside = place.plane.world(pose.start.position);
      std::size_t judged = 0;
      std::size_t wrong = 0;
      for (const DriveContact& contact : rig.contactsAt(pose)) {
        if (contact.wall < 0) continue;
        const Eigen::Vector3d right =
            trueNormal(walls[static_cast<std::size_t>(contact.wall)], inside);
        if (!isOfWall(right, place.plane)) continue;
        ++judged;
        if (right.dot(contact.normal) < std::cos(wrongNormal)) ++wrong;
      }
      if (judged == 0) continue;
      ++count.poses;
      count.contacts += judged;
      count.wrong += wrong;
      if (wrong == judged) ++count.posesWithoutRight;
      if (wrong <= count.worstWrong) continue;
      count.worstWrong = wrong;
      count.worstPlace = i;
      count.worstPose = pose;
    }
  }
  return count;
}

}  // namespace bumper::doctor
