#include "osg_query.h"

#include <cmath>
#include <map>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/KdTree>
#include <utility>
#include <vector>

#include "bumper/response/error.h"
#include "scenes.h"

namespace bumper::benchmark {

namespace {

osg::ref_ptr<osg::Geode> drawable(const Scene& scene, const std::vector<std::size_t>& triangles) {
  const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  const osg::ref_ptr<osg::DrawElementsUInt> elements = new osg::DrawElementsUInt(GL_TRIANGLES);
  std::vector<unsigned> newNumber(scene.vertices.size(), static_cast<unsigned>(-1));
  for (const std::size_t t : triangles) {
    for (const std::uint32_t corner : scene.triangles[t].corners) {
      if (newNumber[corner] == static_cast<unsigned>(-1)) {
        newNumber[corner] = static_cast<unsigned>(vertices->size());
        const Eigen::Vector3f v = scene.vertices[corner].cast<float>();
        vertices->push_back(osg::Vec3(v.x(), v.y(), v.z()));
      }
      elements->push_back(newNumber[corner]);
    }
  }
  const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(elements);
  osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->addDrawable(geometry);
  return geode;
}

osg::ref_ptr<osg::Group> grouped(const Scene& scene) {
  constexpr double square = 50.0;  // m
  std::map<int, std::map<int, std::vector<std::size_t>>> squares;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const Eigen::Vector3d place = scene.corner(scene.triangles[t], 0) / square;
    squares[static_cast<int>(std::floor(place.x()))][static_cast<int>(std::floor(place.y()))]
        .push_back(t);
  }
  osg::ref_ptr<osg::Group> root = new osg::Group;
  for (const auto& [x, row] : squares) {
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const auto& [y, triangles] : row) group->addChild(drawable(scene, triangles));
    root->addChild(group);
  }
  return root;
}

osg::ref_ptr<osg::Group> flat(const Scene& scene) {
  std::vector<std::size_t> all(scene.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = t;
  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(drawable(scene, all));
  return root;
}

osg::ref_ptr<osg::Group> build(const Scene& scene, OsgScene kind) {
  osg::ref_ptr<osg::Group> root = kind == OsgScene::grouped ? grouped(scene) : flat(scene);
  if (kind == OsgScene::kdtree) {
    const osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
    root->accept(*builder);
  }
  root->getBound();
  return root;
}

}  // namespace

OsgQuery::OsgQuery(const Scene& scene, OsgScene kind)
    : root_(build(scene, kind)), sides_(new osgUtil::IntersectorGroup) {
  for (auto& side : side_) {
    side = new osgUtil::LineSegmentIntersector(osg::Vec3d(), osg::Vec3d());
    sides_->addIntersector(side);
  }
  visitor_.setIntersector(sides_);
  visitor_.setUseKdTreeWhenAvailable(kind == OsgScene::kdtree);
}

void OsgQuery::moveTo(const Pose& pose) {
  const VehicleParameters car = queryCar();
  const Outline outline(car);
  std::array<osg::Vec3d, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector2 corner = outline.corners().at(k);
    const PlanPlace& place = pose.place;
    corners.at(k) =
        osg::Vec3d(place.position.x() + place.cosine * corner.x() - place.sine * corner.y(),
                   place.position.y() + place.sine * corner.x() + place.cosine * corner.y(),
                   car.massCentreHeight);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    side_.at(k)->setStart(corners.at(k));
    side_.at(k)->setEnd(corners.at((k + 1) % 4));
  }
}

std::size_t OsgQuery::query() {
  sides_->reset();
  visitor_.reset();
  root_->accept(visitor_);
  count_ = 0;
  for (const auto& side : side_) count_ += side->getIntersections().size();
  return count_;
}

const osgUtil::LineSegmentIntersector::Intersection& OsgQuery::first() const {
  for (const auto& side : side_) {
    if (side->containsIntersections()) return *side->getIntersections().begin();
  }
  throw Error("OsgQuery: no intersection");
}

std::unique_ptr<QueryScheme> makeOsgQuery(const Scene& scene, OsgScene kind) {
  return std::make_unique<SchemeOf<OsgQuery>>(scene, kind);
}

}  // namespace bumper::benchmark
