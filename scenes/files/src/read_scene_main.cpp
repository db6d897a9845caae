// bumper-read-scene: the child process of loadScene() that reads an untrusted file and writes plain
// arrays to standard output. Whatever the file does to the reader, only this process is harmed.

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "assimp_reader.h"
#include "confinement.h"
#include "scene_stream.h"

namespace {

std::size_t number(const char* text) {
  return static_cast<std::size_t>(std::strtoull(text, nullptr, 10));
}

/// Keeps standard output for the answer: what an importer prints must not get in between.
int reserveOutput() {
  close_range(STDERR_FILENO + 1, ~0U, 0);
  const int output = dup(STDOUT_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  return output;
}

bool writeAll(int output, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(output, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string answer(const std::string& file, std::size_t memory, const bumper::SceneBudget& budget) {
  using bumper::pack;
  try {
    return pack(bumper::readWithAssimp(file, bumper::Formats::all, budget,
                                       [](bumper::LoadStage, double) {}));
  } catch (const bumper::Error& error) {
    return pack(error.what());
  } catch (const std::bad_alloc&) {
    return pack(bumper::fileError(file,
                                  "cannot be read: it needs more than "
                                  "LoadOptions::memoryLimit, " +
                                      std::to_string(memory) + " bytes")
                    .what());
  } catch (const std::exception& error) {
    return pack(bumper::fileError(file, std::string("cannot be read: ") + error.what()).what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 8) {
    std::fputs(
        "usage: bumper-read-scene FILE MEMORY_BYTES SECONDS TRIANGLES NODES NAME_BYTES "
        "NAME_LENGTH\n"
        "A helper of the bumper library, not made to be run by hand.\n",
        stderr);
    return EXIT_FAILURE;
  }
  const std::size_t memory = number(argv[2]);
  const bumper::SceneBudget budget{.triangles = number(argv[4]),
                                   .nodes = number(argv[5]),
                                   .names = number(argv[6]),
                                   .nameLength = number(argv[7])};
  const int output = reserveOutput();
  alarm(static_cast<unsigned>(number(argv[3])));
  // With the parent gone, write() fails.
  static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
  bumper::limitResources(memory);
  bumper::confineTo(argv[1]);
  return writeAll(output, answer(argv[1], memory, budget)) ? EXIT_SUCCESS : EXIT_FAILURE;
}
