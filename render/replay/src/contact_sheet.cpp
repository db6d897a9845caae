#include "bumper/render/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "bumper/render/degrees.h"
#include "bumper/render/snapshot_renderer.h"
#include "bumper/response/error.h"
#include "camera.h"
#include "sight_lines.h"
#include "text.h"
#include "text_renderer.h"

namespace bumper {

namespace {

constexpr int gap = 12;              ///< pixels around every picture
constexpr double letterSize = 17.0;  ///< of the em, pixels
constexpr int captionHeight = 28;    ///< pixels
constexpr int baselineBelow = 19;    ///< pixels below a caption's upper edge
constexpr Rgb paper{250, 250, 250};
constexpr Rgb nothing{228, 230, 232};
constexpr Rgb ink{25, 28, 32};
constexpr Rgb softInk{92, 98, 106};
constexpr double sameRow = 0.3;          ///< s
constexpr std::size_t mostHeadings = 6;  ///< of a row, its hardest impacts

void requireOption(double value, double low, double high, const char* name) {
  if (value >= low && value <= high) return;
  throw Error(std::string("ContactSheetOptions::") + name + " is " + drawing::fixed(value, 0) +
              ": it must lie in " + drawing::fixed(low, 0) + " to " + drawing::fixed(high, 0));
}

void checkOptions(const Recording& recording, const ContactSheetOptions& options) {
  requireOption(options.pictureWidth, 160, 2000, "pictureWidth");
  requireOption(options.pictureHeight, 120, 2000, "pictureHeight");
  requireOption(static_cast<double>(options.impacts), 1, 40, "impacts");
  requireOption(static_cast<double>(options.instants.size()), 1, 12, "instants.size()");
  const auto isBad = [](double time) { return !std::isfinite(time); };
  if (std::ranges::any_of(options.instants, isBad) || !std::ranges::is_sorted(options.instants))
    throw Error("ContactSheetOptions::instants must be finite and in ascending order");
  const auto isEmpty = [](const RecordedVehicle& vehicle) { return vehicle.poses.empty(); };
  if (std::ranges::all_of(recording.vehicles(), isEmpty))
    throw Error("a contact sheet needs a recording with poses");
}

struct NumberedImpact {
  std::size_t number = 0;  ///< from 1, in the recording's order
  ImpactEvent event;
};

/// Impacts that one row of pictures shows, in the order of time.
using Row = std::vector<NumberedImpact>;

const ImpactEvent& hardestOf(const Row& row) {
  return std::ranges::max_element(
             row, {}, [](const NumberedImpact& impact) { return hardness(impact.event); })
      ->event;
}

/// Whether a vehicle that the row of `first` shows takes part in both.
bool isSameParty(const ImpactEvent& first, const ImpactEvent& second) {
  return asSeenBy(first.vehicle, second) ||
         (!first.otherVehicle.empty() && asSeenBy(first.otherVehicle, second));
}

/// The hardest impacts; one that comes soon after or before a harder one joins its row.
std::vector<Row> rowsOf(const Recording& recording, std::size_t most) {
  std::vector<NumberedImpact> impacts;
  for (const RecordedImpact& impact : recording.impacts())
    impacts.push_back({impacts.size() + 1, impact.event()});
  std::ranges::stable_sort(impacts, std::ranges::greater{},
                           [](const NumberedImpact& impact) { return hardness(impact.event); });
  std::vector<Row> rows;
  for (const NumberedImpact& impact : impacts) {
    const auto joined = std::ranges::find_if(rows, [&](const Row& row) {
      const ImpactEvent& first = row.front().event;
      return isSameParty(first, impact.event) &&
             std::abs(first.time - impact.event.time) <= sameRow;
    });
    if (joined != rows.end())
      joined->push_back(impact);
    else if (rows.size() < most)
      rows.push_back({impact});
  }
  const auto time = [](const NumberedImpact& impact) { return impact.event.time; };
  for (Row& row : rows) {
    if (row.size() > mostHeadings) row.resize(mostHeadings);
    std::ranges::stable_sort(row, {}, time);
  }
  std::ranges::stable_sort(rows, {}, [&](const Row& row) { return time(row.front()); });
  return rows;
}

void fill(Image& sheet, int left, int top, int width, int height, Rgb colour) {
  for (int y = std::max(top, 0); y < std::min(top + height, sheet.height()); ++y) {
    for (int x = std::max(left, 0); x < std::min(left + width, sheet.width()); ++x)
      sheet.at(x, y) = colour;
  }
}

void place(Image& sheet, const Image& picture, int left, int top) {
  for (int y = 0; y < picture.height(); ++y)
    std::copy_n(&picture.at(0, y), picture.width(), &sheet.at(left, top + y));
}

/// With its baseline's left end there.
void write(Image& sheet, const std::string& line, int left, int baseline, Rgb colour) {
  double pen = left;
  for (const char32_t letter : drawing::lettersOf(line)) {
    const int column = static_cast<int>(std::floor(pen));
    const drawing::Glyph glyph = drawing::glyphOf(letter, letterSize, pen - column);
    drawing::blendGlyph(glyph, column, baseline, sheet, [&](Rgb& pixel, int share, int, int) {
      const auto mix = [&](std::uint8_t& below, std::uint8_t above) {
        below = static_cast<std::uint8_t>((below * (255 - share) + above * share) / 255);
      };
      mix(pixel.red, colour.red);
      mix(pixel.green, colour.green);
      mix(pixel.blue, colour.blue);
    });
    pen += drawing::advanceOf(letter) * letterSize / drawing::emHeight;
  }
}

std::string motionOf(const ImpactEvent& event) {
  return "speed " + drawing::fixed(event.speedBefore, 1) + " to " +
         drawing::fixed(event.speedAfter, 1) + " m/s, yaw rate " +
         drawing::fixed(event.yawRateBefore * degrees, 0) + " to " +
         drawing::fixed(event.yawRateAfter * degrees, 0) + "°/s";
}

/// One line, or of two vehicles one more for each that is known; named if there are several.
std::vector<std::string> headingOf(const NumberedImpact& impact, const Recording& recording) {
  const ImpactEvent& event = impact.event;
  const auto deltaV = [](const ImpactEvent& e) {
    return "Δv " + drawing::fixed(e.deltaV, 1) + " m/s, ";
  };
  const std::string closing = "closing at " + drawing::fixed(event.approachSpeed, 1) + " m/s";
  const std::string start =
      "Impact " + std::to_string(impact.number) + " at " + drawing::fixed(event.time, 3) + " s: ";
  const std::string_view wall = event.material.empty() ? event.barrier : event.material;
  const auto other = asSeenBy(event.otherVehicle, event);
  if (!other) {
    const bool several = recording.vehicles().size() > 1;
    const std::string name = several ? std::string(event.vehicle) + ", " : "";
    const std::string line = start + name + deltaV(event) + closing + ", " + motionOf(event);
    return {wall.empty() ? line : line + ", " + std::string(wall)};
  }
  std::vector<std::string> lines{start + std::string(event.vehicle) + " and " +
                                 std::string(event.otherVehicle) + ", " + closing};
  for (const ImpactEvent& each : {event, *other}) {
    if (std::isfinite(each.deltaV))
      lines.push_back(std::string(each.vehicle) + ": " + deltaV(each) + motionOf(each));
  }
  return lines;
}

std::string captionOf(double offset) {
  if (offset == 0.0) return "at the impact";
  std::string text = drawing::fixed(offset, 2) + " s";
  if (offset > 0.0) text.insert(text.begin(), '+');
  return text;
}

/// Those of an impact that were recorded at its time, the one that the event is about first.
std::vector<const RecordedVehicle*> vehiclesOf(const Recording& recording,
                                               const ImpactEvent& event) {
  std::vector<const RecordedVehicle*> vehicles;
  for (const std::string_view name : {event.vehicle, event.otherVehicle}) {
    const auto found = std::ranges::find(recording.vehicles(), name, &RecordedVehicle::name);
    if (found != recording.vehicles().end() && poseAt(*found, event.time))
      vehicles.push_back(&*found);
  }
  return vehicles;
}

/// Points of vehicles that should be seen at all the instants: their mass centres, and their
/// corners half way up.
std::vector<Eigen::Vector3d> watchedPoints(const std::vector<const RecordedVehicle*>& vehicles,
                                           const std::vector<double>& times) {
  std::vector<Eigen::Vector3d> points;
  for (const RecordedVehicle* vehicle : vehicles) {
    const VehicleParameters& p = vehicle->parameters;
    for (const double time : times) {
      const auto pose = poseAt(*vehicle, time);
      if (!pose) continue;
      points.push_back(pose->position);
      for (const double x : {p.massCentreToFront, -p.massCentreToRear}) {
        for (const double y : {-0.5 * p.width, 0.5 * p.width})
          points.emplace_back(pose->position + pose->orientation * Eigen::Vector3d(x, y, 0.0));
      }
    }
  }
  return points;
}

/// From the open side of the wall, 25° off its normal to where the vehicle came from, or from where
/// less of the vehicle is hidden; its places at all the instants in sight.
SnapshotOptions viewOf(const ImpactEvent& event,
                       const std::vector<const RecordedVehicle*>& vehicles,
                       const std::vector<double>& times, const ContactSheetOptions& options,
                       const drawing::SightLines& sight) {
  const RecordedVehicle& vehicle = *vehicles.front();
  SnapshotOptions picture;
  picture.width = options.pictureWidth;
  picture.height = options.pictureHeight;
  picture.view = SnapshotView::orbit;
  Eigen::AlignedBox3d places(event.contact);
  for (const RecordedVehicle* each : vehicles) {
    for (const double time : times) {
      if (const auto pose = poseAt(*each, time)) places.extend(pose->position);
    }
  }
  picture.orbit.centre = places.center();
  const double length = vehicle.parameters.massCentreToFront + vehicle.parameters.massCentreToRear;
  constexpr double halfWidth = 0.37;  // of the view, over the distance
  picture.orbit.distance = std::clamp((0.5 * places.diagonal().norm() + 0.6 * length) / halfWidth,
                                      4.2 * length, 9.0 * length);
  const auto now = poseAt(vehicle, event.time);
  const Eigen::Vector3d tangent = Eigen::Vector3d::UnitZ().cross(event.normal);
  const double side = now && tangent.dot(now->velocity) > 0.0 ? -1.0 : 1.0;
  const std::vector<Eigen::Vector3d> watched = watchedPoints(vehicles, times);
  auto least = std::numeric_limits<int>::max();
  for (const double elevation : {42.0, 26.0, 62.0}) {
    for (const double turn : {25.0, -25.0, 62.0, -62.0}) {
      OrbitCamera orbit = picture.orbit;
      orbit.angle = std::atan2(event.normal.y(), event.normal.x()) * degrees + side * turn;
      orbit.elevation = elevation;
      const int hidden = sight.hidden(watched, drawing::eyeOf(orbit, *orbit.centre));
      if (hidden >= least) continue;
      least = hidden;
      picture.orbit = orbit;
    }
  }
  picture.vehicleMeshes = options.vehicleMeshes;
  picture.showTitle = false;
  picture.showPath = false;
  picture.showScaleBar = false;
  return picture;
}

/// The earlier instants at which the vehicle was clear of where it is now, and the end.
std::vector<double> ghostsAt(double now, const RecordedVehicle& vehicle,
                             const std::vector<double>& times) {
  const double length = vehicle.parameters.massCentreToFront + vehicle.parameters.massCentreToRear;
  std::vector<double> ghosts;
  for (const double time : times) {
    if (time >= now) break;
    const Eigen::Vector3d way = poseAt(vehicle, now)->position - poseAt(vehicle, time)->position;
    if (way.norm() > 0.6 * length) ghosts.push_back(time);
  }
  if (!ghosts.empty()) ghosts.push_back(times.back());
  return ghosts;
}

/// A row's pictures with their captions; `top` is the pictures' upper edge.
void drawPictures(Image& sheet, int top, const Row& row, const Recording& recording,
                  const ContactSheetOptions& options, const drawing::SightLines& sight,
                  SnapshotRenderer& renderer) {
  const ImpactEvent& event = hardestOf(row);
  const std::vector<const RecordedVehicle*> vehicles = vehiclesOf(recording, event);
  if (vehicles.empty()) return;
  const RecordedVehicle& vehicle = *vehicles.front();
  const auto isRecorded = [&](double time) { return poseAt(vehicle, time).has_value(); };
  std::vector<double> times;
  for (const double offset : options.instants) {
    if (isRecorded(event.time + offset)) times.push_back(event.time + offset);
  }
  SnapshotOptions picture = viewOf(event, vehicles, times, options, sight);
  int left = gap;
  for (const double offset : options.instants) {
    write(sheet, captionOf(offset), left, top + options.pictureHeight + baselineBelow, softInk);
    if (isRecorded(event.time + offset)) {
      picture.moment = event.time + offset;
      picture.instants = ghostsAt(*picture.moment, vehicle, times);
      place(sheet, renderer.draw(recording, picture), left, top);
    } else {
      fill(sheet, left, top, options.pictureWidth, options.pictureHeight, nothing);
    }
    left += options.pictureWidth + gap;
  }
}

}  // namespace

Image contactSheet(const Scene& scene, const Recording& recording,
                   const ContactSheetOptions& options) {
  checkOptions(recording, options);
  const std::vector<Row> rows = rowsOf(recording, options.impacts);
  const int width = static_cast<int>(options.instants.size()) * (options.pictureWidth + gap) + gap;
  const int overview = std::max(width * 2 / 5, options.pictureHeight);
  const auto headings = [&](const Row& row) {
    std::size_t lines = 0;
    for (const NumberedImpact& impact : row) lines += headingOf(impact, recording).size();
    return static_cast<int>(lines) * captionHeight;
  };
  int height = gap + overview + gap;
  for (const Row& row : rows) height += headings(row) + options.pictureHeight + captionHeight + gap;
  Image sheet(width, height, paper);

  SnapshotRenderer renderer(scene);
  const drawing::SightLines sight(scene);
  SnapshotOptions whole;
  whole.width = width - 2 * gap;
  whole.height = overview;
  whole.title = options.title;
  whole.vehicleMeshes = options.vehicleMeshes;
  place(sheet, renderer.draw(recording, whole), gap, gap);

  int top = gap + overview + gap;
  for (const Row& row : rows) {
    for (const NumberedImpact& impact : row) {
      for (const std::string& line : headingOf(impact, recording)) {
        write(sheet, line, gap, top + baselineBelow, ink);
        top += captionHeight;
      }
    }
    drawPictures(sheet, top, row, recording, options, sight, renderer);
    top += options.pictureHeight + captionHeight + gap;
  }
  return sheet;
}

}  // namespace bumper
