#include <fstream>
#include <nlohmann/json.hpp>

#include "bumper/render/image.h"
#include "bumper/scenes/scene_files.h"
#include "doctor_scenes.h"
#include "tools.h"

namespace bumper::testing {
namespace {

using ::testing::HasSubstr;

constexpr int healthy = 0;
constexpr int problemsFound = 1;
constexpr int notExamined = 2;

class DoctorTool : public Tools {
 protected:
  DoctorTool() {
    saveScene(healthyWall(), folder_.path() / "healthy.obj");
    saveScene(steppedWall(0.005), folder_.path() / "step.obj");
  }
  void expectNotExamined(const std::string& command, const std::string& words) const {
    expectError(command, words, notExamined);
  }
};

TEST_F(DoctorTool, PassesAHealthyWall) {
  const Outcome outcome = run("bumper-doctor healthy.obj --up z --places 10 --fail-on all");
  EXPECT_EQ(outcome.code, healthy) << outcome.words;
  EXPECT_THAT(outcome.words, HasSubstr("\nhealthy\n"));
}

TEST_F(DoctorTool, NamesAStepByItsSizeAndPlace) {
  EXPECT_EQ(run("bumper-doctor step.obj --up z --places 10").code, healthy);
  const Outcome outcome = run(
      "bumper-doctor step.obj --up z --places 10 --fail-on features --json step.json --pictures "
      "pictures");
  EXPECT_EQ(outcome.code, problemsFound) << outcome.words;
  EXPECT_THAT(outcome.words, HasSubstr("problems: features\n"));
  EXPECT_THAT(outcome.words, HasSubstr("5.0 mm"));
  std::ifstream file(folder_.path() / "step.json");
  const nlohmann::json report = nlohmann::json::parse(file);
  EXPECT_EQ(report["problems"], nlohmann::json::array({"features"}));
  EXPECT_EQ(report["healthy"], false);
  ASSERT_EQ(report["small_features"]["count"], 1);
  const nlohmann::json& feature = report["small_features"]["largest"][0];
  EXPECT_NEAR(feature["size_m"].get<double>(), 0.005, 1e-6);
  EXPECT_NEAR(feature["at"][0].get<double>(), 20.0, 1e-6);
  // A picture of each of the worst places.
  ASSERT_GT(report["worst_places"].size(), 0U);
  for (const nlohmann::json& place : report["worst_places"]) {
    const Image image = readPng(folder_.path() / place["picture"].get<std::string>());
    EXPECT_EQ(image.width(), 1280);
  }
}

TEST_F(DoctorTool, SaysWhatCouldNotBeExamined) {
  saveScene(levelGround(), folder_.path() / "flat.obj");
  expectNotExamined("bumper-doctor missing.obj --up z", "missing.obj");
  expectNotExamined("bumper-doctor healthy.obj", "--up");
  expectNotExamined("bumper-doctor flat.obj --up z", "wall");
  expectNotExamined("bumper-doctor healthy.obj --up z --step 0", "--step");
  expectNotExamined("bumper-doctor healthy.obj --up z --fail-on nothing", "--fail-on");
  expectNotExamined("bumper-doctor healthy.obj --up z --mass-centre-to-front 9 ",
                    "massCentreToRear");
  expectNotExamined("bumper-doctor healthy.obj --up z --places 2 --json missing/r.json", "r.json");
}

}  // namespace
}  // namespace bumper::testing
