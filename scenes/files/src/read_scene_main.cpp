// bumper-read-scene: the child process of loadScene() that reads an untrusted file and writes plain
// arrays to standard output. Whatever the file does to the reader, only this process is harmed.

#include <fcntl.h>
#include <sys/resource.h>
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
#include "scene_stream.h"

namespace {

void setLimit(decltype(RLIMIT_AS) resource, rlim_t value) {
  const rlimit limit{value, value};
  setrlimit(resource, &limit);
}

void limitResources(const char* memory, const char* seconds) {
  setLimit(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__  // which maps terabytes
  setLimit(RLIMIT_AS, std::strtoull(memory, nullptr, 10));
#else
  static_cast<void>(memory);
#endif
  alarm(static_cast<unsigned>(std::strtoul(seconds, nullptr, 10)));
  // With the parent gone, write() fails.
  static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
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

std::string answer(const std::string& file, const char* memory) {
  using bumper::pack;
  try {
    return pack(
        bumper::readWithAssimp(file, bumper::Formats::all, [](bumper::LoadStage, double) {}));
  } catch (const bumper::Error& error) {
    return pack(error.what());
  } catch (const std::bad_alloc&) {
    return pack(bumper::fileError(file, std::string("cannot be read: it needs more than "
                                                    "LoadOptions::memoryLimit, ") +
                                            memory + " bytes")
                    .what());
  } catch (const std::exception& error) {
    return pack(bumper::fileError(file, std::string("cannot be read: ") + error.what()).what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs(
        "usage: bumper-read-scene FILE MEMORY_BYTES SECONDS\n"
        "A helper of the bumper library, not made to be run by hand.\n",
        stderr);
    return EXIT_FAILURE;
  }
  const int output = reserveOutput();
  limitResources(argv[2], argv[3]);
  return writeAll(output, answer(argv[1], argv[2])) ? EXIT_SUCCESS : EXIT_FAILURE;
}
