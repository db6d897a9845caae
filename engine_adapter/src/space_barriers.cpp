// All geoms of a space as barriers, each of its own. ODE gives no notice of what comes or goes, and
// a space may be destroyed at any time, so it is read only when the application says so.

#include "space_barriers.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "responder_implementation.h"

namespace bumper {

namespace {

GeomStand standOf(dGeomID geom) {
  GeomStand stand{.kind = dGeomGetClass(geom)};
  dGeomGetAABB(geom, stand.box.data());
  if (stand.kind == dPlaneClass) {
    dVector4 plane;
    dGeomPlaneGetParams(geom, plane);
    std::copy_n(plane, 4, stand.box.begin());
    return stand;
  }
  std::copy_n(dGeomGetPosition(geom), stand.position.size(), stand.position.begin());
  std::copy_n(dGeomGetRotation(geom), stand.rotation.size(), stand.rotation.begin());
  return stand;
}

// Those that stand still, in ODE's order, the only one in which it lists them at once.
void collect(dSpaceID space, std::vector<dGeomID>& geoms) {
  if (dSpaceGetClass(space) == dQuadTreeSpaceClass) {
    throw Error("addBarriers: the content of a quadtree space cannot be read");
  }
  for (int i = 0; i < dSpaceGetNumGeoms(space); ++i) {
    const dGeomID geom = dSpaceGetGeom(space, i);
    if (dGeomIsSpace(geom) != 0) {
      collect(reinterpret_cast<dSpaceID>(geom), geoms);
    } else if (dGeomGetBody(geom) == nullptr && dGeomIsEnabled(geom) != 0) {
      geoms.push_back(geom);
    }
  }
}

auto placeOf(Responder::Implementation& responder, dSpaceID space) {
  return std::find_if(responder.spaces.begin(), responder.spaces.end(),
                      [space](const auto& each) { return each->space == space; });
}

bool isRegistered(const Responder::Implementation& responder, BarrierId barrier) {
  return find(responder.barriers, barrier.value) != nullptr;
}

// Whether a geom is a barrier that was not added with the space.
bool isOther(const Responder::Implementation& responder, dGeomID geom) {
  const auto known = responder.barrierOfGeom.find(geom);
  return known != responder.barrierOfGeom.end() && known->second->isStill(geom);
}

void removeAll(Responder& responder, const Responder::Implementation& self,
               std::vector<BarrierSpace::Member>& members) {
  for (const BarrierSpace::Member& each : members) {
    if (isRegistered(self, each.barrier)) responder.removeBarrier(each.barrier);
  }
  members.clear();
}

// Of a refresh that fails halfway: what is registered stays known.
struct Unfinished {
  BarrierSpace& group;
  std::vector<BarrierSpace::Member> before{};
  std::vector<bool> isKept{};

  ~Unfinished() {
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (!isKept[i]) group.members.push_back(before[i]);
    }
  }
};

// Whether the walls of a known geom are those of the geom that is there now; read anew if need be.
BarrierId renewed(Responder& responder, const Responder::Implementation& self,
                  const BarrierSpace::Member& known, const GeomStand& stand,
                  const BarrierOptions& options) {
  const Barrier& barrier = *find(self.barriers, known.barrier.value);
  // Another geom may have its address.
  if (!barrier.isStill(known.geom)) {
    responder.removeBarrier(known.barrier);
    return responder.addBarrier(known.geom, options);
  }
  if (!(known.stand == stand)) responder.updateBarrier(known.barrier);
  return known.barrier;
}

// Brings the barriers in step with the space.
void refresh(Responder& responder, const Responder::Implementation& self, BarrierSpace& group) {
  std::vector<dGeomID> geoms;
  collect(group.space, geoms);
  std::reverse(geoms.begin(), geoms.end());  // the oldest first
  std::erase_if(group.members, [&](const BarrierSpace::Member& each) {
    return !isRegistered(self, each.barrier);
  });
  // By address, to be found again.
  std::sort(group.members.begin(), group.members.end(),
            [](const auto& a, const auto& b) { return std::less<>()(a.geom, b.geom); });
  group.members.reserve(geoms.size() + 2 * group.members.size());
  std::vector<BarrierSpace::Member> fresh;
  fresh.reserve(group.members.capacity());
  Unfinished old{.group = group};
  old.isKept.resize(group.members.size());
  old.before.swap(group.members);
  group.members.swap(fresh);
  group.found = {};
  for (dGeomID geom : geoms) {
    const auto known = std::lower_bound(
        old.before.begin(), old.before.end(), geom,
        [](const auto& each, dGeomID wanted) { return std::less<>()(each.geom, wanted); });
    const bool isKnown = known != old.before.end() && known->geom == geom;
    if (!isKnown && isOther(self, geom)) continue;
    const GeomStand stand = standOf(geom);
    try {
      const BarrierId barrier = isKnown ? renewed(responder, self, *known, stand, group.options)
                                        : responder.addBarrier(geom, group.options);
      group.members.push_back({.geom = geom, .barrier = barrier, .stand = stand});
      if (isKnown) old.isKept[static_cast<std::size_t>(known - old.before.begin())] = true;
      group.found.barriers.push_back(barrier);
    } catch (const Error& error) {
      group.found.left.push_back({.geom = geom, .reason = error.what()});
    }
  }
  for (std::size_t i = 0; i < old.before.size(); ++i) {
    if (!old.isKept[i] && isRegistered(self, old.before[i].barrier)) {
      responder.removeBarrier(old.before[i].barrier);
    }
  }
  old.before.clear();
}

}  // namespace

const SpaceBarriers& Responder::addBarriers(dSpaceID space, const BarrierOptions& options) {
  Implementation& self = *implementation_;
  if (space == nullptr) throw Error("addBarriers: the space is null");
  if (placeOf(self, space) != self.spaces.end()) {
    throw Error("addBarriers: the space was added already: updateBarriers() brings it up to date");
  }
  if (!options.materials.empty()) {
    throw Error("addBarriers: BarrierOptions::materials is for scenes: geoms have no material");
  }
  self.requireValid(options);
  auto group = std::make_unique<BarrierSpace>();
  group->space = space;
  group->options = options;
  group->scenery = options.walls.scenery;
  group->options.walls.scenery = group->scenery;
  try {
    refresh(*this, self, *group);
    self.spaces.reserve(self.spaces.size() + 1);
  } catch (...) {
    removeAll(*this, self, group->members);
    throw;
  }
  self.spaces.push_back(std::move(group));
  return self.spaces.back()->found;
}

const SpaceBarriers& Responder::updateBarriers(dSpaceID space) {
  Implementation& self = *implementation_;
  const auto place = placeOf(self, space);
  if (place == self.spaces.end()) throw Error("updateBarriers: the space was not added");
  refresh(*this, self, **place);
  return (*place)->found;
}

void Responder::removeBarriers(dSpaceID space) {
  Implementation& self = *implementation_;
  const auto place = placeOf(self, space);
  if (place == self.spaces.end()) throw Error("removeBarriers: the space was not added");
  removeAll(*this, self, (*place)->members);
  self.spaces.erase(place);
}

}  // namespace bumper
