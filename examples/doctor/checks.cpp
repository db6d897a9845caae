#include "checks.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "number_text.h"

namespace bumper::doctor {

namespace {

constexpr std::array<std::string_view, 8> names{"up",      "dropped", "catches",  "energy",
                                                "through", "mesh",    "features", "joints"};

/// Adds a part to a reason.
void also(Check& check, bool isWrong, const std::string& words) {
  if (!isWrong) return;
  check.isProblem = true;
  if (!check.reason.empty()) check.reason += "; ";
  check.reason += words;
}

void judgeCatches(Check& check, const Subject& subject, const MethodResult& method) {
  const std::size_t caught = method.caught(subject.speed);
  also(check, caught > 0,
       counted(caught, "slide") + " of " + std::to_string(method.slides.size()) + " caught");
}

void judgeEnergy(Check& check, const MethodResult& method) {
  also(check, method.gained() > 0,
       counted(method.gained(), "impact") + " of " + std::to_string(method.impacts.size()) +
           " gained energy, up to " + fixed(method.mostEnergy(), 2) + " times");
}

void judgeThrough(Check& check, const Subject& subject, const MethodResult& method) {
  also(check, method.through() > 0,
       counted(method.through(), "impact") + " led through a wall at " + fixed(subject.speed, 1) +
           " m/s");
  for (const Tunnelling* each : {&method.front, &method.side}) {
    also(check, each->speed && *each->speed <= subject.speed,
         "through a wall from " + fixed(each->speed.value_or(0.0), 1) + " m/s");
  }
}

}  // namespace

std::span<const std::string_view> checkNames() { return names; }

std::span<const std::string_view> usualChecks() { return checkNames().first(5); }

std::vector<Check> checksOf(const Subject& subject, const Examination& examination) {
  std::vector<Check> checks;
  checks.reserve(names.size());
  for (const std::string_view name : names) checks.push_back({.name = name, .reason = {}});
  const auto check = [&](std::string_view name) -> Check& {
    return *std::ranges::find(checks, name, &Check::name);
  };
  for (const std::string& warning : examination.load.warnings) also(check("up"), true, warning);
  for (const std::string& warning : examination.warnings) also(check("dropped"), true, warning);
  judgeCatches(check("catches"), subject, examination.bumper);
  judgeEnergy(check("energy"), examination.bumper);
  judgeThrough(check("through"), subject, examination.bumper);

  const LoadReport& load = examination.load;
  also(check("mesh"), load.droppedDegenerate > 0,
       counted(load.droppedDegenerate, "triangle") + " without area");
  also(check("mesh"), load.droppedDuplicate > 0,
       counted(load.droppedDuplicate, "triangle") + " there twice");
  also(check("mesh"), examination.edges.flipped.count > 0,
       counted(examination.edges.flipped.count, "edge") + " beside a flipped triangle");
  also(check("features"), !examination.features.empty(),
       counted(examination.features.size(), "step or gap", "steps and gaps") + " of less than " +
           millimetres(subject.smallestFeature()));

  Check& joints = check("joints");
  judgeCatches(joints, subject, examination.joints);
  judgeEnergy(joints, examination.joints);
  judgeThrough(joints, subject, examination.joints);
  also(joints, examination.normals.posesWithoutRight > 0,
       "no right normal in " + counted(examination.normals.posesWithoutRight, "pose") + " of " +
           std::to_string(examination.normals.poses));
  return checks;
}

std::vector<std::string> problemsAmong(std::span<const Check> checks,
                                       std::span<const std::string> asked) {
  std::vector<std::string> problems;
  for (const Check& check : checks) {
    if (check.isProblem && std::ranges::find(asked, check.name) != asked.end())
      problems.emplace_back(check.name);
  }
  return problems;
}

}  // namespace bumper::doctor
