#include <bumper/render/golden_image.h>

#include <cstdlib>

#if __has_include(<bumper/render/recording.h>) || __has_include(<bumper/render/snapshot.h>) || \
    __has_include(<bumper/scenes/scene.h>)
#error "headers of other components stand beside those of images"
#endif

// stripes <pixels> <PNG file>: upright stripes, moved to the right by so many pixels.
int main(int count, char** argv) {
  if (count != 3) return 1;
  const int shift = std::atoi(argv[1]);
  bumper::Image image(160, 120, {255, 255, 255});
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if ((x - shift + 16) / 8 % 2 == 0) image.at(x, y) = {20, 40, 160};
    }
  }
  bumper::writePng(image, argv[2]);
  return 0;
}
