// Writes what the fuzz targets begin with, made by the library's own code, into a folder for each.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "bumper/render/image.h"
#include "bumper/render/recording_writer.h"
#include "bumper/scenes/paper_scenes.h"
#include "scene_stream.h"
#include "synthetic_run.h"

namespace {

using Bytes = std::string;

void put(Bytes& bytes, double value) {
  const auto steps = static_cast<std::int16_t>(value * 256.0);
  bytes.push_back(static_cast<char>(steps & 255));
  bytes.push_back(static_cast<char>(steps >> 8 & 255));
}

// As input.h reads it: the options' byte, the scene, and the car or the eyes.
Bytes seedOf(const bumper::Scene& scene, char options) {
  Bytes bytes{options, '\0'};
  bytes.push_back(static_cast<char>(scene.vertices.size()));
  bytes.push_back(static_cast<char>(scene.triangles.size()));
  for (const Eigen::Vector3d& each : scene.vertices) {
    for (const double coordinate : each) put(bytes, coordinate);
  }
  for (const bumper::Scene::Triangle& each : scene.triangles) {
    for (const std::uint32_t corner : each.corners) bytes.push_back(static_cast<char>(corner));
    bytes.push_back('\0');
  }
  for (const double value : {3.0, 1.0, 0.0, 20.0, 5.0, 0.5, 0.3}) put(bytes, value);
  return bytes + Bytes(64, '\3');
}

void write(const std::filesystem::path& file, const Bytes& bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

void writeAll(const std::filesystem::path& folder) {
  const std::vector<bumper::Scene> scenes = {bumper::straightWall({6.0, -8.0}, {6.0, 8.0}, 1.0),
                                             bumper::testRail()};
  for (const bumper::Scene& scene : scenes) {
    write(folder / "walls" / scene.name, seedOf(scene, '\4'));
    write(folder / "pictures" / scene.name, seedOf(scene, '\1'));
    write(folder / "stream" / scene.name,
          bumper::pack(bumper::FileScene{.scene = scene, .format = "obj"}));
  }
  write(folder / "stream" / "error", bumper::pack(Bytes("it is no scene")));
  const std::vector<bumper::Recording> runs = {bumper::testing::cornerHits(),
                                               bumper::testing::standingVehicle({1.0, 2.0}, 0.3)};
  std::filesystem::create_directories(folder / "recording");
  std::filesystem::create_directories(folder / "png");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    bumper::writeRecording(runs[i], folder / "recording" / std::to_string(i));
  }
  bumper::Image image(40, 33, {200, 180, 20});
  for (int i = 0; i < 33; ++i) image.at(i, i) = {0, 0, static_cast<std::uint8_t>(7 * i)};
  bumper::writePng(image, folder / "png" / "line");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: fuzz_corpus FOLDER\n";
    return 2;
  }
  try {
    writeAll(arguments[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
