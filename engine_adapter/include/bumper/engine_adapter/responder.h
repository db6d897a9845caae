#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <string>

#include "bumper/base/api.h"
#include "bumper/engine_adapter/barrier.h"
#include "bumper/engine_adapter/saved_state.h"
#include "bumper/engine_adapter/vehicle.h"
#include "bumper/engine_adapter/world_axes.h"
#include "bumper/response/impact_event.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// How an impulse reaches the bodies (the paper's two choices of implementation). Both lead to the
/// same motion.
enum class Delivery {
  force_pulse,  ///< constant forces and torques, added before the world steps
  state_reset   ///< changes of the bodies' velocities, made before the world steps
};

struct ResponderOptions {
  /// How walls respond, unless their barrier has settings of its own.
  ResponseSettings response{};
  /// Whether vehicles respond to each other too, and how, unless Responder::setPair() says
  /// otherwise for two of them. Settings are of the pair, not of either vehicle: curves of two
  /// could not be mixed without a law for it. Under Method::paper vehicles do not respond to each
  /// other, and settings that break are an Error.
  bool vehiclesCollide = true;
  ResponseSettings vehicleResponse{};
  Delivery delivery = Delivery::force_pulse;
  /// Whether a vehicle that joints or contacts act on gets guard contacts: contact joints with the
  /// walls nearby, for one step, that keep it from being pushed through them. A free body gets
  /// none.
  bool guardContacts = true;
  /// Whether a step skips walls that a vehicle cannot reach, and reuses the walls found in earlier
  /// steps. Off: every step queries all walls anew. The result is the same.
  bool skipping = true;
  /// The world's up axis and length unit.
  WorldAxes axes{};
};

/// What a step could not do as usual; a set of bits.
namespace step_issue {
inline constexpr unsigned none = 0;
inline constexpr unsigned invalid_step = 1;  ///< step size not finite or negative: nothing was done
inline constexpr unsigned not_finite = 2;    ///< a vehicle's state is not finite: it was left alone
inline constexpr unsigned tilted = 4;  ///< a vehicle leans beyond its limit: its contacts are ODE's
inline constexpr unsigned unsettled = 8;  ///< a vehicle had more impacts than one step allows, and
                                          ///< was held where it was until the next one
inline constexpr unsigned repeated_step = 16;    ///< no world step since the last step(): the last
                                                 ///< delivery was reversed first
inline constexpr unsigned other_step_size = 32;  ///< the world's step had another size than
                                                 ///< step(h): the missing part is delivered now
inline constexpr unsigned moved = 64;  ///< a vehicle was moved by other means than a world step:
                                       ///< the pending impulse is dropped
inline constexpr unsigned kinematic = 128;  ///< a body of a vehicle was made kinematic: no force
                                            ///< moves it, and the vehicle was left alone
}  // namespace step_issue

/// Replaces ODE's contact joints between vehicles and barriers by impulses, delivered as constant
/// forces (the paper's scheme).
///
/// The responder borrows the world. It owns the contacts of a vehicle's bodies with walls at the
/// heights of its band, as long as the vehicle stands upright, and resolves them at the outline,
/// which should therefore enclose the bodies' geoms. What stands before such a wall within half a
/// metre of it, lower than the band's top and not a part of the ground, counts as the wall for the
/// chassis; wheels climb it by ODE's contacts. All other contacts stay ODE's. Each step: collide,
/// add your own forces, step(h), step the world by the same h. A step() too many, or a world step
/// of another size, is detected and corrected; see step_issue.
///
/// An impact happens at its own time within a step, and its force pulse lasts until the same time
/// of the next one. Until then the body's velocity is not yet the one after the impact; velocity()
/// and yawRate() return that.
///
/// Vehicle frame: x forward, y left, z up, origin at the mass centre of the chassis and its linked
/// bodies; these are the chassis body's own axes unless VehicleOptions::axes says otherwise. World:
/// right-handed, z up and metres unless ResponderOptions::axes says otherwise, double precision.
///
/// Where joints or contacts act on a vehicle too, step() adds contact joints with the walls nearby
/// for one step (ResponderOptions::guardContacts), in a joint group of its own. Until the world
/// steps, a body of the responder's moves in it, to measure the step.
///
/// Barriers stand still, but for those whose geom has a body, which move with that, and those that
/// updateBarrier() is called for before each step.
/// Nothing here touches data, callbacks or collision bits of the application's geoms and bodies.
///
/// The end: best is the responder first, then geoms and spaces, then the world. Otherwise bodies,
/// those of barriers too, must not be gone when a call reads them: step(), claims(),
/// keepUnclaimed(), save() and what takes a VehicleId; only updateBarrier() reads geoms of the
/// application's. removeVehicle(), removeBarrier() and the destructor read neither. The new geom of
/// a barrier may be destroyed with its space, or by itself unless in a quadtree space, and be moved
/// to a space connected with the old one: one is in the other, or both are in a third. Its walls
/// act until removeBarrier(). A geom made in no space is destroyed by Bumper, and must not be in a
/// space when that is destroyed.
///
/// Set-up calls throw Error and then change nothing; step(), claims() and keepUnclaimed() do not
/// throw, unless memory runs out. A moved-from responder can only be destroyed or assigned to. One
/// responder belongs to one thread at a time; see trimeshLock() for several.
class Responder {
 public:
  /// Throws Error if the world is null, ODE is not in double precision, or a setting is invalid.
  explicit Responder(dWorldID world, const ResponderOptions& options = {});
  ~Responder();
  Responder(const Responder&) = delete;
  Responder& operator=(const Responder&) = delete;
  Responder(Responder&& other) noexcept;
  Responder& operator=(Responder&& other) noexcept;

