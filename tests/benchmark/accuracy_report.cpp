#include "accuracy_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "hinge2_runs.h"
#include "text_file.h"

namespace bumper::benchmark {

namespace {

using Json = nlohmann::ordered_json;

/// A scheme in words, and how its line is drawn.
struct Legend {
  const char* scheme;
  const char* words;
  const char* colour;
};
constexpr std::array<Legend, 9> legends = {
    Legend{"bumper", "Bumper", "#1f4e9c"},
    Legend{"paper", "the paper to the letter", "#6a3d9a"},
    Legend{"ode_contacts", "Bumper on ODE's contacts", "#33a0c4"},
    Legend{"ode_quickstep", "ODE joints, QuickStep", "#d62728"},
    Legend{"ode_worldstep", "ODE joints, dWorldStep", "#8c564b"},
    Legend{"ode_quickstep_true_normal", "ODE joints, QuickStep, true normals", "#ff7f0e"},
    Legend{"reference_impulses", "the reference's impulses", "#404040"},
    Legend{"bullet", "Bullet", "#2a7f3f"},
    Legend{hinge2Scheme, "Bumper, hinge2 car", "#999999"}};

std::string inWords(const std::string& scheme) {
  const auto* const found =
      std::ranges::find_if(legends, [&](const Legend& legend) { return scheme == legend.scheme; });
  return found == legends.end() ? scheme : found->words;
}

Json asJson(const Spread& spread) {
  return {{"median", spread.median}, {"p99", spread.p99}, {"max", spread.max}};
}

Json asJson(const Row& row) {
  return {{"setting", nameOf(row.setting)},
          {"scheme", row.scheme},
          {"wall_triangles", row.wallTriangles},
          {"step_s", row.step},
          {"count", row.count},
          {"delta_v_error", asJson(row.deltaV)},
          {"yaw_rate_error_rad_s", asJson(row.yawRate)},
          {"position_error_m", asJson(row.position)},
          {"gross", row.gross},
          {"energy_gain_max", row.energyGain},
          {"cpu_us_per_simulated_s", row.cpuPerSimulatedTime}};
}

Json asJson(const std::vector<Row>& rows) {
  Json array = Json::array();
  for (const Row& row : rows) array.push_back(asJson(row));
  return array;
}

Json asJson(const Apart& apart) {
  return {{"cases", apart.count},
          {"moved_by_1e-10_m_changes_impacts", apart.sensitive},
          {"lasting_contact_of_a_wall_end", apart.lasting}};
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), value != 0.0 && value < 0.01 ? "%.1e" : "%.2g", value);
  return text.data();
}

std::string whole(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.0f", value);
  return text.data();
}

void writeTable(std::ostream& out, const std::vector<Row>& rows, Setting setting) {
  out << "| wall | scheme | step, ms | cases | Δv error: median | 99 % | max | position, m: median "
         "| 99 % | max | gross | energy gain | CPU, µs/s |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    if (row.setting != setting) continue;
    out << "| " << row.wallTriangles << " | " << inWords(row.scheme) << " | "
        << number(1e3 * row.step) << " | " << row.count << " | " << number(row.deltaV.median)
        << " | " << number(row.deltaV.p99) << " | " << number(row.deltaV.max) << " | "
        << number(row.position.median) << " | " << number(row.position.p99) << " | "
        << number(row.position.max) << " | " << row.gross << " | " << number(row.energyGain)
        << " | " << whole(row.cpuPerSimulatedTime) << " |\n";
  }
  out << '\n';
}

