#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bumper/response/outline.h"
#include "bumper/response/segment.h"
#include "outside.h"

namespace bumper {

/// Reduces crowds of small segments, a finely meshed prop, to their outside: walls nearby are
/// compared in pairs, so that a step's time would grow with the square of their number. What is
/// longer than a few decimetres stays as it is.
class CrowdedWalls {
 public:
  /// So many segments are no crowd.
  static constexpr std::size_t most = 128;
  /// More are reduced even where a vehicle was put into them.
  static constexpr std::size_t mostEntered = 512;

  /// Segments of a surface that lie close together become the convex polygon around them, if there
  /// are too many in all: crowds of up to 0.2 m, or twice that and so on up to 1.6 m until there
  /// are not. Its corners are ends of these segments; what stands out of it does so by less than
  /// 2 % of the crowd's size. A side has the id of a segment that ends at it. A crowd that the
  /// outline, in its own frame, was put into stays as it is: its parts lead out each by itself. Not
  /// among more than mostEntered.
  void reduce(std::vector<Segment>& segments, const Outline& outline);

 private:
  /// A square in plan, and what lies in it.
  struct Cell {
    std::uint64_t place;
    std::size_t first;
    std::size_t last;
    std::size_t crowd;                   ///< a cell, which stands for all of the crowd
    std::array<std::int64_t, 4> extent;  ///< of the crowd: left, right, near, far
    bool isEntered;                      ///< the outline was put into the crowd
  };
  struct Member {
    std::uint64_t place;
    std::size_t segment;
  };
  void findCells(const std::vector<Segment>& segments, double size);
  void joinCells();
  [[nodiscard]] std::size_t crowdOf(std::size_t cell) const;
  void join(std::size_t cell, std::uint64_t place);
  void addOutsides(const std::vector<Segment>& segments, const Outline& outline);
  void addOutside(const std::vector<Segment>& segments, const Outside& outside);

  bool keepEntered_ = true;
  std::vector<Member> members_;
  std::vector<Cell> cells_;
  std::vector<Outside> outsides_;  // by cell
  std::vector<Segment> reduced_;
};

}  // namespace bumper
