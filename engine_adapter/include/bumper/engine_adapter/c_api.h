#ifndef BUMPER_ENGINE_ADAPTER_C_API_H
#define BUMPER_ENGINE_ADAPTER_C_API_H

/*
 * Bumper for C (C99 and later) and for whatever can call C. It is the Responder of responder.h,
 * call by call; what a thing does is said there, what is special in C is said here. SI units; world
 * right-handed, z up, unless bumper_responder_options says otherwise; vehicle frame x forward, y
 * left, z up, origin at the mass centre.
 *
 * Answers. Every function that returns int gives 0 or more if it succeeded (a number of things, or
 * 1 for yes) and a negative bumper_status if not. A call that failed has changed nothing and
 * written nothing. bumper_last_error() says in words what was wrong, with the argument's name. No
 * exception leaves a function, and none prints or aborts.
 *
 * Handles are numbers, never used twice; 0 names nothing. One of a thing that was destroyed or
 * removed, or that belongs to another responder, is BUMPER_STALE_HANDLE. What belongs to ODE
 * (worlds, spaces, bodies, geoms) cannot be checked so: only null is noticed, the rest must exist
 * for as long as responder.h says.
 *
 * Structs that may grow begin with their size. Fill them by their bumper_init_…(), which sets the
 * size and the defaults, then change what you like. One from an older header is shorter: what it
 * lacks has its default. One from a newer header is longer: that is an error unless the rest is 0.
 * Structs that the library fills need the size likewise: they are filled up to it, and a rest that
 * the library does not know is set to 0. Structs without a size stay as they are.
 *
 * Numbers must be finite and at most 1e15 in magnitude. Booleans are 0 or 1.
 *
 * Strings are UTF-8 and end with a zero byte. What a call is given, it copies: strings, arrays and
 * structs may be gone afterwards. How long what a call gives stays valid is said beside it.
 *
 * Threads. Calls with different responders may run at the same time on different threads, but see
 * bumper_lock_trimesh(); a responder and its handles belong to one thread at a time. Error messages
 * are of the thread that made the call.
 */

/* NOLINTBEGIN(modernize-use-using, modernize-deprecated-headers, performance-enum-size): it is C.
 */

#include <ode/ode.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif

/* -- errors -- */

enum bumper_status {
  BUMPER_OK = 0,
  BUMPER_INVALID_ARGUMENT = -1, /* null, not finite, out of range, or refused: see the message */
  BUMPER_STALE_HANDLE = -2,     /* names nothing, or nothing any more */
  BUMPER_OUT_OF_MEMORY = -3,
  BUMPER_TOO_MANY = -4,      /* 65,536 responders, or saved states, exist already */
  BUMPER_INTERNAL_ERROR = -5 /* a defect of the library: please report it */
};

/* What was wrong with this thread's last call that failed; "" if none has. Never null. Valid until
 * the thread's next call that fails. */
const char* bumper_last_error(void);

/* -- handles -- */

typedef struct bumper_responder {
  uint64_t value;
} bumper_responder;

typedef struct bumper_barrier {
  uint64_t value;
} bumper_barrier;

typedef struct bumper_vehicle {
  uint64_t value;
} bumper_vehicle;

typedef struct bumper_state {
  uint64_t value;
} bumper_state;

/* -- how walls respond: settings -- */

enum bumper_curve_shape {
  BUMPER_CURVE_COSINE = 0, /* head_on + (grazing - head_on) cos a; constant if both are equal */
  BUMPER_CURVE_HALF_COSINE = 1, /* head_on + (grazing - head_on) cos² a */
  BUMPER_CURVE_TABLE = 2        /* straight lines between points, constant beyond them */
};

/* A quantity as a function of the angle of attack a, from 0 (grazing) to pi/2 (head-on), rad. */
typedef struct bumper_angle_curve {
  int32_t shape;        /* bumper_curve_shape */
  uint32_t point_count; /* of a table: at least 1; otherwise 0 */
  double grazing;
  double head_on;
  const double* points; /* of a table: angle, value, angle, value, …; the angles increase */
} bumper_angle_curve;

