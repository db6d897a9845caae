#include "box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "single_precision.h"

namespace bumper {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// The bits of a number with a gap after each.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 8U) & 0x00FF00FFU;
  bits = (bits | bits << 4U) & 0x0F0F0F0FU;
  bits = (bits | bits << 2U) & 0x33333333U;
  return (bits | bits << 1U) & 0x55555555U;
}

/// Along a curve that visits the quarters of a square one after another (Morton's).
std::vector<std::uint32_t> alongCurve(const std::vector<Eigen::AlignedBox3d>& boxes,
                                      const Eigen::Vector2d& low, double size) {
  const double scale = size > 0.0 ? 65535.0 / size : 0.0;
  std::vector<std::uint32_t> keys(boxes.size());
  std::vector<std::uint32_t> order(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const Eigen::Vector2d place = scale * (0.5 * (boxes[i].min() + boxes[i].max()).head<2>() - low);
    keys[i] = spread(static_cast<std::uint32_t>(place.x())) |
              spread(static_cast<std::uint32_t>(place.y())) << 1U;
    order[i] = i;
  }
  // What is in the same place stays in the order given, which in most scenes is a good one.
  constexpr unsigned digit = 11;
  std::vector<std::uint32_t> sorted(order.size());
  for (unsigned shift = 0; shift < 32; shift += digit) {
    std::array<std::uint32_t, (1U << digit) + 1> begins{};
    const auto digitOf = [&](std::uint32_t i) { return keys[i] >> shift & ((1U << digit) - 1U); };
    for (const std::uint32_t i : order) ++begins[digitOf(i) + 1];
    for (std::size_t k = 1; k < begins.size(); ++k) begins[k] += begins[k - 1];
    for (const std::uint32_t i : order) sorted[begins[digitOf(i)]++] = i;
    order.swap(sorted);
  }
  return order;
}

}  // namespace

BoxTree::Node::Node() {
  for (Four* low : {&lowX, &lowY, &lowZ}) low->setConstant(infinite);
  for (Four* high : {&highX, &highY, &highZ}) high->setConstant(-infinite);
}

void BoxTree::Node::put(std::size_t child, const Eigen::Array3f& low, const Eigen::Array3f& high) {
  const auto k = static_cast<Eigen::Index>(child);
  lowX[k] = low.x();
  lowY[k] = low.y();
  lowZ[k] = low.z();
  highX[k] = high.x();
  highY[k] = high.y();
  highZ[k] = high.z();
}

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes) {
  if (boxes.empty()) return;
  Eigen::AlignedBox3d all;
  for (const Eigen::AlignedBox3d& box : boxes) all.extend(box);
  const Eigen::Vector3d& low = all.min();
  const Eigen::Vector3d& high = all.max();
  const double size = (high - low).head<2>().maxCoeff();
  origin_.head<2>() = 0.5 * (low + high).head<2>();
  // For what both the box and that which it is compared with lose.
  const double around = singlePrecisionRounding * size + 1e-9;
  const double aside =
      singlePrecisionRounding * std::max(std::abs(low.z()), std::abs(high.z())) + 1e-9;
  const Eigen::Vector3d slack(around, around, aside);
  order_ = alongCurve(boxes, low.head<2>(), size);

  std::vector<Node> level((boxes.size() + arity - 1) / arity);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Eigen::AlignedBox3d& box = boxes[order_[i]];
    level[i / arity].put(i % arity, (box.min() - origin_ - slack).cast<float>(),
                         (box.max() - origin_ + slack).cast<float>());
  }
  levels_.push_back(std::move(level));
  while (levels_.back().size() > 1) {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> above((below.size() + arity - 1) / arity);
    for (std::size_t i = 0; i < below.size(); ++i) {
      const Node& node = below[i];
      above[i / arity].put(i % arity,
                           {node.lowX.minCoeff(), node.lowY.minCoeff(), node.lowZ.minCoeff()},
                           {node.highX.maxCoeff(), node.highY.maxCoeff(), node.highZ.maxCoeff()});
    }
    levels_.push_back(std::move(above));
  }
}

}  // namespace bumper
