#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace bumper {

/// A test with a directory of its own, which is gone afterwards.
class TemporaryFiles : public ::testing::Test {
 protected:
  TemporaryFiles() {
    std::string pattern = (std::filesystem::temp_directory_path() / "bumper-test-XXXXXX").string();
    directory_ = mkdtemp(pattern.data());
  }

  ~TemporaryFiles() override {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }

  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return directory_ / name;
  }

  [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

 private:
  std::filesystem::path directory_;
};

}  // namespace bumper
