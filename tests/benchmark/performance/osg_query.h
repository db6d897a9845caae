#pragma once

#include <array>
#include <memory>
#include <osg/Group>
#include <osg/ref_ptr>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

#include "query_scheme.h"

namespace bumper::benchmark {

/// How the triangles are kept in OpenSceneGraph.
enum class OsgScene {
  flat,     ///< all in one drawable
  grouped,  ///< a drawable for each square of 50 m, and a group for each row of them
  kdtree    ///< in one drawable with a k-d tree
};

/// The paper's own method: the four sides of the outline at mass-centre height are intersected with
/// a scene graph's triangles.
class OsgQuery {
 public:
  OsgQuery(const Scene& scene, OsgScene kind);

  void moveTo(const Pose& pose);
  std::size_t query();
  [[nodiscard]] bool found() const { return count_ > 0; }
  /// The first intersection with a side, and the triangle's normal, in world coordinates, m.
  /// Only after found().
  [[nodiscard]] const osgUtil::LineSegmentIntersector::Intersection& first() const;

 private:
  osg::ref_ptr<osg::Group> root_;
  osg::ref_ptr<osgUtil::IntersectorGroup> sides_;
  std::array<osg::ref_ptr<osgUtil::LineSegmentIntersector>, 4> side_;
  osgUtil::IntersectionVisitor visitor_;
  std::size_t count_ = 0;
};

std::unique_ptr<QueryScheme> makeOsgQuery(const Scene& scene, OsgScene kind);

}  // namespace bumper::benchmark
