#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "places.h"
#include "rig.h"
#include "trace_measures.h"

namespace bumper::doctor {

/// A vehicle that slides along a wall is caught if it loses more than this share of its speed …
inline constexpr double caughtShare = 0.2;
/// … within this time, s. The paths that are driven bend by less than 10° at a time and have
/// nothing in the way that is larger than the smallest feature: hitting such a bend takes a tenth.
inline constexpr double caughtWithin = 0.1;

struct Slide {
  std::size_t place = 0;  ///< index
  TestDrive drive{};
  SpeedLoss loss{};
  [[nodiscard]] bool isCaught(double speed) const { return loss.loss > caughtShare * speed; }
};

/// Drives along the walls of all places, both ways where there is room: starting at 3° to the wall,
/// then pressed against it with three tenths of the weight.
class Slides {
 public:
  Slides(const Subject& subject, std::span<const Place> places);

  /// One slide after the other, by one method.
  std::vector<Slide> driven(Rig& rig) const;

  [[nodiscard]] std::size_t count() const { return drives_.size(); }
  /// Of the walls driven along, m.
  [[nodiscard]] double distance() const { return distance_; }

 private:
  void add(std::size_t index, bool isBackwards);
  /// Cuts off what followed after the vehicle left the room beside the wall: what it hits there is
  /// in its way.
  void keepBeside(DriveTrace& trace, const Place& place) const;

  const Subject& subject_;
  std::span<const Place> places_;
  std::vector<Slide> drives_;
  double distance_ = 0.0;
};

}  // namespace bumper::doctor
