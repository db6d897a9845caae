#pragma once

#include <ostream>
#include <string>

#include "bumper/response/vehicle_parameters.h"

/// Two vehicles that meet, scanned over heading and offset: neighbours that differ however near
/// they are taken are a jump.
namespace bumper::tests {

inline constexpr VehicleParameters motorcycle{.mass = 250.0,
                                              .yawInertia = 90.0,
                                              .massCentreToFront = 1.1,
                                              .massCentreToRear = 1.1,
                                              .width = 0.8,
                                              .massCentreHeight = 0.5};
inline constexpr VehicleParameters lorry{.mass = 18'000.0,
                                         .yawInertia = 150'000.0,
                                         .massCentreToFront = 4.5,
                                         .massCentreToRear = 5.5,
                                         .width = 2.5,
                                         .massCentreHeight = 1.5};

/// The first drives along x at `speed` at the second, which stands; both may turn.
struct Meeting {
  VehicleParameters first;
  VehicleParameters second;
  double speed = 30.0;
  double firstYaw = 0.0;      ///< when their circles are about to touch, °
  double firstYawRate = 0.0;  ///< rad/s
  double secondYawRate = 0.0;
  double heading = 0.0;  ///< of the second, °
  double offset = 0.0;   ///< of the second, m
  bool whole = true;     ///< or the first impact alone
};

std::ostream& operator<<(std::ostream& out, const Meeting& meeting);

/// A jump counts in °/s or in thousandths of the speed, whichever is more.
struct ScanResult {
  int cells = 0;
  int jumps = 0;
  double worst = 0.0;  ///< jump
  std::string where;

  ScanResult& operator+=(const ScanResult& other) {
    cells += other.cells;
    jumps += other.jumps;
    if (other.worst > worst) {
      worst = other.worst;
      where = other.where;
    }
    return *this;
  }
};

/// Along one of its numbers; jumps of no more than `limit` are none. They are halved down to 1e-9
/// of a degree or metre.
ScanResult scan(Meeting meeting, double Meeting::*number, double from, double to, double by,
                double limit = 1.0);

}  // namespace bumper::tests