enum bumper_method { BUMPER_METHOD_BUMPER = 0, BUMPER_METHOD_PAPER = 1 };
enum bumper_law { BUMPER_LAW_RESTITUTION = 0, BUMPER_LAW_ENERGY = 1 };
enum bumper_angle {
  BUMPER_ANGLE_CONTACT_VELOCITY = 0,
  BUMPER_ANGLE_CENTRE_VELOCITY = 1,
  BUMPER_ANGLE_HEADING = 2
};
enum bumper_restitution_kind {
  BUMPER_RESTITUTION_NEWTON = 0,
  BUMPER_RESTITUTION_KUDLICH_SLIBAR = 1
};
enum bumper_friction_kind { BUMPER_FRICTION_COULOMB = 0, BUMPER_FRICTION_FRACTION_OF_CRITICAL = 1 };
enum bumper_energy_root { BUMPER_ENERGY_REBOUND = 0, BUMPER_ENERGY_BREAK_THROUGH = 1 };

/* ResponseSettings of response_settings.h, where each member's meaning and range are. */
typedef struct bumper_response_settings {
  size_t size;
  int32_t method;                      /* bumper_method */
  int32_t law;                         /* bumper_law */
  int32_t angle;                       /* bumper_angle */
  int32_t restitution_kind;            /* bumper_restitution_kind */
  int32_t friction_kind;               /* bumper_friction_kind */
  int32_t energy_root;                 /* bumper_energy_root */
  bumper_angle_curve restitution;      /* [0, 1] */
  bumper_angle_curve friction;         /* >= 0; a fraction of the critical ratio: [0, 1] */
  bumper_angle_curve energy_remaining; /* [0, 1] */
  double max_restitution;              /* [0, 1] */
  double penetration_time;             /* s, >= 0 */
  double smallest_feature;             /* a share of the outline's length, >= 0 */
  double contact_time;                 /* s, >= 0; 0: one step */
  double rest_speed;                   /* m/s, >= 0 */
} bumper_response_settings;

/* The paper's, as a default ResponseSettings. */
int bumper_init_response_settings(bumper_response_settings* settings, size_t size);

/* Settings with a source, of presets.h. The name of each is valid for ever. `settings` needs its
 * size; it may be null where only the name is wanted, and `name` where only the settings are. */
int bumper_preset_count(void);
int bumper_get_preset(size_t index, const char** name, bumper_response_settings* settings);
int bumper_find_preset(const char* name, bumper_response_settings* settings);

/* -- responder -- */

enum bumper_delivery { BUMPER_DELIVERY_FORCE_PULSE = 0, BUMPER_DELIVERY_STATE_RESET = 1 };

/* ResponderOptions. */
typedef struct bumper_responder_options {
  size_t size;
  const bumper_response_settings* response;         /* of walls; null: the defaults */
  const bumper_response_settings* vehicle_response; /* of two vehicles; null: the defaults */
  int32_t vehicles_collide;                         /* 0 or 1 */
  int32_t delivery;                                 /* bumper_delivery */
  int32_t guard_contacts;                           /* 0 or 1 */
  int32_t skipping;                                 /* 0 or 1 */
  double up[3]; /* of the world, unit: WorldAxes of world_axes.h */
  double metre; /* so many of the world's length units make one */
} bumper_responder_options;

int bumper_init_responder_options(bumper_responder_options* options, size_t size);

/* `options` may be null: the defaults. The responder borrows the world. */
int bumper_create_responder(dWorldID world, const bumper_responder_options* options,
                            bumper_responder* responder);

/* Its vehicles' and barriers' handles are stale from then on; saved states are kept. */
int bumper_destroy_responder(bumper_responder responder);

/* -- barriers -- */

