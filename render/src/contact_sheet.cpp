#include "bumper/render/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include "bumper/render/snapshot_renderer.h"
#include "bumper/response/error.h"
#include "text.h"

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
constexpr double degrees = 180.0 / std::numbers::pi;

void require(double value, double low, double high, const char* name) {
  if (value >= low && value <= high) return;
  throw Error(std::string("ContactSheetOptions::") + name + " is " + drawing::fixed(value, 0) +
              ": it must lie in " + drawing::fixed(low, 0) + " to " + drawing::fixed(high, 0));
}

void checkOptions(const Recording& recording, const ContactSheetOptions& options) {
  require(options.pictureWidth, 160, 2000, "pictureWidth");
  require(options.pictureHeight, 120, 2000, "pictureHeight");
  require(static_cast<double>(options.impacts), 1, 40, "impacts");
  require(static_cast<double>(options.instants.size()), 1, 12, "instants.size()");
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

/// The hardest, in the order of time.
std::vector<NumberedImpact> chosenImpacts(const Recording& recording, std::size_t most) {
  std::vector<NumberedImpact> impacts;
  for (const RecordedImpact& impact : recording.impacts())
    impacts.push_back({impacts.size() + 1, impact.event()});
  std::ranges::stable_sort(impacts, std::ranges::greater{},
                           [](const NumberedImpact& impact) { return impact.event.deltaV; });
  if (impacts.size() > most) impacts.resize(most);
  std::ranges::stable_sort(impacts, {},
                           [](const NumberedImpact& impact) { return impact.event.time; });
  return impacts;
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
    for (int y = 0; y < glyph.height; ++y) {
      for (int x = 0; x < glyph.width; ++x) {
        const int toX = column + glyph.left + x;
        const int toY = baseline + glyph.top + y;
        if (toX < 0 || toX >= sheet.width() || toY < 0 || toY >= sheet.height()) continue;
        const int share = glyph.coverage[static_cast<std::size_t>(y * glyph.width + x)];
        const auto mix = [&](std::uint8_t& below, std::uint8_t above) {
          below = static_cast<std::uint8_t>((below * (255 - share) + above * share) / 255);
        };
        Rgb& pixel = sheet.at(toX, toY);
        mix(pixel.red, colour.red);
        mix(pixel.green, colour.green);
        mix(pixel.blue, colour.blue);
      }
    }
    pen += drawing::advanceOf(letter) * letterSize / drawing::emHeight;
  }
}

std::string headingOf(const NumberedImpact& impact) {
  const ImpactEvent& event = impact.event;
  std::string text = "Impact " + std::to_string(impact.number) + " at " +
                     drawing::fixed(event.time, 3) + " s: Δv " + drawing::fixed(event.deltaV, 1) +
                     " m/s, closing at " + drawing::fixed(event.approachSpeed, 1) + " m/s, speed " +
                     drawing::fixed(event.speedBefore, 1) + " to " +
                     drawing::fixed(event.speedAfter, 1) + " m/s, yaw rate " +
                     drawing::fixed(event.yawRateBefore * degrees, 0) + " to " +
                     drawing::fixed(event.yawRateAfter * degrees, 0) + "°/s";
  const std::string_view wall = event.material.empty() ? event.barrier : event.material;
  if (!wall.empty()) text += ", " + std::string(wall);
  return text;
}

std::string captionOf(double offset) {
  if (offset == 0.0) return "at the impact";
  std::string text = drawing::fixed(offset, 2) + " s";
  if (offset > 0.0) text.insert(text.begin(), '+');
  return text;
}

const RecordedVehicle* vehicleOf(const Recording& recording, const ImpactEvent& event) {
  const auto vehicles = recording.vehicles();
  const auto found = std::ranges::find(vehicles, event.vehicle, &RecordedVehicle::name);
  return found == vehicles.end() ? nullptr : &*found;
}

/// From the open side of the wall, 35° off its normal to where the vehicle came from.
SnapshotOptions viewOf(const ImpactEvent& event, const RecordedVehicle& vehicle,
                       const ContactSheetOptions& options) {
  SnapshotOptions picture;
  picture.width = options.pictureWidth;
  picture.height = options.pictureHeight;
  picture.view = SnapshotView::orbit;
  picture.orbit.centre = event.contact;
  double side = 1.0;
  if (const auto before = poseAt(vehicle, event.time)) {
    const Eigen::Vector3d tangent = Eigen::Vector3d::UnitZ().cross(event.normal);
    if (tangent.dot(before->velocity) > 0.0) side = -1.0;
  }
  picture.orbit.angle = std::atan2(event.normal.y(), event.normal.x()) * degrees + side * 35.0;
  picture.orbit.elevation = 42.0;
  picture.orbit.distance =
      4.2 * (vehicle.parameters.massCentreToFront + vehicle.parameters.massCentreToRear);
  picture.showTitle = false;
  picture.showPath = false;
  return picture;
}

}  // namespace

Image contactSheet(const Scene& scene, const Recording& recording,
                   const ContactSheetOptions& options) {
  checkOptions(recording, options);
  const std::vector<NumberedImpact> impacts = chosenImpacts(recording, options.impacts);
  const auto columns = static_cast<int>(options.instants.size());
  const int width = columns * (options.pictureWidth + gap) + gap;
  const int overview = std::max(width * 2 / 5, 2 * options.pictureHeight) / 2 * 2;
  const int rowHeight = captionHeight + options.pictureHeight + captionHeight + gap;
  Image sheet(width, gap + overview + gap + static_cast<int>(impacts.size()) * rowHeight, paper);

  SnapshotRenderer renderer(scene);
  SnapshotOptions whole;
  whole.width = width - 2 * gap;
  whole.height = overview;
  whole.title = options.title;
  place(sheet, renderer.draw(recording, whole), gap, gap);

  int top = gap + overview + gap;
  for (const NumberedImpact& impact : impacts) {
    write(sheet, headingOf(impact), gap, top + baselineBelow, ink);
    const int pictures = top + captionHeight;
    const int captions = pictures + options.pictureHeight + baselineBelow;
    top += rowHeight;
    const RecordedVehicle* vehicle = vehicleOf(recording, impact.event);
    if (vehicle == nullptr || vehicle->poses.empty()) continue;
    SnapshotOptions picture = viewOf(impact.event, *vehicle, options);
    const double first = vehicle->poses.front().time;
    const double last = vehicle->poses.back().time;
    for (const double offset : options.instants) {
      const double time = impact.event.time + offset;
      if (time >= first && time <= last) picture.instants.push_back(time);
    }
    for (int column = 0; column < columns; ++column) {
      const double offset = options.instants[static_cast<std::size_t>(column)];
      const int left = gap + column * (options.pictureWidth + gap);
      write(sheet, captionOf(offset), left, captions, softInk);
      const double time = impact.event.time + offset;
      if (time < first || time > last) {
        fill(sheet, left, pictures, options.pictureWidth, options.pictureHeight, nothing);
        continue;
      }
      picture.moment = time;
      place(sheet, renderer.draw(recording, picture), left, pictures);
    }
  }
  return sheet;
}

}  // namespace bumper
