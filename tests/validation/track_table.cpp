// Loads the race tracks of torcs-data and prints what each keeps and drops, as Markdown.
//
//   examples/fetch_tracks.sh --all
//   track_table build/cache/torcs/tracks

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "../scenes/track_files.h"
#include "bumper/response/error.h"
#include "bumper/scenes/scene_files.h"
#include "bumper/scenes/walls.h"

namespace {

using namespace bumper;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

void printRow(const std::filesystem::path& file) {
  LoadReport loaded;
  const auto begin = Clock::now();
  const Scene scene = loadTrustedScene(file, {.up = UpAxis::y}, &loaded);
  const auto middle = Clock::now();
  const WallReport walls = selectWalls(scene).report;
  const auto end = Clock::now();
  const std::size_t degenerate = loaded.droppedDegenerate + walls.droppedDegenerate;
  const std::size_t duplicate = loaded.droppedDuplicate + walls.droppedDuplicate;
  std::printf(
      "| %s | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %.0f | %.0f |\n",
      file.stem().c_str(), loaded.triangles + loaded.droppedDegenerate + loaded.droppedDuplicate,
      walls.walls, walls.droppedFlat, degenerate, duplicate, walls.droppedRetriangulated,
      walls.droppedOverhead, walls.droppedBuried, walls.withoutGround, walls.inDoubt,
      walls.droppedOnGuess, milliseconds(middle - begin), milliseconds(end - middle));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: track_table FOLDER\n", stderr);
    return 2;
  }
  try {
    const std::vector<std::filesystem::path> files = tests::trackFiles(argv[1]);
    if (files.empty()) throw Error(std::string(argv[1]) + " holds no track");
    std::puts(
        "| track | triangles | walls kept | flat | no area | same corners | cut along the other "
        "diagonal | too high | too low | kept without ground near | kept in doubt | dropped on a "
        "guess | load, ms | select, ms |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (const std::filesystem::path& file : files) printRow(file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "track_table: %s\n", error.what());
    return 1;
  }
  return 0;
}