/* WallSelection of walls.h. */
typedef struct bumper_wall_selection {
  size_t size;
  double max_normal_up;       /* [0, 1] */
  const char* scenery;        /* a regular expression of meshes that no vehicle hits; null: none */
  int32_t drop_repeated;      /* 0 or 1 */
  int32_t limit_ground_reach; /* 0 or 1: whether the three limits below hold */
  double reach_distance;      /* m, >= 0, from the ground */
  double reach_above;         /* m, >= 0 */
  double reach_below;         /* m, >= 0 */
} bumper_wall_selection;

int bumper_init_wall_selection(bumper_wall_selection* walls, size_t size);

/* How the walls of one material respond. */
typedef struct bumper_material_response {
  const char* material;
  const bumper_response_settings* response;
} bumper_material_response;

/* BarrierOptions of barrier.h. */
typedef struct bumper_barrier_options {
  size_t size;
  dSpaceID space;                            /* for the new geom of a scene; may be null */
  dGeomID geom;                              /* whose shape a scene is; null: a new one */
  const char* name;                          /* in events; null: a number */
  const bumper_wall_selection* walls;        /* null: the defaults */
  const bumper_response_settings* response;  /* null: the responder's */
  const bumper_material_response* materials; /* may be null if there are none */
  size_t material_count;                     /* at most 65,536 */
} bumper_barrier_options;

int bumper_init_barrier_options(bumper_barrier_options* options, size_t size);

/* A named part of a scene with one material. A null name is an empty one. */
typedef struct bumper_scene_mesh {
  const char* name;
  const char* material;
} bumper_scene_mesh;

/* Triangles: metres, right-handed, z up. Winding need not be right. */
typedef struct bumper_scene {
  size_t size;
  const char* name;                /* may be null */
  const double* vertices;          /* x, y, z of each */
  const uint32_t* triangles;       /* three numbers of vertices each */
  const uint32_t* triangle_meshes; /* number of the mesh of each; null: all are of the first */
  const bumper_scene_mesh* meshes; /* null: one without name and material */
  size_t vertex_count;             /* at most 4,294,967,295 */
  size_t triangle_count;           /* at most 715,827,882 */
  size_t mesh_count;               /* at most 4,294,967,295 */
} bumper_scene;

int bumper_init_scene(bumper_scene* scene, size_t size);

/* The walls of a scene; `options` may be null. (Scene files are read by the C++ library
 * bumper::scene_files, which an application of ODE alone does not need.) */
int bumper_add_scene(bumper_responder responder, const bumper_scene* scene,
                     const bumper_barrier_options* options, bumper_barrier* barrier);

/* The walls of a geom that the application already has; `options` may be null. */
int bumper_add_geom(bumper_responder responder, dGeomID geom, const bumper_barrier_options* options,
                    bumper_barrier* barrier);

/* After the application has moved or changed a barrier's geom, or with the scene as it is now. */
int bumper_update_barrier(bumper_responder responder, bumper_barrier barrier);
int bumper_update_scene(bumper_responder responder, bumper_barrier barrier,
                        const bumper_scene* scene);

int bumper_remove_barrier(bumper_responder responder, bumper_barrier barrier);

/* The geom in a barrier's contacts; null once its space was destroyed. */
int bumper_get_geom(bumper_responder responder, bumper_barrier barrier, dGeomID* geom);

/* Every geom in a space that stands still and has a wall, as a barrier of its own; `options` may be
 * null. Call bumper_update_space() after geoms have come, gone or moved. Both give the number of
 * barriers. The space may be gone when it is removed; one that was not added is an error. */
int bumper_add_space(bumper_responder responder, dSpaceID space,
                     const bumper_barrier_options* options);
int bumper_update_space(bumper_responder responder, dSpaceID space);
int bumper_remove_space(bumper_responder responder, dSpaceID space);

