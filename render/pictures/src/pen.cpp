#include "pen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "text.h"

namespace bumper::drawing {

using Eigen::Vector2d;

void Pen::triangle(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Colour& colour) {
  add(a, colour);
  add(b, colour);
  add(c, colour);
}

void Pen::box(const Box& area, const Colour& left, const Colour& right) {
  const Vector2d& upperLeft = area.min();
  const Vector2d& lowerRight = area.max();
  const Vector2d upperRight(lowerRight.x(), upperLeft.y());
  const Vector2d lowerLeft(upperLeft.x(), lowerRight.y());
  add(upperLeft, left);
  add(upperRight, right);
  add(lowerRight, right);
  add(upperLeft, left);
  add(lowerRight, right);
  add(lowerLeft, left);
}

void Pen::panel(const Box& area, double radius, const Colour& colour) {
  for (TextLine& line : picture_.textLines) {
    const double width = textWidth(line.text) * line.size / emHeight;
    const Box written(Vector2d(line.start.x(), line.start.y() - line.size),
                      Vector2d(line.start.x() + width, line.start.y() + line.size));
    if (written.intersects(area)) line.covered.push_back(area);
  }
  rounded(area, radius, colour);
}

void Pen::rounded(const Box& area, double radius, const Colour& colour) {
  const double r = std::min(radius, 0.5 * area.sizes().minCoeff());
  std::vector<Vector2d> rim;
  const Box inner(Vector2d(area.min().array() + r), Vector2d(area.max().array() - r));
  const std::array<Vector2d, 4> centres = {inner.max(), Vector2d(inner.min().x(), inner.max().y()),
                                           inner.min(), Vector2d(inner.max().x(), inner.min().y())};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    for (int k = 0; k <= 6; ++k) {
      const double angle = (static_cast<double>(corner) + k / 6.0) * std::numbers::pi / 2.0;
      rim.emplace_back(centres[corner] + r * Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  // Two large triangles between two slim ends: slivers across all of a panel are slow to draw.
  const auto at = [&](std::size_t k) { return rim[k % rim.size()]; };
  triangle(at(6), at(7), at(20), colour);
  triangle(at(6), at(20), at(21), colour);
  for (const std::size_t first : {7U, 21U}) {
    for (std::size_t k = first + 1; k < first + 13; ++k)
      triangle(at(first), at(k), at(k + 1), colour);
  }
}

void Pen::disc(const Vector2d& centre, double radius, const Colour& colour) {
  rounded(Box(Vector2d(centre.array() - radius), Vector2d(centre.array() + radius)), radius,
          colour);
}

void Pen::line(const Vector2d& from, const Vector2d& to, double width, const Colour& colour) {
  const Vector2d way = to - from;
  if (way.norm() < 1e-9) return;
  const Vector2d across = 0.5 * width * Vector2d(-way.y(), way.x()).normalized();
  triangle(from - across, to - across, to + across, colour);
  triangle(from - across, to + across, from + across, colour);
}

void Pen::dashes(const Vector2d& from, const Vector2d& to, double width, double length,
                 const Colour& colour) {
  const double far = (to - from).norm();
  const Vector2d along = (to - from) / std::max(far, 1e-9);
  const int count = static_cast<int>(std::ceil(far / (2.0 * length)));
  for (int k = 0; k < count; ++k) {
    const double start = 2.0 * length * k;
    line(from + start * along, from + std::min(far, start + length) * along, width, colour);
  }
}

void Pen::arrow(const Vector2d& from, const Vector2d& to, double width, const Colour& colour,
                double edge) {
  const Vector2d way = to - from;
  const double length = way.norm();
  if (length < 1e-9) return;
  const Vector2d along = way / length;
  const Vector2d across(-along.y(), along.x());
  const double head = std::min(4.5 * width, 0.7 * length);
  const double half = 0.42 * head;
  // The rim of a slim triangle reaches farther at its tip.
  const Vector2d tip = to + edge * (head / half) * along;
  const Vector2d neck = to - head * along;
  const Vector2d corner = (half + 1.9 * edge) * across;
  line(from, neck, width + 2.0 * edge, colour);
  triangle(neck - edge * along + corner, tip, neck - edge * along - corner, colour);
}

void Pen::text(const Vector2d& place, const std::string& line, double scale, const Colour& colour) {
  picture_.textLines.push_back({line,
                                Vector2d(place.x(), std::round(place.y() + scale * capitalHeight)),
                                scale * emHeight,
                                colour,
                                {}});
}

void Pen::add(const Vector2d& point, const Colour& colour) {
  picture_.overlay.push_back(
      {{static_cast<float>(2.0 * point.x() / picture_.width - 1.0),
        static_cast<float>(1.0 - 2.0 * point.y() / picture_.height), 0.0F, 1.0F},
       {colour.x(), colour.y(), colour.z(), colour.w()}});
}

}  // namespace bumper::drawing
