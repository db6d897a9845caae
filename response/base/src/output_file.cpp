#include "bumper/base/output_file.h"

#include <fstream>
#include <system_error>
#include <utility>

#include "bumper/response/error.h"

namespace bumper {

void makeFolder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw Error("cannot make the folder " + folder.string() + ": " + failure.message());
}

OutputFile::OutputFile(std::filesystem::path place)
    : place_(std::move(place)), beside_(place_.string() + ".part") {}

OutputFile::~OutputFile() {
  if (isInPlace_) return;
  std::error_code absent;
  std::filesystem::remove(beside_, absent);
}

void OutputFile::write(std::initializer_list<std::string_view> parts) const {
  std::ofstream file(beside_, std::ios::binary | std::ios::trunc);
  for (const std::string_view part : parts)
    file.write(part.data(), static_cast<std::streamsize>(part.size()));
  file.close();
  if (file.fail())
    throw Error("cannot write " + place_.string() + ": the folder must be writable and have room");
}

void OutputFile::moveToPlace() {
  std::error_code failure;
  std::filesystem::rename(beside_, place_, failure);
  if (failure) throw Error("cannot replace " + place_.string() + ": " + failure.message());
  isInPlace_ = true;
}

}  // namespace bumper
