// The tools as a user runs them: exit codes, messages, what is left behind.

#include "tools.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>

#include "bumper/render/image.h"
#include "bumper/render/recording_reader.h"
#include "bumper/render/recording_writer.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "synthetic_run.h"

namespace bumper::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Tools, HelpIsAManualAndNoError) {
  for (const char* tool : {"bumper-replay", "bumper-plot", "bumper-drive"}) {
    const Outcome help = run(std::string(tool) + " --help");
    EXPECT_EQ(help.code, done) << tool;
    EXPECT_THAT(help.words, HasSubstr("Exit codes")) << tool;
  }
}

TEST_F(Tools, WrongCommandLinesEndWithTwo) {
  expectError("bumper-replay", "subcommand", wrongCommandLine);
  expectError("bumper-replay dance run.jsonl", "subcommand", wrongCommandLine);
  expectError("bumper-replay video run.jsonl", "result", wrongCommandLine);
  expectError("bumper-replay picture run.jsonl p.png --view sideways", "sideways",
              wrongCommandLine);
  expectError("bumper-replay frames run.jsonl f --fps fast", "fast", wrongCommandLine);
  expectError("bumper-plot run.jsonl", "folder", wrongCommandLine);
  expectError("bumper-plot run.jsonl p --only weather", "weather", wrongCommandLine);
  expectError("bumper-drive", "scene", wrongCommandLine);
}

TEST_F(Tools, BadRecordingsAreNamed) {
  std::ofstream(folder_.path() / "foreign.jsonl") << "{\"type\": \"FeatureCollection\"}\n";
  std::ofstream(folder_.path() / "picture.jsonl") << "\x89PNG\r\n\x1a\n\x01\x02";
  std::ofstream(folder_.path() / "empty.jsonl") << "";
  std::string text;
  {
    std::ifstream stream(recording_);
    text.assign(std::istreambuf_iterator<char>(stream), {});
  }
  const std::size_t middle = text.find('\n', text.size() / 2) + 1;
  std::ofstream(folder_.path() / "damaged.jsonl")
      << text.substr(0, middle) << "#?!" << text.substr(middle);
  for (const char* name : {"missing", "foreign", "picture", "empty", "damaged"}) {
    const std::string file = std::string(name) + ".jsonl";
    expectError("bumper-replay info " + file, file);
    expectError("bumper-replay glb " + file + " out.glb", file);
    expectError("bumper-plot " + file + " plots --only speed", file);
  }
  EXPECT_FALSE(exists("out.glb"));
}

TEST_F(Tools, OfACutRecordingThereIsWhatThereIs) {
  std::filesystem::resize_file(recording_, std::filesystem::file_size(recording_) / 2);
  const Outcome info = run("bumper-replay info run.jsonl");
  EXPECT_EQ(info.code, done);
  EXPECT_THAT(info.words, HasSubstr("cut off"));
  EXPECT_THAT(info.words, HasSubstr("vehicle saloon"));
  EXPECT_EQ(run("bumper-replay glb run.jsonl cut.glb").code, done);
  EXPECT_TRUE(exists("cut.glb"));
}

TEST_F(Tools, MakeWhatTheySay) {
  EXPECT_EQ(run("bumper-replay glb run.jsonl run.glb").words, "");
  EXPECT_TRUE(exists("run.glb"));
  EXPECT_EQ(run("bumper-replay picture run.jsonl p.png --size 320x200 --view three_quarter").words,
            "");
  EXPECT_EQ(readPng(folder_.path() / "p.png").width(), 320);
  EXPECT_EQ(run("bumper-replay sheet run.jsonl s.png --impacts 1 --instants 0,0.2").code, done);
  EXPECT_GT(readPng(folder_.path() / "s.png").height(), 300);
  EXPECT_EQ(run("bumper-replay closeups run.jsonl c --impacts 1").code, done);
  EXPECT_TRUE(exists("c/impact_3.png"));
  EXPECT_EQ(run("bumper-replay csv run.jsonl tables").code, done);
  EXPECT_TRUE(exists("tables/events.csv"));
  const Outcome frames =
      run("bumper-replay frames run.jsonl f --from 1 --to 1.3 --fps 10 --slow-motion 1 "
          "--size 200x150 --vehicle saloon");
  EXPECT_EQ(frames.code, done);
  EXPECT_THAT(frames.words, HasSubstr("4 of 4"));
  EXPECT_EQ(readPng(folder_.path() / "f" / "frame_00004.png").height(), 150);
}

TEST_F(Tools, ValuesThatMakeNoSenseAreNamed) {
  expectError("bumper-replay frames run.jsonl f --fps 0", "--fps: 0 is not in", wrongCommandLine);
  expectError("bumper-replay frames run.jsonl f --from 7", "nothing to replay");
  expectError("bumper-replay frames run.jsonl f --size 10x10", "width");
  expectError("bumper-replay frames run.jsonl f --size big", "--size");
  expectError("bumper-replay frames run.jsonl f --vehicle lorry", "'saloon'");
  expectError("bumper-replay glb run.jsonl none/run.glb", "none/run.glb");
  expectError("bumper-replay video run.jsonl film.avi", ".webm");
}