/* Its barriers, `index` from 0; their geoms by bumper_get_geom(). */
int bumper_get_space_barrier(bumper_responder responder, dSpaceID space, size_t index,
                             bumper_barrier* barrier);

/* Geoms in it that stand still and are no barrier, and why: how many, and each of them. `reason` is
 * valid until the space is updated or removed. */
int bumper_left_geom_count(bumper_responder responder, dSpaceID space);
int bumper_get_left_geom(bumper_responder responder, dSpaceID space, size_t index, dGeomID* geom,
                         const char** reason);

/* WallReport of walls.h: which triangles were kept or dropped as walls. */
typedef struct bumper_wall_report {
  size_t size;
  uint64_t walls;
  uint64_t dropped_flat;
  uint64_t dropped_degenerate;
  uint64_t dropped_scenery;
  uint64_t dropped_duplicate;
  uint64_t dropped_retriangulated;
  uint64_t dropped_overhead;
  uint64_t dropped_buried;
  uint64_t dropped_on_guess;
  uint64_t without_ground;
  uint64_t in_doubt;
  uint64_t memory;    /* bytes */
  double lowest_foot; /* m */
  double highest_top; /* m */
} bumper_wall_report;

int bumper_init_wall_report(bumper_wall_report* report, size_t size);
int bumper_get_wall_report(bumper_responder responder, bumper_barrier barrier,
                           bumper_wall_report* report);

/* -- vehicles -- */

/* VehicleParameters of vehicle_parameters.h; all positive. */
typedef struct bumper_vehicle_parameters {
  size_t size;
  double mass;                 /* kg */
  double yaw_inertia;          /* kg m² */
  double mass_centre_to_front; /* m */
  double mass_centre_to_rear;  /* m */
  double width;                /* m */
  double mass_centre_height;   /* m, above the ground */
} bumper_vehicle_parameters;

/* All 0: there are no defaults. */
int bumper_init_vehicle_parameters(bumper_vehicle_parameters* parameters, size_t size);

/* Heights above the ground, m, at which walls hit the outline. */
typedef struct bumper_band {
  double bottom;
  double top;
} bumper_band;

/* defaultBand() and plateBand() of vehicle.h. */
int bumper_default_band(const bumper_vehicle_parameters* parameters, bumper_band* band);
int bumper_plate_band(const bumper_vehicle_parameters* parameters, bumper_band* band);

enum bumper_mover {
  BUMPER_MOVER_WORLD = 0,
  BUMPER_MOVER_APPLICATION = 1,
  BUMPER_MOVER_OTHER_HOST = 2
};

/* VehicleOptions of vehicle.h. */
typedef struct bumper_vehicle_options {
  size_t size;
  const char* name;             /* in events; null: a number */
  const dBodyID* linked_bodies; /* may be null if there are none */
  size_t linked_body_count;     /* at most 65,536 */
  const bumper_band* band; /* null: bumper_default_band(), or by the paper's method the plate */
  double tilt_limit;       /* rad, above 0 and below pi/2 */
  int32_t mover;           /* bumper_mover */
  int32_t finite_rotation; /* 0 or 1 */
  double forward[3];       /* of the chassis in its own frame, unit … */
  double up[3];            /* … and perpendicular: ChassisAxes of world_axes.h */
} bumper_vehicle_options;

int bumper_init_vehicle_options(bumper_vehicle_options* options, size_t size);

/* parametersFromBodies() and parametersFromGeoms() of vehicle.h. Linked bodies and axes are those
 * of `options`, which may be null: none, and the defaults. `parameters` needs its size. */
int bumper_parameters_from_bodies(dBodyID chassis, const bumper_vehicle_options* options,
                                  double mass_centre_to_front, double mass_centre_to_rear,
                                  double width, double mass_centre_height,
                                  bumper_vehicle_parameters* parameters);
int bumper_parameters_from_geoms(dBodyID chassis, const bumper_vehicle_options* options,
                                 double mass_centre_height, bumper_vehicle_parameters* parameters);

