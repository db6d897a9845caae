#include "query_scheme.h"

#include "bumper/response/error.h"
#include "bumper_query.h"
#include "grid_query.h"
#include "ode_query.h"
#ifdef BUMPER_BULLET
#include "bullet_query.h"
#endif
#ifdef BUMPER_OSG
#include "osg_query.h"
#endif

namespace bumper::benchmark {

namespace {

struct NoQuery {
  static void moveTo(const Pose& /*pose*/) {}
  static std::size_t query() { return 0; }
  static bool found() { return false; }
};

template <class Asker>
std::unique_ptr<QueryScheme> schemeOf(const Scene& scene) {
  return std::make_unique<SchemeOf<Asker>>(scene);
}

}  // namespace

std::vector<std::string> querySchemeNames() {
  return {
      "bumper",     "world_step",  "ode_contacts", "ode_contacts_walls", "grid_limit", "grid_sweep",
#ifdef BUMPER_BULLET
      "bullet",
#endif
#ifdef BUMPER_OSG
      "osg_kdtree", "osg_grouped", "osg_flat",     "osg_flat_shuffled",
#endif
  };
}

std::unique_ptr<QueryScheme> makeQueryScheme(const std::string& name, const Scene& scene) {
  if (name == "bumper") return schemeOf<BumperQuery>(scene);
  if (name == "world_step") return schemeOf<WorldStep>(scene);
  if (name == "ode_contacts") return schemeOf<OdeQuery>(scene);
  if (name == "ode_contacts_walls") return schemeOf<OdeQuery>(wallsAlone(scene));
  if (name == "grid_limit") return schemeOf<GridQuery>(scene);
  if (name == "grid_sweep") return schemeOf<GridSweep>(scene);
#ifdef BUMPER_BULLET
  if (name == "bullet") return makeBulletQuery(scene);
#endif
#ifdef BUMPER_OSG
  if (name == "osg_flat") return makeOsgQuery(scene, OsgScene::flat);
  if (name == "osg_flat_shuffled") return makeOsgQuery(shuffled(scene), OsgScene::flat);
  if (name == "osg_grouped") return makeOsgQuery(shuffled(scene), OsgScene::grouped);
  if (name == "osg_kdtree") return makeOsgQuery(scene, OsgScene::kdtree);
#endif
  throw Error("there is no query scheme " + name);
}

std::unique_ptr<QueryScheme> makeNoQuery() { return std::make_unique<SchemeOf<NoQuery>>(); }

}  // namespace bumper::benchmark