  /// The walls of a scene in the world's axes and unit, as a new trimesh geom in `options.space`,
  /// or as the shape of `options.geom`. Other bodies collide with that geom as with any other. The
  /// scene is copied. With a new geom its space gets a second one, by which Bumper detects the
  /// destruction of the space: a sphere of radius 0 on a body of Bumper's, disabled, without
  /// category and collide bits. No near callback receives it, but dSpaceGetNumGeoms() counts it; do
  /// not change it. Throws Error if the scene is invalid or has no wall.
  BarrierId addBarrier(const Scene& scene, const BarrierOptions& options = {});

  /// A geom that the application already has: the walls of a trimesh, road and walls in one, the
  /// sides of a box, a plane, which is half of the world, an upright cylinder or capsule, or a
  /// sphere; of round ends what is steeper than 45°, as a circle where that is widest within a
  /// vehicle's band. A capsule that leans further is read as 24 flat sides. With a
  /// body it moves as that does, whose velocity of before a step holds for the step: one that
  /// forces move should be far heavier than vehicles, counts as infinitely heavy in the law, and
  /// takes the opposite impulse. Without, it must stand still from now on, or updateBarrier() be
  /// called. ODE stores a trimesh's vertices in single precision; they are read as stored. Throws
  /// Error if it is of another class, belongs to a vehicle, is registered already or has no wall.
  BarrierId addBarrier(dGeomID geom, const BarrierOptions& options = {});

  /// Every geom in a space, and in the spaces in it, that stands still and has a wall, as a barrier
  /// of its own with these options; what has a body, is disabled or is a barrier already is passed
  /// over. The result is as if each had been added by itself, and is valid until the next call for
  /// that space. Throws Error if the space is null, was added already, or is a quadtree space or
  /// holds one, whose content cannot be read; or if a setting is invalid.
  const SpaceBarriers& addBarriers(dSpaceID space, const BarrierOptions& options = {});
  /// Call after geoms came into such a space, left it, were destroyed or moved: new ones are added,
  /// those that are gone removed, and those that stand differently moved, and those that are
  /// sized differently read anew; others cost nothing. Until then the walls stay as they were. What
  /// changes in a trimesh without its bounding box is for updateBarrier(). If memory runs out
  /// halfway the next call does the rest. Throws Error as addBarriers() does, and if the space was
  /// not added.
  const SpaceBarriers& updateBarriers(dSpaceID space);
  /// Removes those barriers. The space may be gone. Throws Error if it was not added.
  void removeBarriers(dSpaceID space);

  /// Call after the application has moved or changed a barrier's geom. If its shape is another, or
  /// it leans otherwise, its walls are read anew, which costs as much as adding it. Of
  /// a barrier made from a scene, or whose shape is given as one, the scene as it is now takes the
  /// old one's place; its own geom is then a new one, in the same space. Id, name, settings and the
  /// contacts of vehicles are kept; a vehicle that it was moved into is freed by penetration
  /// recovery, without an impulse. The last step's events are void. Throws
  /// Error as addBarrier() does, and if the barrier's own geom was destroyed.
  ///
  /// A geom that was only moved costs next to nothing, also that of a scene: moved before each of
  /// two steps in a row it has the velocity from one place to the next, and hits vehicles with it.
  /// A velocity that is given holds for the coming step. One that is not updated before a step
  /// stands still in it. A body that the geom has got or lost since is noticed. Throws Error if the
  /// velocity is not finite, the geom has a body or is a plane.
  void updateBarrier(BarrierId barrier);
  void updateBarrier(BarrierId barrier, const BarrierVelocity& velocity);
  void updateBarrier(BarrierId barrier, const Scene& scene);

