#include "instruction_counts.h"

#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>

#include "bumper/response/error.h"
#include "callgrind.h"
#include "query_scheme.h"

namespace bumper::benchmark {

namespace {

// Steps of the drive that are counted: they hold the first swerves.
constexpr std::size_t countedPoses = 6000;
constexpr const char* calibration = "nothing";

void countKind(const std::string& scene, const std::string& name, const Drive& drive, Nearness kind,
               QueryScheme& scheme) {
  callgrind::start();
  for (const Stretch& stretch : drive.stretches) {
    if (stretch.kind == kind) {
      scheme.askCounted(stretch.poses);
    } else {
      scheme.ask(stretch.poses);
    }
  }
  std::ostringstream what;
  what << scene << ' ' << name << ' ' << static_cast<int>(kind) << ' ' << drive.count(kind);
  callgrind::dump(what.str().c_str());
  callgrind::stop();
}

/// A dump's own words for what it holds, as countKind() wrote them.
struct Dump {
  std::string scene;
  std::string scheme;
  std::size_t kind = 0;
  double perQuery = 0.0;
};

Dump readDump(const std::filesystem::path& path) {
  const std::string trigger = "desc: Trigger: Client Request: ";
  std::ifstream file(path);
  Dump dump;
  double queries = 0.0;
  double instructions = -1.0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(trigger)) {
      std::istringstream words(line.substr(trigger.size()));
      words >> dump.scene >> dump.scheme >> dump.kind >> queries;
    } else if (line.starts_with("totals: ") || line.starts_with("summary: ")) {
      instructions = std::atof(line.substr(line.find(' ')).c_str());
    }
  }
  if (queries <= 0.0 || instructions < 0.0 || dump.kind > 2) {
    throw Error(path.string() + " is no dump of counted queries");
  }
  dump.perQuery = instructions / queries;
  return dump;
}

}  // namespace

void countInstructions(const NamedScene& scene, const std::vector<std::string>& schemes) {
  if (!callgrind::isWatching()) {
    throw Error("instructions are counted under valgrind only, and if its header was found");
  }
  const Drive drive = makeDrive(scene.scene, countedPoses);
  countKind(scene.name, calibration, drive, Nearness::far, *makeNoQuery());
  for (const std::string& name : schemes) {
    const std::unique_ptr<QueryScheme> scheme = makeQueryScheme(name, scene.scene);
    scheme->ask(drive.poses);
    for (const Nearness kind : allNearness) countKind(scene.name, name, drive, kind, *scheme);
  }
}

void readInstructionCounts(const std::filesystem::path& folder, std::vector<QueryRow>& rows) {
  if (!std::filesystem::is_directory(folder)) return;
  std::vector<Dump> dumps;
  double toggle = 0.0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    // The last one, written as the program ends, has no name: nothing is collected there.
    if (entry.path().extension() == ".out") continue;
    dumps.push_back(readDump(entry.path()));
    if (dumps.back().scheme == calibration) toggle = dumps.back().perQuery;
  }
  for (QueryRow& row : rows) {
    for (const Dump& dump : dumps) {
      if (dump.scene == row.scene && dump.scheme == row.scheme) {
        row.instructions.at(dump.kind) = dump.perQuery - toggle;
      }
    }
  }
}

}  // namespace bumper::benchmark