/* `options` may be null: the defaults. */
int bumper_add_vehicle(bumper_responder responder, dBodyID chassis,
                       const bumper_vehicle_parameters* parameters,
                       const bumper_vehicle_options* options, bumper_vehicle* vehicle);
int bumper_remove_vehicle(bumper_responder responder, bumper_vehicle vehicle);

/* PairOptions of vehicle.h. */
typedef struct bumper_pair_options {
  size_t size;
  const bumper_response_settings* response; /* null: bumper_responder_options::vehicle_response */
  int32_t collide;                          /* 0 or 1 */
  int32_t reserved;                         /* 0 */
} bumper_pair_options;

int bumper_init_pair_options(bumper_pair_options* options, size_t size);
int bumper_set_pair(bumper_responder responder, bumper_vehicle a, bumper_vehicle b,
                    const bumper_pair_options* options);

/* A vehicle's pose in ODE, and its motion with the pending impulse: after the last impact. */
typedef struct bumper_motion {
  size_t size;
  double position[3];    /* of the mass centre, world, m */
  double orientation[4]; /* w, x, y, z: from the vehicle's axes to the world's, unit */
  double velocity[3];    /* world, m/s */
  double yaw_rate;       /* about the vehicle's z axis, rad/s, positive turning left */
} bumper_motion;

int bumper_init_motion(bumper_motion* motion, size_t size);
int bumper_get_motion(bumper_responder responder, bumper_vehicle vehicle, bumper_motion* motion);

/* -- every step -- */

/* For the near callback: 1 if Bumper owns every contact of this pair, 0 if not. Neither geom may be
 * null. */
int bumper_claims(bumper_responder responder, dGeomID a, dGeomID b);

/* Takes Bumper's contacts out of the result of dCollide(a, b, …) and gives the number of the
 * others, which then come first, in their order. `contacts` may be null if `count` is 0; count is
 * at most 65,535, the most that dCollide gives. */
int bumper_keep_unclaimed(bumper_responder responder, dGeomID a, dGeomID b, dContact* contacts,
                          int count);

/* The coming step of `h` seconds; 0 is a pause. Gives the number of events, for
 * bumper_get_event(). Takes no memory once as many things have met as will meet. */
int bumper_step(bumper_responder responder, double h);

enum bumper_event_phase {
  BUMPER_PHASE_IMPACT = 0,
  BUMPER_PHASE_CONTACT_BEGIN = 1,
  BUMPER_PHASE_CONTACT_END = 2
};
enum bumper_energy_outcome {
  BUMPER_OUTCOME_NOT_ASKED = 0,
  BUMPER_OUTCOME_MET = 1,
  BUMPER_OUTCOME_LIMITED_BY_RESTITUTION = 2,
  BUMPER_OUTCOME_LIMITED_BY_FRICTION = 3,
  BUMPER_OUTCOME_BELOW_REACH = 4,
  BUMPER_OUTCOME_NO_BREAK_THROUGH = 5
};
enum bumper_regime {
  BUMPER_REGIME_SEPARATING = 0,
  BUMPER_REGIME_SLIDING = 1,
  BUMPER_REGIME_STICKING = 2,
  BUMPER_REGIME_REVERSE_SLIP = 3
};

/* ImpactEvent of impact_event.h. Names are never null, and valid until their vehicle or barrier is
 * removed or updated, or the responder destroyed. */
