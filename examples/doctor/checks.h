#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "examination.h"

namespace bumper::doctor {

/// One thing that is right with a mesh, or not.
struct Check {
  std::string_view name;  ///< one of checkNames()
  bool isProblem = false;
  std::string reason;  ///< what is wrong; empty if nothing is
};

/// up, dropped, catches, energy, through: what is wrong with Bumper; mesh, features, joints: what
/// contact joints and other programs stumble over.
std::span<const std::string_view> checkNames();

/// Those of the names that are wrong with Bumper.
std::span<const std::string_view> usualChecks();

/// All of them, in the order of the names.
std::vector<Check> checksOf(const Subject& subject, const Examination& examination);

/// The names of the checks that are problems and asked for.
std::vector<std::string> problemsAmong(std::span<const Check> checks,
                                       std::span<const std::string> asked);

}  // namespace bumper::doctor