TEST_F(Tools, AMissingFfmpegIsAClearMessage) {
  const Outcome outcome = run("bumper-replay video run.jsonl film.mp4", "BUMPER_FFMPEG=/no/ffmpeg");
  EXPECT_EQ(outcome.code, failed);
  EXPECT_THAT(outcome.words, HasSubstr("install ffmpeg or set BUMPER_FFMPEG"));
  EXPECT_FALSE(exists("film.mp4"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Tools, TheSceneIsFoundBesideTheRecording) {
  const auto inFolder = folder_.path() / "scenes";
  std::filesystem::create_directory(inFolder);
  saveScene(testRail(), inFolder / "rail.obj");
  const Scene rail = loadTrustedScene(inFolder / "rail.obj", {.up = UpAxis::z});
  RunDescription described{.scene = referenceTo(rail)};
  described.scene.file = "scenes/rail.obj";
  described.scene.up = "z";
  writeRecording(testRailRun(), recording_, described);

  EXPECT_EQ(run("bumper-replay glb run.jsonl run.glb").words, "");
  EXPECT_TRUE(exists("run.glb"));

  // A moved wall is another scene: a warning, and the result none the less.
  Scene changed = rail;
  changed.vertices[0].x() += 0.5;
  saveScene(changed, inFolder / "rail.obj");
  const Outcome warned = run("bumper-replay glb run.jsonl changed.glb");
  EXPECT_EQ(warned.code, done);
  EXPECT_THAT(warned.words, HasSubstr("warning: the scene is not the one"));
  EXPECT_TRUE(exists("changed.glb"));

  std::filesystem::rename(inFolder, folder_.path() / "elsewhere");
  expectError("bumper-replay glb run.jsonl lost.glb", "--scene");
  EXPECT_FALSE(exists("lost.glb"));
  saveScene(testRail(), folder_.path() / "elsewhere" / "rail.obj");
  EXPECT_EQ(run("bumper-replay glb run.jsonl found.glb --scene elsewhere/rail.obj").words, "");
}

TEST_F(Tools, VehiclesAreDrawnFromTheirMeshFiles) {
  // A green slab, 4 m along y: turned by 90° to the right it lies along the vehicle.
  Scene slab;
  slab.vertices = {{0.0, 0.0, 1.0}, {1.5, 0.0, 1.0}, {1.5, 4.0, 1.0}, {0.0, 4.0, 1.0}};
  slab.meshes = {{"slab", "paint", {0.1F, 0.9F, 0.1F}}};
  slab.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
  saveScene(slab, folder_.path() / "slab.obj");
  const auto greens = [&](const std::string& options) {
    const Outcome outcome =
        run("bumper-replay picture run.jsonl p.png --camera 0,0,30,0.001,0,0 " + options);
    EXPECT_EQ(outcome.code, done) << outcome.words;
    const Image image = readPng(folder_.path() / "p.png");
    int count = 0;
    for (const Rgb& pixel : image.pixels())
      count += pixel.green > pixel.red + 60 && pixel.green > pixel.blue + 60 ? 1 : 0;
    return count;
  };
  const std::string mesh = "--vehicle-mesh-up z --vehicle-mesh-turn -90 --vehicle-mesh ";
  const int legend = greens("");
  EXPECT_GT(greens(mesh + "slab.obj"), legend + 1000);
  EXPECT_GT(greens(mesh + "saloon=slab.obj"), legend + 1000);

  expectError("bumper-replay picture run.jsonl p.png --vehicle-mesh none.glb", "none.glb");
  expectError("bumper-replay picture run.jsonl p.png --vehicle-mesh slab.obj", "--vehicle-mesh-up");
  expectError("bumper-replay picture run.jsonl p.png --vehicle-mesh lorry=slab.obj",
              "lorry=slab.obj");

  // A recording may name it itself; if it is gone, the rest is drawn.
  Recording named;
  const RecordedVehicle saloon = testRailRun().vehicles()[0];
  const RunParameters settings{{"mesh", "slab.obj"}, {"mesh_up", "z"}, {"mesh_turn_deg", -90.0}};
  const std::size_t copy = named.addVehicle(saloon.name, saloon.parameters, settings);
  for (const RecordedPose& pose : saloon.poses) named.addPose(copy, pose);
  RunDescription described{.scene = referenceTo(testRail())};
  described.scene.builtIn = "test_rail";
  writeRecording(named, recording_, described);
  EXPECT_GT(greens(""), legend + 1000);
  std::filesystem::remove(folder_.path() / "slab.obj");
  EXPECT_EQ(run("bumper-replay picture run.jsonl p.png").code, done);
  EXPECT_THAT(run("bumper-replay glb run.jsonl run.glb").words, HasSubstr("without its mesh"));
  EXPECT_TRUE(exists("run.glb"));
}

TEST_F(Tools, AnExamplesOwnSceneIsFoundAgain) {
  ASSERT_EQ(run("break_through result").code, done);
  std::filesystem::rename(folder_.path() / "result", folder_.path() / "moved");
  const Outcome outcome = run("bumper-replay glb moved/run.jsonl moved/run.glb");
  EXPECT_EQ(outcome.code, done);
  EXPECT_EQ(outcome.words, "");
}

TEST_F(Tools, PlotsAreDrawn) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is missing";
  const Outcome outcome = run("bumper-plot run.jsonl plots --sae");
  EXPECT_EQ(outcome.code, done) << outcome.words;
  for (const char* name : {"yaw_rate", "speed", "force", "impulse", "path"}) {
    const auto png = folder_.path() / "plots" / (std::string(name) + ".png");
    EXPECT_GT(readPng(png).width(), 800) << name;
  }
}

TEST_F(Tools, WithoutGnuplotThePlotterSaysSo) {
  const Outcome outcome = run("bumper-plot run.jsonl plots", "PATH=/nowhere");
  EXPECT_EQ(outcome.code, failed);
  EXPECT_THAT(outcome.words, HasSubstr("gnuplot"));
}

TEST_F(Tools, ADriveIsRecordedWithItsScene) {
  Scene ground = straightWall({30.0, -20.0}, {30.0, 20.0}, 1.0);
  const auto first = static_cast<std::uint32_t>(ground.vertices.size());
  for (const auto& [x, y] : {std::pair(-10.0, -30.0), {60.0, -30.0}, {60.0, 30.0}, {-10.0, 30.0}})
    ground.vertices.emplace_back(x, y, 0.0);
  ground.triangles.push_back({{first, first + 1, first + 2}, 0});
  ground.triangles.push_back({{first, first + 2, first + 3}, 0});
  saveScene(ground, folder_.path() / "place.obj");
  const Outcome drive =
      run("bumper-drive place.obj --up z --start 0,0 --speed 20 --duration 2.5 --out result "
          "--vehicle-mesh place.obj --vehicle-mesh-up z");
  ASSERT_EQ(drive.code, done) << drive.words;
  RunDescription described;
  const Recording recording = readRecording(folder_.path() / "result" / "run.jsonl", &described);
  EXPECT_GE(recording.impacts().size(), 1U);
  EXPECT_EQ(described.scene.file, "../place.obj");
  EXPECT_EQ(std::get<std::string>(recording.vehicles()[0].settings.at("mesh")), "../place.obj");
  // Found again, and the same.
  EXPECT_EQ(run("bumper-replay glb result/run.jsonl result/run.glb").words, "");
}

/// A floor, a roof 5 m above it and walls along y at both ends.
Scene hall() {
  Scene scene;
  scene.meshes.resize(1);
  for (const double z : {0.0, 5.0}) {
    for (const auto& [x, y] : {std::pair(-15.0, -15.0), {15.0, -15.0}, {15.0, 15.0}, {-15.0, 15.0}})
      scene.vertices.emplace_back(x, y, z);
  }
  for (const auto& [a, b, c, d] :
       {std::array{0U, 1U, 2U, 3U}, {4U, 5U, 6U, 7U}, {0U, 3U, 7U, 4U}, {1U, 2U, 6U, 5U}}) {
    scene.triangles.push_back({{a, b, c}, 0});
    scene.triangles.push_back({{a, c, d}, 0});
  }
  return scene;
}

TEST_F(Tools, ADriveInAHallStartsOnItsFloorAndMeetsItsWall) {
  saveScene(hall(), folder_.path() / "hall.obj");
  for (const char* start : {"--start 0,0", "--start 0,0,5"}) {
    const Outcome drive = run(
        std::string("bumper-drive hall.obj --up z --speed 12 --duration 2 --out result ") + start);
    ASSERT_EQ(drive.code, done) << drive.words;
    const Recording recording = readRecording(folder_.path() / "result" / "run.jsonl");
    const bool onRoof = std::string(start).ends_with("5");
    const double height = recording.vehicles()[0].poses.front().position.z();
    EXPECT_NEAR(height, onRoof ? 5.55 : 0.55, 0.2) << start;
    EXPECT_EQ(recording.impacts().empty(), onRoof) << start;
  }
  expectError("bumper-drive hall.obj --up z --start 0", "--start", wrongCommandLine);
  expectError("bumper-drive hall.obj --up z --start 0,0,0,0", "--start", wrongCommandLine);
  expectError("bumper-drive hall.obj --up z --start 99,0,0", "no ground at --start 99,0");
}

TEST_F(Tools, WarnOfASceneThatLies) {
  saveScene(hall(), folder_.path() / "hall.obj");
  const Outcome drive = run("bumper-drive hall.obj --up y --duration 0.1 --out result");
  EXPECT_THAT(drive.words, HasSubstr("warning: scene file \"hall.obj\" was read with y up"));
  EXPECT_THAT(drive.words, HasSubstr("here: --up"));
  EXPECT_THAT(run("bumper-replay glb run.jsonl hall.glb --scene hall.obj --up y").words,
              HasSubstr("was read with y up"));
  EXPECT_THAT(run("bumper-replay glb run.jsonl hall.glb --scene hall.obj --up z").words,
              Not(HasSubstr("up, but")));
}

}  // namespace
}  // namespace bumper::testing
