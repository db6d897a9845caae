#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "checks.h"
#include "examination.h"
#include "worst_places.h"

namespace bumper::doctor {

/// All that is reported of an examination.
struct Report {
  std::string file;
  std::string vehicle;  ///< its name
  const Subject& subject;
  const Examination& examination;
  std::vector<Check> checks;
  std::vector<std::string> problems;  ///< of those asked for
  std::vector<WorstPlace> worst;
  std::vector<std::string> pictures;  ///< of the worst places; empty: none were made
};

/// For people, on standard output.
void printTable(const Report& report);

/// For programs: JSON, in SI units, with what is not known as null.
std::string jsonOf(const Report& report);

}  // namespace bumper::doctor
