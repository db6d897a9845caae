/* A drive through the C interface, in C99, for tests that compare it with the same drive in C++. */
#ifndef BUMPER_TESTS_C_DRIVE_H
#define BUMPER_TESTS_C_DRIVE_H

#include <bumper/engine_adapter/c_api.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { c_drive_cars = 2, c_drive_wheels = 4 };

/* What the test has made in ODE. */
typedef struct c_drive_setup {
  dWorldID world;
  dSpaceID space;
  dJointGroupID joints;
  dBodyID chassis[c_drive_cars];
  dBodyID wheels[c_drive_cars][c_drive_wheels];
  /* Mass centre to front and to rear, width, mass centre's height, m. */
  double outline[c_drive_cars][4];
  dGeomID post;
  const double* vertices; /* of the walls */
  const uint32_t* triangles;
  const uint32_t* triangle_meshes;
  size_t vertex_count;
  size_t triangle_count;
  double h;
  int steps;
} c_drive_setup;

/* Told of each step. */
typedef struct c_drive_listener {
  void* data;
  void (*motion)(void* data, const bumper_motion* motion);
  void (*event)(void* data, const bumper_event* event);
} c_drive_listener;

/* 0, or the code of the first call that failed. */
int c_drive(const c_drive_setup* setup, const c_drive_listener* listener);

#ifdef __cplusplus
}
#endif

#endif
