#include "text_file.h"

#include <fstream>

#include "bumper/response/error.h"

namespace bumper::benchmark {

void writeFile(const std::filesystem::path& path, const std::string& text) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw Error("cannot write " + path.string());
}

}  // namespace bumper::benchmark
