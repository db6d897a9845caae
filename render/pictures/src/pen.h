#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "picture.h"

namespace bumper::drawing {

/// Draws over a picture, in pixels: x to the right and y down.
class Pen {
 public:
  using Box = Eigen::AlignedBox2d;

  explicit Pen(Picture& picture) : picture_(picture) {}

  void triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Colour& colour);
  /// From the left colour to the right one.
  void box(const Box& area, const Colour& left, const Colour& right);
  /// A box with rounded corners that hides all text below.
  void panel(const Box& area, double radius, const Colour& colour);
  void disc(const Eigen::Vector2d& centre, double radius, const Colour& colour);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
            const Colour& colour);
  /// In dashes of a length, with gaps as long.
  void dashes(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, double length,
              const Colour& colour);
  /// With a head three times as wide as the shaft and, if wanted, a rim all around.
  void arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
             const Colour& colour, double edge = 0.0);
  /// A line of UTF-8, the upper left corner of its capitals at a place, in units of `scale` pixels.
  void text(const Eigen::Vector2d& place, const std::string& line, double scale,
            const Colour& colour);

 private:
  void add(const Eigen::Vector2d& point, const Colour& colour);
  void rounded(const Box& area, double radius, const Colour& colour);

  Picture& picture_;
};

}  // namespace bumper::drawing
