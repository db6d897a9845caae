#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bumper {

/// Boxes that searches visit, on average for each triangle: bounds the time that meshes take whose
/// triangles lie one upon another.
inline constexpr std::size_t maxVisits = 256;

/// Hierarchy of bounding boxes, four children to a node: finds the boxes near another. In single
/// precision, rounded outward: it misses none.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  /// Calls `visit` with the number of each box that is no further than `reach`, m, from `other` in
  /// plan, and overlaps it in height, if `enter(squared distance in plan, low, high)`, the last two
  /// its heights, is true of it and of the boxes around it.
  template <typename Enter, typename Visit>
  void search(const Eigen::AlignedBox3d& other, double reach, const Enter& enter,
              const Visit& visit) const {
    if (order_.empty()) return;
    const Query query{.low = (other.min() - origin_).cast<float>(),
                      .high = (other.max() - origin_).cast<float>(),
                      .reach2 = static_cast<float>(reach * reach)};
    descend(levels_.size() - 1, 0, query, enter, visit);
  }

 private:
  static constexpr std::size_t arity = 4;
  using Four = Eigen::Array4f;

  struct Query {
    Eigen::Vector3f low;
    Eigen::Vector3f high;
    float reach2;
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
    const Four x = (node.lowX - query.high.x()).max(query.low.x() - node.highX).max(0.0F);
    const Four y = (node.lowY - query.high.y()).max(query.low.y() - node.highY).max(0.0F);
    const Four distance2 = x * x + y * y;
    const Four excess =
        (distance2 - query.reach2).max(node.lowZ - query.high.z()).max(query.low.z() - node.highZ);
    if (excess.minCoeff() > 0.0F) return;
    for (Eigen::Index k = 0; k < 4; ++k) {
      const auto at = [k](const Four& values) { return static_cast<double>(values[k]); };
      if (excess[k] > 0.0F || !enter(at(distance2), at(node.lowZ), at(node.highZ))) continue;
      const std::size_t child = arity * number + static_cast<std::size_t>(k);
      if (level > 0) {
        descend(level - 1, child, query, enter, visit);
      } else {
        visit(order_[child]);
      }
    }
  }

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  // heights stay as they are
  std::vector<std::uint32_t> order_;
  std::vector<std::vector<Node>> levels_;  // the last one has one node
};

}  // namespace bumper
