#pragma once

#include <bumper/render/image.h>

/// A car that hits a wall, from above. The environment variable BREAK spoils it: "wall" moves the
/// wall by one pixel, "turn" turns the car by 1°, "mark" forgets the impact.
bumper::Image drawRun();
