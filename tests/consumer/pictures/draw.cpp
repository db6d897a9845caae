#include <bumper/render/image.h>

#include "drawing.h"

int main(int /*count*/, char** argv) {
  bumper::writePng(drawRun(), argv[1]);
  return 0;
}
