#include "bumper/response/angle_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "bumper/response/error.h"

namespace bumper {

AngleCurve AngleCurve::constant(double value) { return cosine(value, value); }

AngleCurve AngleCurve::cosine(double grazing, double headOn) {
  if (!std::isfinite(grazing) || !std::isfinite(headOn)) {
    throw Error("AngleCurve: both end values must be finite");
  }
  AngleCurve curve;
  curve.shape_ = Shape::cosine;
  curve.grazing_ = grazing;
  curve.headOn_ = headOn;
  return curve;
}

AngleCurve AngleCurve::halfCosine(double grazing, double headOn) {
  AngleCurve curve = cosine(grazing, headOn);
  curve.shape_ = Shape::half_cosine;
  return curve;
}

AngleCurve AngleCurve::table(std::vector<std::pair<double, double>> points) {
  if (points.empty()) throw Error("AngleCurve::table: at least one point is needed");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].first) || !std::isfinite(points[i].second)) {
      throw Error("AngleCurve::table: point " + std::to_string(i) + " is not finite");
    }
    if (i > 0 && !(points[i].first > points[i - 1].first)) {
      throw Error("AngleCurve::table: the angle of point " + std::to_string(i) + ", " +
                  std::to_string(points[i].first) + " rad, is not above the one before");
    }
  }
  AngleCurve curve;
  curve.shape_ = Shape::table;
  curve.points_ = std::move(points);
  return curve;
}

double AngleCurve::inTable(double angle) const {
  if (angle <= points_.front().first) return points_.front().second;
  const auto above =
      std::find_if(points_.begin(), points_.end(),
                   [angle](const std::pair<double, double>& p) { return p.first >= angle; });
  if (above == points_.end()) return points_.back().second;
  const auto below = above - 1;
  const double share = (angle - below->first) / (above->first - below->first);
  return below->second + share * (above->second - below->second);
}

double AngleCurve::atCosine(double cosine) const {
  const double weight = shape_ == Shape::cosine ? cosine : cosine * cosine;
  return headOn_ + (grazing_ - headOn_) * weight;
}

double AngleCurve::operator()(double angle) const {
  return shape_ == Shape::table ? inTable(angle) : atCosine(std::cos(angle));
}

double AngleCurve::operator()(const AttackDirection& attack) const {
  if (shape_ == Shape::table) return inTable(attack.angle());
  return grazing_ == headOn_ ? headOn_ : atCosine(attack.cosine());
}

std::pair<double, double> AngleCurve::range() const {
  constexpr double headOn = 0.5 * std::numbers::pi;
  // All shapes are monotonic between these places.
  double low = std::min((*this)(0.0), (*this)(headOn));
  double high = std::max((*this)(0.0), (*this)(headOn));
  for (const auto& [angle, value] : points_) {
    if (angle < 0.0 || angle > headOn) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return {low, high};
}

double AttackDirection::angle() const { return std::atan2(across, along); }

}  // namespace bumper
