// Plots a recording with gnuplot: bumper-plot --help.

#include <cstdio>
#include <string>
#include <vector>

#include "bumper/base/output_file.h"
#include "bumper/base/printing.h"
#include "bumper/response/error.h"
#include "plots.h"
#include "recorded_run.h"
#include "tool.h"

namespace {

using namespace bumper;
using namespace bumper::tools;

constexpr const char* manual = R"(Plots, each a PNG file of its name in the folder:
  yaw_rate   over time (the paper's Figure 7 with --sae)
  speed      over time
  force      on the mass centre over time, along and across the vehicle, tyres and walls together
  impulse    of each impact, and the sum so far
  path       from above, with walls, impacts and the outline every half second (Figure 6); the only
             one that needs the scene

  bumper-plot run.jsonl plots/
  bumper-plot run.jsonl plots/ --only yaw_rate,path --sae

The program gnuplot draws them; it must be on the path.

)";

struct Arguments {
  RecordedRunOptions run;
  std::filesystem::path folder;
  std::vector<std::string> only{"yaw_rate", "speed", "force", "impulse", "path"};
  std::string vehicle;
  PlotOptions plot;
};

void plot(Arguments& arguments) {
  if (!havePlotter()) throw Error("the program gnuplot cannot be run: it draws the plots");
  bool withPath = false;
  for (const std::string& name : arguments.only) withPath = withPath || name == "path";
  RecordedRun run;
  if (withPath)
    run = readRecordedRun(arguments.run);
  else
    run.recording = readRecordedPart(arguments.run, run.description);
  if (!arguments.vehicle.empty())
    arguments.plot.vehicle = vehicleIndex(run.recording, arguments.vehicle);

  makeFolder(arguments.folder);
  for (const std::string& name : arguments.only) {
    const std::filesystem::path png = arguments.folder / (name + ".png");
    if (name == "yaw_rate") plotYawRate(run.recording, arguments.plot, png);
    if (name == "speed") plotSpeed(run.recording, arguments.plot, png);
    if (name == "force") plotForce(run.recording, arguments.plot, png);
    if (name == "impulse") plotImpulse(run.recording, arguments.plot, png);
    if (name == "path") plotPath(run.scene, run.recording, arguments.plot, png);
    std::printf("%s\n", printable(png.string()).c_str());
  }
}

int runPlot(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Plots yaw rate, speed, force, impulse and path of a recorded run.", "bumper-plot");
  addRecordedRunOptions(app, arguments.run);
  app.add_option("folder", arguments.folder, "for the plots; made if it does not exist")
      ->required();
  app.add_option("--only", arguments.only, "which plots (default: all)")
      ->delimiter(',')
      ->check(CLI::IsMember({"yaw_rate", "speed", "force", "impulse", "path"}));
  app.add_option("--vehicle", arguments.vehicle, "which vehicle (default: the first)");
  app.add_flag("--sae", arguments.plot.sae,
               "signs as in the paper (SAE J670: y to the right, yaw rate positive turning right)");
  addPatience(app, arguments.plot.patience);
  app.footer(manual + exitCodes());
  return runTool(app, argc, argv, [&] { plot(arguments); });
}

}  // namespace

int main(int argc, char** argv) { return runMain("bumper-plot", runPlot, argc, argv); }
