#include "place_pictures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "bumper/base/output_file.h"
#include "bumper/render/snapshot_renderer.h"
#include "bumper/response/outline.h"
#include "marks.h"

namespace bumper::doctor {

namespace {

constexpr Rgb wrongColour{214, 30, 30};
constexpr Rgb rightColour{20, 90, 200};
constexpr Rgb trueColour{10, 140, 60};
constexpr Rgb jointColour{200, 40, 40};
constexpr Rgb bumperColour{30, 100, 210};
constexpr Rgb startColour{90, 90, 90};

std::string legendOf(const WorstPlace& place) {
  if (place.isStanding) return " (red; right: blue; the wall's own: green)";
  return place.drive ? " (contact joints: red, Bumper: blue)" : "";
}

class Painter {
 public:
  Painter(const Subject& subject, const Examination& examination)
      : subject_(subject),
        walls_(examination.walls.walls),
        renderer_(subject.scene),
        joints_(subject, walls_),
        bumper_(subject) {}

  Image draw(const WorstPlace& place) {
    Recording recording;
    DriveTrace joints;
    DriveTrace bumper;
    std::size_t worst = 0;
    if (place.drive && !place.isStanding) {
      joints = joints_.run(*place.drive);
      bumper = bumper_.run(*place.drive);
      worst = suddenLoss(joints, *place.drive, subject_.step, caughtWithin).step;
    }
    const SnapshotOptions options = viewOf(place);
    Image image = renderer_.draw(recording, options);
    const auto pixel = [&](const Eigen::Vector3d& point) {
      return renderer_.project(recording, options, point);
    };
    if (place.triangle) markTriangle(image, *place.triangle, pixel);
    if (!place.drive) markPoint(image, place, pixel);
    if (place.isStanding) {
      drawOutline(image, startOf(*place.drive), jointColour, pixel);
      drawNormals(image, joints_.contactsAt(*place.drive), place, pixel);
    } else if (place.drive) {
      drawOutline(image, joints.states.front(), startColour, pixel);
      drawWay(image, bumper, bumperColour, pixel);
      drawWay(image, joints, jointColour, pixel);
      drawOutline(image, bumper.states.back(), bumperColour, pixel);
      drawOutline(image, joints.states.back(), jointColour, pixel);
      std::erase_if(joints.contacts, [&](const DriveContact& c) { return c.step != worst; });
      drawNormals(image, joints.contacts, place, pixel);
    }
    return image;
  }

 private:
  SnapshotOptions viewOf(const WorstPlace& place) const {
    Eigen::Vector2d out = place.out.head<2>();
    out = out.norm() > 1e-6 ? Eigen::Vector2d(out.normalized()) : Eigen::Vector2d::UnitX();
    const Eigen::Vector2d along(-out.y(), out.x());
    // A step of millimetres is seen from near only.
    const bool isSmall = !place.drive && !place.triangle;
    const double distance = (isSmall ? 0.4 : 2.4) * subject_.length();
    const Eigen::Vector2d aside = distance * (0.75 * out + 0.35 * along);
    SnapshotOptions options;
    options.view = SnapshotView::fixed;
    options.title = place.words + legendOf(place);
    options.fixed = {.eye = place.position + Eigen::Vector3d(aside.x(), aside.y(), 0.85 * distance),
                     .target = place.position};
    return options;
  }

  DriveState startOf(const TestDrive& drive) const {
    const Eigen::Matrix3d axes =
        drive.plane.axes *
        Eigen::AngleAxisd(drive.start.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return {.position = drive.plane.world(drive.start.position),
            .orientation = Eigen::Quaterniond(axes)};
  }

  template <typename Pixel>
  void line(Image& image, const Eigen::Vector3d& from, const Eigen::Vector3d& to, Rgb colour,
            double width, const Pixel& pixel, bool isArrow = false) const {
    const auto a = pixel(from);
    const auto b = pixel(to);
    if (!a || !b) return;
    (isArrow ? drawArrow : drawLine)(image, *a, *b, colour, width);
  }

  template <typename Pixel>
  void drawOutline(Image& image, const DriveState& state, Rgb colour, const Pixel& pixel) const {
    const auto corners = Outline(subject_.vehicle).corners();
    const auto world = [&](const Vector2& corner) -> Eigen::Vector3d {
      return state.position + state.orientation * Eigen::Vector3d(corner.x(), corner.y(), 0.0);
    };
    for (std::size_t k = 0; k < 4; ++k)
      line(image, world(corners.at(k)), world(corners.at((k + 1) % 4)), colour, 2.5, pixel);
    // Which way is forward.
    const Vector2 front(subject_.vehicle.massCentreToFront, 0.0);
    line(image, world(0.5 * front), world(front), colour, 2.5, pixel, true);
  }

  template <typename Pixel>
  void drawWay(Image& image, const DriveTrace& trace, Rgb colour, const Pixel& pixel) const {
    for (std::size_t i = 0; i + 1 < trace.states.size(); ++i) {
      line(image, trace.states[i].position, trace.states[i + 1].position, colour, 2.0, pixel);
    }
  }

  template <typename Pixel>
  void drawNormals(Image& image, const std::vector<DriveContact>& contacts, const WorstPlace& place,
                   const Pixel& pixel) const {
    const double length = 0.25 * subject_.length();
    const Eigen::Vector3d inside = place.position + subject_.length() * place.out;
    for (const DriveContact& contact : contacts) {
      if (contact.wall < 0) continue;
      const Eigen::Vector3d right =
          trueNormal(walls_[static_cast<std::size_t>(contact.wall)], inside);
      if (place.isStanding && !isOfWall(right, place.drive->plane)) continue;
      const bool isWrong = right.dot(contact.normal) < std::cos(wrongNormal);
      line(image, contact.place, contact.place + length * right, trueColour, 2.0, pixel, true);
      line(image, contact.place, contact.place + length * contact.normal,
           isWrong ? wrongColour : rightColour, 2.5, pixel, true);
    }
  }

  template <typename Pixel>
  void markTriangle(Image& image, std::size_t index, const Pixel& pixel) const {
    const Scene::Triangle& triangle = subject_.scene.triangles[index];
    for (std::size_t k = 0; k < 3; ++k) {
      line(image, subject_.scene.corner(triangle, k), subject_.scene.corner(triangle, (k + 1) % 3),
           wrongColour, 3.0, pixel);
    }
  }

  template <typename Pixel>
  void markPoint(Image& image, const WorstPlace& place, const Pixel& pixel) const {
    const double size = 0.04 * subject_.length();
    line(image, place.position + size * (place.out + Eigen::Vector3d::UnitZ()), place.position,
         wrongColour, 2.5, pixel, true);
  }

  const Subject& subject_;
  const std::vector<Wall>& walls_;
  SnapshotRenderer renderer_;
  JointRig joints_;
  BumperRig bumper_;
};

}  // namespace

std::vector<std::string> drawPlaces(const Subject& subject, const Examination& examination,
                                    std::span<const WorstPlace> places,
                                    const std::filesystem::path& folder) {
  makeFolder(folder);
  Painter painter(subject, examination);
  std::vector<std::string> files;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::filesystem::path file =
        folder / (std::to_string(i + 1) + "_" + places[i].kind + ".png");
    writePng(painter.draw(places[i]), file);
    files.push_back(file.string());
  }
  return files;
}

}  // namespace bumper::doctor