  /// The geom in a barrier's contacts: the new one, which is null once its space was destroyed, or
  /// the application's own.
  [[nodiscard]] dGeomID geom(BarrierId barrier) const;

  /// Which parts of a barrier's mesh were kept or dropped as walls.
  [[nodiscard]] const WallReport& report(BarrierId barrier) const;

  /// A vehicle: its chassis with linked bodies. Throws Error if a parameter is invalid, a body is
  /// null, registered already or of another world, or if the bodies' mass or yaw inertia differs
  /// from the parameters by more than 1 % or 5 %: the impulse would be wrong. From then on the
  /// bodies' own values are used.
  VehicleId addVehicle(dBodyID chassis, const VehicleParameters& given,
                       const VehicleOptions& options = {});

  /// How two vehicles respond to each other from now on, in either order. Vehicles that a joint
  /// connects, but for contact joints, do not, whatever is set. Throws Error if they are the same
  /// or a setting is invalid.
  void setPair(VehicleId a, VehicleId b, const PairOptions& options);

  /// The geoms and bodies may be gone. Unknown ids are an Error.
  void removeBarrier(BarrierId barrier);
  void removeVehicle(VehicleId vehicle);

  /// Whether Bumper owns every contact of this pair, so that the near callback can return at once.
  /// Either order of the geoms. If false, call dCollide and keepUnclaimed().
  [[nodiscard]] bool claims(dGeomID a, dGeomID b) const;

  /// Removes Bumper's contacts from the result of dCollide(a, b, …), moves the others to the front
  /// in their order, and returns their number. Each contact is judged by its own geoms: a and b may
  /// be spaces or geom transforms, in either order.
  int keepUnclaimed(dGeomID a, dGeomID b, dContact* contacts, int count) const;

  /// Finds the impacts of the coming step of `h` seconds and adds their forces to the bodies. The
  /// events are valid until the next step(), the names in them as long as their owners are
  /// registered. Vehicles that ODE has put to sleep stay asleep.
  std::span<const ImpactEvent> step(double h);

  /// A vehicle's current pose in ODE: the common mass centre of its bodies, world, m, and the
  /// rotation from its axes (forward, left, up) to the world's, a unit quaternion.
  [[nodiscard]] Eigen::Vector3d position(VehicleId vehicle) const;
  [[nodiscard]] Eigen::Quaterniond orientation(VehicleId vehicle) const;

  /// A vehicle's velocity, m/s, and yaw rate about its own z axis, rad/s, with the pending impulse:
  /// after the last impact, by the law.
  [[nodiscard]] Eigen::Vector3d velocity(VehicleId vehicle) const;
  [[nodiscard]] double yawRate(VehicleId vehicle) const;

  /// What this responder remembers from step to step. With the bodies' states in ODE the simulation
  /// continues bit for bit.
  [[nodiscard]] SavedState save() const;
  /// Throws Error, and changes nothing, unless the same vehicles and barriers are registered as
  /// when it was saved.
  void restore(const SavedState& state);

  /// The sum of the steps taken, s.
  [[nodiscard]] double time() const;

  /// Bits of step_issue for the last step: of all vehicles, or of one.
  [[nodiscard]] unsigned issues() const;
  [[nodiscard]] unsigned issues(VehicleId vehicle) const;

  /// Warnings of set-up calls about the registered vehicles and barriers. What falsifies an
  /// impulse: damping, speed limits, jointed bodies that are not linked. What lets a vehicle
  /// penetrate walls: geoms that project from the outline within the band by more than 1 cm, with
  /// the figure. What is inconsistent: gravity that does not point along −up, a mass centre so low
  /// that geoms would be in the ground. What may let a vehicle through a barrier: many triangles
  /// steeper than 45° that were taken for hillsides (WallReport::droppedOnGuess). Each is given
  /// once; valid until the next set-up call.
  [[nodiscard]] std::span<const std::string> warnings() const;

  struct Implementation;  ///< in the library's own sources

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bumper
