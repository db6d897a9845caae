#include "performance_plots.h"

#include <array>
#include <sstream>

namespace bumper::benchmark {

namespace {

/// A scheme in words, and how its line is drawn.
struct Legend {
  const char* scheme;
  const char* words;
  const char* colour;
};
constexpr std::array<Legend, 5> legends = {
    Legend{"bumper", "Bumper, a whole step()", "#1f4e9c"},
    Legend{"grid_sweep", "hand-written grid, same sweep", "#33a0c4"},
    Legend{"grid_limit", "hand-written grid, overlap alone", "#999999"},
    Legend{"ode_contacts", "ODE dCollide, whole mesh", "#d62728"},
    Legend{"ode_contacts_walls", "ODE dCollide, walls alone", "#ff7f0e"}};

constexpr const char* places[] = {
    "set lmargin at screen 0.06\nset rmargin at screen 0.36\nset nokey\n",
    "set lmargin at screen 0.43\nset rmargin at screen 0.73\n"
    "set key at screen 0.75,0.9 left top Left reverse samplen 2 spacing 1.3\n"};

void triangles(std::ostream& out, const std::vector<QueryRow>& rows, const std::string& stem) {
  out << "set output '" << stem << "_triangles.png'\n"
      << "set xlabel 'triangles of the course'\nset ylabel 'ns per query or step'\n"
      << "set xrange [700:1.4e6]\nset yrange [1:1e6]\n";
  std::array<std::ostringstream, 2> panels;
  for (const Legend& legend : legends) {
    std::ostringstream data;
    for (const QueryRow& row : rows) {
      if (row.scheme != legend.scheme) continue;
      data << row.triangles << ' ' << row.nanoseconds[0] << ' ' << row.nanoseconds[2] << '\n';
    }
    if (data.str().empty()) continue;
    out << '$' << legend.scheme << " << EOD\n" << data.str() << "EOD\n";
    for (std::size_t panel = 0; panel < panels.size(); ++panel) {
      panels.at(panel) << (panels.at(panel).str().empty() ? "plot " : ", \\\n     ") << '$'
                       << legend.scheme << " using 1:" << panel + 2
                       << " with linespoints pt 7 ps 1 lw 2 lc rgb '" << legend.colour
                       << "' title \"" << legend.words << '"';
    }
  }
  out << "set multiplot layout 1,2\n"
      << places[0] << "set title 'Far: nothing within 1 m'\n"
      << panels[0].str() << '\n'
      << places[1] << "set title 'Touching a wall'\n"
      << panels[1].str() << "\nunset multiplot\n";
}

void vehicles(std::ostream& out, const std::vector<FleetRow>& rows, const std::string& stem) {
  out << "set output '" << stem << "_vehicles.png'\n"
      << "set xlabel 'five-body cars on the course, 8,780 triangles'\n"
      << "set ylabel '{/Symbol m}s per step, all cars'\nset xrange [0.8:1300]\nset autoscale y\n"
      << "set lmargin at screen 0.08\nset rmargin at screen 0.6\n"
      << "set key at screen 0.62,0.9 left top Left reverse samplen 2 spacing 1.3\n"
      << "set title 'A step of many cars'\n$fleets << EOD\n";
  for (const FleetRow& row : rows) {
    const double perCar = 1e-3 * static_cast<double>(row.vehicles);
    out << row.vehicles << ' ' << 1e-3 * row.worldStep << ' ' << perCar * row.inContact << ' '
        << perCar * row.cold << ' ' << perCar * row.afterWorldStep << ' ' << perCar * row.warm
        << '\n';
  }
  out << "EOD\nplot ";
  constexpr std::array<Legend, 5> lines = {
      Legend{"2", "dWorldQuickStep", "#d62728"},
      Legend{"3", "Bumper, all cars leaning on walls", "#6a3d9a"},
      Legend{"4", "Bumper, all far, cold caches", "#33a0c4"},
      Legend{"5", "Bumper, all far, after a world step", "#1f4e9c"},
      Legend{"6", "Bumper, all far, warm", "#999999"}};
  for (const Legend& line : lines) {
    out << (&line == lines.data() ? "" : ", \\\n     ") << "$fleets using 1:" << line.scheme
        << " with linespoints pt 7 ps 1 lw 2 lc rgb '" << line.colour << "' title \"" << line.words
        << '"';
  }
  out << '\n';
}

}  // namespace

std::string plotScript(const Performance& performance, const std::string& stem) {
  std::ostringstream out;
  out << "set terminal pngcairo size 1600,640 font 'sans,12' background rgb 'white'\n"
         "set border 3 lc rgb '#404040'\nset tics nomirror\n"
         "set grid lc rgb '#dddddd' lw 1 lt 1\nset logscale xy\nset format '10^{%T}'\n";
  triangles(out, performance.growth, stem);
  vehicles(out, performance.steps.fleets, stem);
  return out.str();
}

}  // namespace bumper::benchmark