typedef struct bumper_event {
  size_t size;
  double time;      /* s */
  int32_t phase;    /* bumper_event_phase */
  int32_t triangle; /* in the barrier's own mesh; -1: none */
  const char* vehicle;
  const char* barrier;       /* what it hit; "" if that is … */
  const char* other_vehicle; /* … another vehicle; "" for a barrier */
  const char* material;
  double contact[3];               /* world, m */
  double normal[3];                /* world, unit, into the vehicle */
  double arm[2];                   /* mass centre to contact, vehicle frame, m */
  double other_arm[2];             /* of the other vehicle, likewise, and its motion; else 0 */
  double other_velocity_before[3]; /* world, m/s */
  double other_velocity_after[3];
  double other_yaw_rate_before; /* rad/s */
  double other_yaw_rate_after;
  int32_t law;     /* bumper_law */
  int32_t outcome; /* bumper_energy_outcome */
  int32_t regime;  /* bumper_regime */
  int32_t reserved;
  double angle_contact_velocity; /* of attack, by the three definitions, rad */
  double angle_centre_velocity;
  double angle_heading;
  double approach_speed; /* m/s, positive when closing */
  double restitution;
  double friction;
  double impulse_normal;  /* N s, along the normal */
  double impulse_tangent; /* N s, along z × normal */
  double impulse_ratio;
  double critical_impulse_ratio; /* may be NaN */
  double delta_v;                /* m/s */
  double yaw_rate_before;        /* rad/s */
  double yaw_rate_after;
  double speed_before; /* m/s */
  double speed_after;
  double velocity_after[3]; /* world, m/s */
  double energy_asked;      /* NaN under the restitution law */
  double energy_ratio;
  double energy_lost; /* J */
  double duration;    /* of a contact that has ended, s */
} bumper_event;

int bumper_init_event(bumper_event* event, size_t size);

/* An event of the last bumper_step(), `index` from 0. Events are void after any call that adds,
 * updates or removes something, and after bumper_restore(), even if that failed: the index is an
 * error then. */
int bumper_get_event(bumper_responder responder, size_t index, bumper_event* event);

/* The words that files and logs use, valid for ever; "unknown" for any other number. */
const char* bumper_phase_word(int32_t phase);
const char* bumper_law_word(int32_t law);
const char* bumper_outcome_word(int32_t outcome);
const char* bumper_regime_word(int32_t regime);

/* The sum of the steps taken, s. */
int bumper_get_time(bumper_responder responder, double* time);

/* What a step could not do as usual; a set of bits: step_issue of responder.h. */
enum bumper_issue {
  BUMPER_ISSUE_INVALID_STEP = 1,
  BUMPER_ISSUE_NOT_FINITE = 2,
  BUMPER_ISSUE_TILTED = 4,
  BUMPER_ISSUE_UNSETTLED = 8,
  BUMPER_ISSUE_REPEATED_STEP = 16,
  BUMPER_ISSUE_OTHER_STEP_SIZE = 32,
  BUMPER_ISSUE_MOVED = 64,
  BUMPER_ISSUE_KINEMATIC = 128
};

/* Those of the last step: of all vehicles, or of one. */
int bumper_get_issues(bumper_responder responder);
int bumper_get_vehicle_issues(bumper_responder responder, bumper_vehicle vehicle);

/* Warnings about what is registered: Responder::warnings(). Each text is valid until something is
 * added, updated or removed. */
int bumper_warning_count(bumper_responder responder);
int bumper_get_warning(bumper_responder responder, size_t index, const char** text);

/* -- save and restore -- */

/* A new state, to be destroyed by bumper_destroy_state(). With the bodies' own states in ODE the
 * simulation continues bit for bit. It may be restored any number of times, and outlive its
 * responder. */
int bumper_save(bumper_responder responder, bumper_state* state);
int bumper_restore(bumper_responder responder, bumper_state state);
int bumper_destroy_state(bumper_state state);

/* -- threads -- */

/* trimeshLock() of trimesh_lock.h: ODE's trimesh collider is not thread safe. Hold it around your
 * own dCollide and dSpaceCollide where several threads collide, not around calls of Bumper's.
 * Holding it twice, or unlocking what this thread does not hold, is an error. */
int bumper_lock_trimesh(void);
int bumper_unlock_trimesh(void);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using, modernize-deprecated-headers, performance-enum-size) */

#endif
