#include "trace_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace bumper::doctor {

SpeedLoss suddenLoss(const DriveTrace& trace, const TestDrive& drive, double step, double within) {
  const auto window = static_cast<std::size_t>(std::max(1.0, std::round(within / step)));
  const std::vector<DriveState>& states = trace.states;
  SpeedLoss worst;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::size_t k = i + 1; k < std::min(states.size(), i + window + 1); ++k) {
      const double loss = states[i].velocity.norm() - states[k].velocity.norm();
      if (loss <= worst.loss) continue;
      worst.loss = loss;
      begin = i;
    }
  }
  if (worst.loss <= 0.0) return worst;
  double steepest = -1.0;
  for (std::size_t i = begin; i + 1 < std::min(states.size(), begin + window + 1); ++i) {
    const double loss = states[i].velocity.norm() - states[i + 1].velocity.norm();
    if (loss <= steepest) continue;
    steepest = loss;
    worst.step = i;
  }
  const DriveState& state = states[worst.step];
  worst.place = state.position;
  // Of the contacts that acted then the one that was most against the motion.
  double most = -1.0;
  for (const DriveContact& contact : trace.contacts) {
    if (contact.step != worst.step) continue;
    const double against = -contact.normal.dot(state.velocity);
    // ODE's own order decides between equal ones: take the foremost.
    const double ahead = (contact.place - state.position)
                             .dot(drive.plane.direction(drive.start.velocity.normalized()));
    const double value = against + 1e-3 * ahead;
    if (most >= 0.0 && value <= most) continue;
    most = std::max(value, 0.0);
    worst.place = contact.place;
  }
  return worst;
}

double mostEnergy(const DriveTrace& trace) {
  if (trace.contacts.empty() || trace.states.front().energy <= 0.0) return 0.0;
  double most = 0.0;
  for (std::size_t i = trace.contacts.front().step + 1; i < trace.states.size(); ++i)
    most = std::max(most, trace.states[i].energy);
  return most / trace.states.front().energy;
}

bool wentThrough(const DriveTrace& trace, const Place& place) {
  std::vector<Vector2> way;
  Eigen::AlignedBox2d box;
  for (const DriveState& state : trace.states) {
    way.emplace_back(place.plane.local(state.position).head<2>());
    box.extend(way.back());
  }
  for (const WallLine& line : place.lines) {
    Eigen::AlignedBox2d ends(line.from);
    ends.extend(line.to);
    if (!box.intersects(ends)) continue;
    const Vector2 along = line.to - line.from;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const Vector2 step = way[i + 1] - way[i];
      const double denominator = cross(step, along);
      if (denominator == 0.0) continue;
      const double onWay = cross(line.from - way[i], along) / denominator;
      const double onLine = cross(line.from - way[i], step) / denominator;
      if (onWay >= 0.0 && onWay <= 1.0 && onLine >= 0.0 && onLine <= 1.0) return true;
    }
  }
  return false;
}

}  // namespace bumper::doctor
