/* Bumper from C: a car in an ODE world runs into a wall. Prints each impact, and where the car is
 * at the end. Compiles as C99. */

#include <bumper/engine_adapter/c_api.h>
#include <stdio.h>
#include <stdlib.h>

static const double step_size = 0.005; /* s */
static const double half_height = 0.5; /* m, of the car; its mass centre is in the middle */

typedef struct simulation {
  dWorldID world;
  dSpaceID space;
  dJointGroupID contact_joints;
  bumper_responder responder;
} simulation;

/* Ends the program with what went wrong; otherwise gives the answer. */
static int checked(int answer) {
  if (answer < 0) {
    fprintf(stderr, "%s\n", bumper_last_error());
    exit(EXIT_FAILURE);
  }
  return answer;
}

/* Contacts with walls are Bumper's, all others become joints as in any program of ODE's. */
static void near_callback(void* data, dGeomID a, dGeomID b) {
  const simulation* self = (const simulation*)data;
  dContact contacts[16];
  int count = 0;
  if (checked(bumper_claims(self->responder, a, b))) return;
  count = dCollide(a, b, 16, &contacts[0].geom, sizeof contacts[0]);
  count = checked(bumper_keep_unclaimed(self->responder, a, b, contacts, count));
  for (int i = 0; i < count; ++i) {
    contacts[i].surface.mode = dContactApprox1;
    contacts[i].surface.mu = 0.3;
    dJointAttach(dJointCreateContact(self->world, self->contact_joints, &contacts[i]),
                 dGeomGetBody(a), dGeomGetBody(b));
  }
}

/* A wall 1 m high across the road, 30 m ahead and slightly askew. */
static void add_wall(const simulation* self) {
  static const double vertices[] = {28, -15, 0, 32, 15, 0, 32, 15, 1, 28, -15, 1};
  static const uint32_t triangles[] = {0, 2, 1, 0, 3, 2};
  static const bumper_scene_mesh meshes[] = {{"wall", "concrete"}};
  bumper_response_settings settings;
  bumper_barrier_options options;
  bumper_scene scene;
  bumper_barrier wall;

  checked(bumper_init_response_settings(&settings, sizeof settings));
  checked(bumper_find_preset("modern_car", &settings));
  checked(bumper_init_barrier_options(&options, sizeof options));
  options.space = self->space;
  options.response = &settings;
  checked(bumper_init_scene(&scene, sizeof scene));
  scene.name = "wall";
  scene.vertices = vertices;
  scene.vertex_count = 4;
  scene.triangles = triangles;
  scene.triangle_count = 2;
  scene.meshes = meshes;
  scene.mesh_count = 1;
  checked(bumper_add_scene(self->responder, &scene, &options, &wall));
}

/* A box of 1500 kg that slides at 25 m/s. */
static bumper_vehicle add_car(const simulation* self) {
  const dBodyID body = dBodyCreate(self->world);
  const dGeomID box = dCreateBox(self->space, 4.4, 1.8, 2 * half_height);
  bumper_vehicle_parameters parameters;
  bumper_vehicle_options options;
  bumper_vehicle car;
  dMass mass;
  dMassSetBoxTotal(&mass, 1500, 4.4, 1.8, 2 * half_height);
  dBodySetMass(body, &mass);
  dBodySetPosition(body, 0, 0, half_height);
  dBodySetLinearVel(body, 25, 0, 0);
  dGeomSetBody(box, body);

  checked(bumper_init_vehicle_parameters(&parameters, sizeof parameters));
  checked(bumper_parameters_from_geoms(body, NULL, half_height, &parameters));
  checked(bumper_init_vehicle_options(&options, sizeof options));
  options.name = "car";
  checked(bumper_add_vehicle(self->responder, body, &parameters, &options, &car));
  return car;
}

static void print_event(const bumper_event* event) {
  printf("%.3f s: %s, %s against %s (%s) at (%.2f, %.2f) m, %.2f m/s, %.0f degrees: %.0f N s, %s\n",
         event->time, bumper_phase_word(event->phase), event->vehicle, event->barrier,
         event->material, event->contact[0], event->contact[1], event->approach_speed,
         event->angle_contact_velocity * 57.29577951308232, event->impulse_normal,
         bumper_regime_word(event->regime));
}

int main(void) {
  simulation self;
  bumper_vehicle car;
  bumper_motion motion;
  dInitODE2(0);
  self.world = dWorldCreate();
  dWorldSetGravity(self.world, 0, 0, -9.81);
  self.space = dHashSpaceCreate(NULL);
  self.contact_joints = dJointGroupCreate(0);
  dCreatePlane(self.space, 0, 0, 1, 0); /* the ground */

  checked(bumper_create_responder(self.world, NULL, &self.responder));
  add_wall(&self);
  car = add_car(&self);
  for (int i = 0; i < checked(bumper_warning_count(self.responder)); ++i) {
    const char* text = NULL;
    checked(bumper_get_warning(self.responder, (size_t)i, &text));
    printf("warning: %s\n", text);
  }

  for (int step = 0; step < 600; ++step) {
    dSpaceCollide(self.space, &self, near_callback);
    /* your own forces first, then: */
    const int events = checked(bumper_step(self.responder, step_size));
    for (int i = 0; i < events; ++i) {
      bumper_event event;
      checked(bumper_init_event(&event, sizeof event));
      checked(bumper_get_event(self.responder, (size_t)i, &event));
      print_event(&event);
    }
    dWorldQuickStep(self.world, step_size); /* the same step */
    dJointGroupEmpty(self.contact_joints);
  }

  checked(bumper_init_motion(&motion, sizeof motion));
  checked(bumper_get_motion(self.responder, car, &motion));
  printf("after 3 s: at (%.2f, %.2f) m, %.2f m/s, turning at %.2f rad/s\n", motion.position[0],
         motion.position[1], motion.velocity[0], motion.yaw_rate);

  checked(bumper_destroy_responder(self.responder));
  dJointGroupDestroy(self.contact_joints);
  dSpaceDestroy(self.space);
  dWorldDestroy(self.world);
  dCloseODE();
  return EXIT_SUCCESS;
}
