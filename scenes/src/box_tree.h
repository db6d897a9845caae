#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bumper {

/// An upright box, m.
struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

/// Boxes under boxes around four of them each, and so on: which of them are near a place in plan?
/// In single precision, and never too few.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls `visit` with the number of every box for which `enter(squared distance in plan, low,
  /// high)`, the last two its heights, is true, as it is of the boxes around it.
  template <typename Enter, typename Visit>
  void search(const Box& around, const Enter& enter, const Visit& visit) const {
    if (order_.empty()) return;
    const Query query{.lowX = static_cast<float>(around.low.x() - origin_.x()),
                      .lowY = static_cast<float>(around.low.y() - origin_.y()),
                      .highX = static_cast<float>(around.high.x() - origin_.x()),
                      .highY = static_cast<float>(around.high.y() - origin_.y())};
    descend(levels_.size() - 1, 0, query, enter, visit);
  }

 private:
  static constexpr std::size_t arity = 4;
  using Four = Eigen::Array4f;

  struct Query {
    float lowX, lowY, highX, highY;
  };

  /// The boxes of four children; unused ones are infinitely far away. Side by side, so that one
  /// instruction does for all four.
  struct Node {
    Node();
    void put(std::size_t child, const Eigen::Array3f& low, const Eigen::Array3f& high);

    Four lowX, lowY, lowZ, highX, highY, highZ;
  };

  template <typename Enter, typename Visit>
  void descend(std::size_t level, std::size_t number, const Query& query, const Enter& enter,
               const Visit& visit) const {
    const Node& node = levels_[level][number];
    const Four x = (node.lowX - query.highX).max(query.lowX - node.highX).max(0.0F);
    const Four y = (node.lowY - query.highY).max(query.lowY - node.highY).max(0.0F);
    const Four distance2 = x * x + y * y;
    for (Eigen::Index k = 0; k < 4; ++k) {
      if (!enter(distance2[k], node.lowZ[k], node.highZ[k])) continue;
      const std::size_t child = arity * number + static_cast<std::size_t>(k);
      if (level > 0) {
        descend(level - 1, child, query, enter, visit);
      } else {
        visit(order_[child]);
      }
    }
  }

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<std::uint32_t> order_;
  std::vector<std::vector<Node>> levels_;  // the last one has one node
};

}  // namespace bumper
