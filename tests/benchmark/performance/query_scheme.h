#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "callgrind.h"
#include "drive.h"

namespace bumper::benchmark {

/// One way of finding out what an outline meets, with its scene ready. Loops are its own, so that
/// no call stands between the clock and what is measured.
class QueryScheme {
 public:
  QueryScheme() = default;
  virtual ~QueryScheme() = default;
  QueryScheme(const QueryScheme&) = delete;
  QueryScheme& operator=(const QueryScheme&) = delete;
  QueryScheme(QueryScheme&&) = delete;
  QueryScheme& operator=(QueryScheme&&) = delete;

  /// Puts the vehicle to each pose in turn, and asks there. A number that depends on the answers.
  virtual std::size_t ask(std::span<const Pose> poses) = 0;
  /// Only puts it there: the time that is not the query's.
  virtual void move(std::span<const Pose> poses) = 0;
  /// As ask(), with Callgrind collecting what the queries take.
  virtual std::size_t askCounted(std::span<const Pose> poses) = 0;
  /// Asks at one pose: whether the vehicle meets anything.
  virtual bool finds(const Pose& pose) = 0;
};

/// The scheme of an Asker:
///   void moveTo(const Pose&)   puts the vehicle there
///   std::size_t query()        is what is measured
///   bool found()               what the last query said
template <class Asker>
class SchemeOf final : public QueryScheme {
 public:
  template <class... Arguments>
  explicit SchemeOf(Arguments&&... arguments) : asker_(std::forward<Arguments>(arguments)...) {}

  std::size_t ask(std::span<const Pose> poses) override {
    std::size_t sum = 0;
    for (const Pose& pose : poses) {
      asker_.moveTo(pose);
      sum += asker_.query();
    }
    return sum;
  }

  void move(std::span<const Pose> poses) override {
    for (const Pose& pose : poses) asker_.moveTo(pose);
  }

  std::size_t askCounted(std::span<const Pose> poses) override {
    std::size_t sum = 0;
    for (const Pose& pose : poses) {
      asker_.moveTo(pose);
      callgrind::toggle();
      sum += asker_.query();
      callgrind::toggle();
    }
    return sum;
  }

  bool finds(const Pose& pose) override {
    asker_.moveTo(pose);
    asker_.query();
    return asker_.found();
  }

 private:
  Asker asker_;
};

/// The schemes by the names of performance.json:
///   bumper                  Responder::step() of one body
///   world_step              dWorldQuickStep of one free body: the unit of the targets
///   ode_contacts            dCollide of a box with the whole mesh, 8 contacts
///   ode_contacts_walls      with the walls alone
///   grid_limit              a hand-written grid, exact overlap
///   grid_sweep              the same grid, and Bumper's sweep of what it finds
///   osg_flat                OpenSceneGraph as in 2003: the outline's sides against all triangles
///   osg_flat_shuffled       the same in random order
///   osg_grouped             … grouped by place, 50 m
///   osg_kdtree              … with its k-d tree
///   bullet                  pair test of a box with a triangle mesh
/// The last ones only if OpenSceneGraph or Bullet was found.
std::vector<std::string> querySchemeNames();

/// Builds a scheme for a scene, which is needed only meanwhile. Throws Error for another name.
std::unique_ptr<QueryScheme> makeQueryScheme(const std::string& name, const Scene& scene);

/// Measures nothing: what a toggle costs.
std::unique_ptr<QueryScheme> makeNoQuery();

}  // namespace bumper::benchmark
