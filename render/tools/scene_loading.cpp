#include "scene_loading.h"

#include <cstdio>

#include "bumper/base/printing.h"
#include "bumper/response/error.h"
#include "tool.h"

namespace bumper::tools {

namespace {

std::string withOption(const std::string& message, const std::string& upOption) {
  const bool isAboutUp = message.find("LoadOptions::up") != std::string::npos;
  return isAboutUp ? message + "; here: " + upOption : message;
}

}  // namespace

void addUpAndScale(CLI::App& app, std::string& up, double& scale) {
  app.add_option("--up", up, "the file's up axis, for formats that state none")
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option("--scale", scale, "metres per unit of the file")
      ->check(numberIn(1e-9, 1e9))
      ->capture_default_str();
}

std::optional<UpAxis> upAxis(const std::string& name) {
  if (name == "x") return UpAxis::x;
  if (name == "y") return UpAxis::y;
  if (name == "z") return UpAxis::z;
  return std::nullopt;
}

Scene loadScene(const std::filesystem::path& file, const std::string& upOption,
                const LoadOptions& options, LoadReport* report) {
  LoadReport own;
  LoadReport& said = report != nullptr ? *report : own;
  Scene scene;
  try {
    scene = bumper::loadScene(file, options, &said);
  } catch (const Error& error) {
    throw Error(withOption(error.what(), upOption));
  }
  for (const std::string& warning : said.warnings) {
    std::fprintf(stderr, "warning: %s\n", printable(withOption(warning, upOption)).c_str());
  }
  return scene;
}

}  // namespace bumper::tools
