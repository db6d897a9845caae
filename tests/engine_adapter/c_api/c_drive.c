#include "c_drive.h"

#include <string.h>

typedef struct drive {
  const c_drive_setup* setup;
  bumper_responder responder;
  int failure;
} drive;

/* Keeps the first failure. */
static int failed(drive* self, int code) {
  if (code < 0 && self->failure == 0) self->failure = code;
  return self->failure;
}

static void near(void* data, dGeomID a, dGeomID b) {
  enum { capacity = 64 };
  static dContact contacts[capacity];
  drive* self = (drive*)data;
  dBodyID body_a = dGeomGetBody(a);
  dBodyID body_b = dGeomGetBody(b);
  int count = 0;
  int i = 0;
  if (body_a == NULL && body_b == NULL) return;
  if (body_a != NULL && body_b != NULL && dAreConnected(body_a, body_b)) return;
  if (bumper_claims(self->responder, a, b) > 0) return;
  count = dCollide(a, b, capacity, &contacts[0].geom, sizeof contacts[0]);
  count = bumper_keep_unclaimed(self->responder, a, b, contacts, count);
  failed(self, count);
  for (i = 0; i < count; ++i) {
    memset(&contacts[i].surface, 0, sizeof contacts[i].surface);
    contacts[i].surface.mode = dContactBounce | dContactApprox1;
    contacts[i].surface.mu = 0.9;
    contacts[i].surface.bounce_vel = 0.1;
    dJointAttach(dJointCreateContact(self->setup->world, self->setup->joints, &contacts[i]), body_a,
                 body_b);
  }
}

/* Settings with a table, and others from a preset. */
static int add_walls(drive* self) {
  static const double restitution[] = {0.1, 0.25, 0.8, 0.1};
  static const bumper_scene_mesh meshes[] = {{"rail", "steel"}, {"end", "concrete"}};
  const c_drive_setup* setup = self->setup;
  bumper_response_settings steel;
  bumper_response_settings post;
  bumper_material_response of_steel;
  bumper_scene scene;
  bumper_barrier_options options;
  bumper_barrier barrier;

  bumper_init_response_settings(&steel, sizeof steel);
  steel.restitution.shape = BUMPER_CURVE_TABLE;
  steel.restitution.points = restitution;
  steel.restitution.point_count = 2;
  steel.friction.grazing = 0.2;
  of_steel.material = "steel";
  of_steel.response = &steel;

  bumper_init_scene(&scene, sizeof scene);
  scene.name = "walls";
  scene.vertices = setup->vertices;
  scene.vertex_count = setup->vertex_count;
  scene.triangles = setup->triangles;
  scene.triangle_count = setup->triangle_count;
  scene.triangle_meshes = setup->triangle_meshes;
  scene.meshes = meshes;
  scene.mesh_count = 2;
  bumper_init_barrier_options(&options, sizeof options);
  options.space = setup->space;
  options.materials = &of_steel;
  options.material_count = 1;
  if (failed(self, bumper_add_scene(self->responder, &scene, &options, &barrier))) {
    return self->failure;
  }

  bumper_init_response_settings(&post, sizeof post);
  failed(self, bumper_find_preset("macmillan", &post));
  bumper_init_barrier_options(&options, sizeof options);
  options.name = "post";
  options.response = &post;
  return failed(self, bumper_add_geom(self->responder, setup->post, &options, &barrier));
}

static int add_cars(drive* self, bumper_vehicle* vehicles) {
  static const char* const names[c_drive_cars] = {"first", "second"};
  int i = 0;
  for (i = 0; i < c_drive_cars; ++i) {
    const c_drive_setup* setup = self->setup;
    const double* outline = setup->outline[i];
    bumper_vehicle_parameters parameters;
    bumper_vehicle_options options;
    bumper_init_vehicle_options(&options, sizeof options);
    options.name = names[i];
    options.linked_bodies = setup->wheels[i];
    options.linked_body_count = c_drive_wheels;
    bumper_init_vehicle_parameters(&parameters, sizeof parameters);
    failed(self, bumper_parameters_from_bodies(setup->chassis[i], &options, outline[0], outline[1],
                                               outline[2], outline[3], &parameters));
    if (failed(self, bumper_add_vehicle(self->responder, setup->chassis[i], &parameters, &options,
                                        &vehicles[i]))) {
      break;
    }
  }
  return self->failure;
}

static int make_steps(drive* self, const bumper_vehicle* vehicles,
                      const c_drive_listener* listener) {
  int step = 0;
  for (step = 0; step < self->setup->steps && self->failure == 0; ++step) {
    int i = 0;
    int events = 0;
    dSpaceCollide(self->setup->space, self, near);
    events = bumper_step(self->responder, self->setup->h);
    if (failed(self, events)) break;
    for (i = 0; i < events; ++i) {
      bumper_event event;
      bumper_init_event(&event, sizeof event);
      failed(self, bumper_get_event(self->responder, (size_t)i, &event));
      listener->event(listener->data, &event);
    }
    dWorldQuickStep(self->setup->world, self->setup->h);
    dJointGroupEmpty(self->setup->joints);
    for (i = 0; i < c_drive_cars; ++i) {
      bumper_motion motion;
      bumper_init_motion(&motion, sizeof motion);
      failed(self, bumper_get_motion(self->responder, vehicles[i], &motion));
      listener->motion(listener->data, &motion);
    }
  }
  return self->failure;
}

int c_drive(const c_drive_setup* setup, const c_drive_listener* listener) {
  drive self;
  bumper_vehicle vehicles[c_drive_cars];
  bumper_response_settings response;
  bumper_response_settings vehicle_response;
  bumper_responder_options options;
  memset(&self, 0, sizeof self);
  self.setup = setup;

  bumper_init_response_settings(&response, sizeof response);
  failed(&self, bumper_find_preset("modern_car", &response));
  bumper_init_response_settings(&vehicle_response, sizeof vehicle_response);
  vehicle_response.restitution_kind = BUMPER_RESTITUTION_KUDLICH_SLIBAR;
  bumper_init_responder_options(&options, sizeof options);
  options.response = &response;
  options.vehicle_response = &vehicle_response;
  if (failed(&self, bumper_create_responder(setup->world, &options, &self.responder))) {
    return self.failure;
  }
  if (add_walls(&self) == 0 && add_cars(&self, vehicles) == 0)
    make_steps(&self, vehicles, listener);
  failed(&self, bumper_destroy_responder(self.responder));
  return self.failure;
}
