#include "ode_world.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::AddGlobalTestEnvironment(new bumper::tests::OdeEnvironment);  // GoogleTest owns it
  return RUN_ALL_TESTS();
}
