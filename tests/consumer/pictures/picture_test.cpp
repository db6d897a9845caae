#include <bumper/render/image_matcher.h>
#include <gtest/gtest.h>

#include "drawing.h"

TEST(Picture, isTheGoldenOne) {
  EXPECT_THAT(drawRun(), bumper::MatchesGolden(GOLDEN_FOLDER "/matcher.png"));
}