/// Slope of log(error) over log(step).
double fittedOrder(const std::vector<std::pair<double, double>>& points) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [step, error] : points) {
    const double a = std::log(step);
    const double b = std::log(error);
    n += 1.0;
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

bool isJoint(const std::string& scheme) {
  return scheme.starts_with("ode_") && scheme != "ode_contacts";
}

/// The project's targets with what was measured.
class Targets {
 public:
  Targets(const Results& results, std::ostream& out) : rows_(results.rows), out_(out) {
    out_ << "| target | measured | met |\n|---|---|---|\n";
    freeFlight();
    cost();
    hinge2();
    tyres(results);
    out_ << '\n';
  }

 private:
  void line(const std::string& target, const std::string& measured, bool met) {
    out_ << "| " << target << " | " << measured << " | " << (met ? "yes" : "**no**") << " |\n";
  }

  template <class Value>
  double largest(Setting setting, const std::string& scheme, Value&& value) const {
    double most = 0.0;
    for (const Row& row : rows_) {
      if (row.setting == setting && row.scheme == scheme) {
        most = std::max(most, static_cast<double>(value(row)));
      }
    }
    return most;
  }

  [[nodiscard]] const Row* find(const Row& like, const std::string& scheme) const {
    for (const Row& row : rows_) {
      if (row.setting == like.setting && row.wallTriangles == like.wallTriangles &&
          row.step == like.step && row.scheme == scheme) {
        return &row;
      }
    }
    return nullptr;
  }

  void freeFlight() {
    constexpr double bound = 1e-9;
    // An energy of rounding: the sum of squares of three numbers that were rounded.
    constexpr double rounding = 1e-12;
    const Setting setting = Setting::free_flight;
    const double deltaV = largest(setting, "bumper", [](const Row& r) { return r.deltaV.max; });
    const double place = largest(setting, "bumper", [](const Row& r) { return r.position.max; });
    const double gross = largest(setting, "bumper", [](const Row& r) { return r.gross; });
    const double gain = largest(setting, "bumper", [](const Row& r) { return r.energyGain; });
    line("free flight, largest Δv error ≤ 1e-9", number(deltaV), deltaV <= bound);
    line("free flight, largest position error ≤ 1e-9 m", number(place) + " m", place <= bound);
    line("free flight, no gross error", whole(gross), gross == 0.0);
    line("free flight, no energy created", number(gain) + " of it", gain <= rounding);
  }

  void cost() {
    double worst = 0.0;
    for (const Row& row : rows_) {
      if (row.scheme != "bumper") continue;
      for (const Row& peer : rows_) {
        if (isJoint(peer.scheme) && find(peer, "bumper") == &row) {
          worst = std::max(worst, row.cpuPerSimulatedTime / peer.cpuPerSimulatedTime);
        }
      }
    }
    line("CPU below every ODE contact-joint row at the same step",
         "at most " + number(worst) + " of it", worst < 1.0);
  }

  void hinge2() {
    const Setting setting = Setting::free_flight;
    const double deltaV = largest(setting, hinge2Scheme, [](const Row& r) { return r.deltaV.max; });
    const double place =
        largest(setting, hinge2Scheme, [](const Row& r) { return r.position.max; });
    line("hinge2 car, first impact's Δv error ≤ 2e-4", number(deltaV), deltaV <= 2e-4);
    line("hinge2 car, position ≤ 1 cm", number(1e3 * place) + " mm", place <= 0.01);
  }

  void tyres(const Results& results) {
    double ratio = 0.0;
    std::vector<std::pair<double, double>> points;
    for (const Row& row : rows_) {
      if (row.setting != Setting::tyres || row.scheme != "bumper") continue;
      points.emplace_back(row.step, row.position.median);
      const Row* told = find(row, "reference_impulses");
      for (const auto& [own, best] :
           {std::pair{row.position, told->position}, std::pair{row.deltaV, told->deltaV}}) {
        ratio = std::max({ratio, own.median / best.median, own.p99 / best.p99});
      }
    }
    const double order = fittedOrder(points);
    line("tyres, error ≤ 1.1 × that with the reference's impulses (median and 99 %)",
         number(ratio) + " ×", ratio <= 1.1);
    line("tyres, fitted order ≥ 0.9", number(order), order >= 0.9);
    out_ << "\nThe reference with tyres changes by at most " << number(results.tyreReferenceError)
         << " m when its step is halved. ODE's solver reported " << results.solverMessages
         << " internal errors, over all schemes and runs.\n";
  }

  const std::vector<Row>& rows_;
  std::ostream& out_;
};

void writeMarkdown(std::ostream& out, const Results& results) {
  out << "# Run time against error\n\nSeed " << results.seed << ".\n\n## Targets\n\n";
  Targets(results, out);
  for (const auto& [title, apart] :
       {std::pair{"Free flight", results.freeFlight}, std::pair{"Tyres", results.tyres}}) {
    out << title << ": of " << apart.count << " cases " << apart.sensitive
        << " have another number of impacts when the start is moved by 1e-10 m, and in "
        << apart.lasting << " a wall's end stays pressed on a side; both are counted apart.\n\n";
  }
  out << "## Free flight\n\n";
  writeTable(out, results.rows, Setting::free_flight);
  out << "## Tyres\n\n";
  writeTable(out, results.rows, Setting::tyres);
  out << "## Lasting contact of a wall's end\n\nFree flight:\n\n";
  writeTable(out, results.lasting, Setting::free_flight);
  out << "Tyres:\n\n";
  writeTable(out, results.lasting, Setting::tyres);
}

/// One plot for each setting, with a panel for each wall.
void writePlots(std::ostream& out, const Results& results, const std::string& stem) {
  constexpr std::array<const char*, 2> places = {
      "set lmargin at screen 0.06\nset rmargin at screen 0.37\nset nokey\n",
      "set lmargin at screen 0.43\nset rmargin at screen 0.74\n"
      "set key at screen 0.76,0.9 left top Left reverse samplen 2 spacing 1.3\n"};
  out << "set terminal pngcairo size 1600,640 font 'sans,12' background rgb 'white'\n"
         "set border 3 lc rgb '#404040'\nset tics nomirror\n"
         "set grid lc rgb '#dddddd' lw 1 lt 1\nset logscale xy\n"
         "set format '10^{%T}'\nset yrange [30:1e5]\n"
         "set xlabel 'error of {/Symbol D}v, 99th percentile, relative'\n"
         "set ylabel 'CPU time, {/Symbol m}s per simulated second'\n";
  for (const Setting setting : {Setting::free_flight, Setting::tyres}) {
    std::ostringstream panels;
    for (std::size_t panel = 0; panel < std::size(wallMeshes); ++panel) {
      const int triangles = wallMeshes[panel];
      std::ostringstream lines;
      for (const Legend& legend : legends) {
        std::ostringstream data;
        for (const Row& row : results.rows) {
          if (row.setting != setting || row.wallTriangles != triangles ||
              row.scheme != legend.scheme) {
            continue;
          }
          data << row.deltaV.p99 << ' ' << row.cpuPerSimulatedTime << " \"" << 1e3 * row.step
               << "\"\n";
        }
        if (data.str().empty()) continue;
        std::ostringstream block;
        block << '$' << nameOf(setting) << '_' << triangles << '_' << legend.scheme;
        out << block.str() << " << EOD\n" << data.str() << "EOD\n";
        lines << (lines.str().empty() ? "plot " : ", \\\n     ") << block.str()
              << " using 1:2 with linespoints pt 7 ps 1 lw 2 lc rgb '" << legend.colour
              << "' title \"" << legend.words << "\", \\\n     " << block.str()
              << " using 1:2:3 with labels offset 0.9,0.7 font 'sans,8' notitle";
      }
      panels << places[panel] << "set title '"
             << (setting == Setting::tyres ? "With tyres" : "Free flight") << ", wall of "
             << triangles << " triangles (dots: step in ms)'\n"
             << lines.str() << '\n';
    }
    out << "set output '" << stem << '_' << nameOf(setting) << ".png'\n"
        << "set xrange [" << (setting == Setting::tyres ? "1e-5" : "1e-16") << ":1e2]\n"
        << "set multiplot layout 1,2\n"
        << panels.str() << "unset multiplot\n";
  }
}

}  // namespace

void writeReport(const Results& results, const std::filesystem::path& json) {
  const Json document = {
      {"seed", results.seed},
      {"cases", asJson(results.rows)},
      {"lasting_contacts", asJson(results.lasting)},
      {"counted_apart",
       {{"free_flight", asJson(results.freeFlight)}, {"tyres", asJson(results.tyres)}}}};
  writeFile(json, document.dump(2) + '\n');
  std::ostringstream table;
  writeMarkdown(table, results);
  writeFile(std::filesystem::path(json).replace_extension(".md"), table.str());
  std::ostringstream plots;
  writePlots(plots, results, json.stem().string());
  writeFile(std::filesystem::path(json).replace_extension(".gp"), plots.str());
}

}  // namespace bumper::benchmark
