#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bumper::drawing {

/// Red, green, blue, opacity in [0, 1]; not premultiplied.
using Colour = Eigen::Vector4f;

/// A part of a list of vertices.
struct Range {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Projected already; takes no light.
struct FlatVertex {
  std::array<float, 4> clip{};  ///< OpenGL clip space
  std::array<float, 4> colour{};
};

/// Triangles, three vertices each.
using Triangles = std::vector<FlatVertex>;

/// Of a surface that takes light.
struct SurfaceVertex {
  std::array<float, 3> place{};          ///< m, in the frame of what it belongs to
  std::array<float, 3> normal{};         ///< unit, on either side
  std::array<std::uint8_t, 4> colour{};  ///< red, green, blue; the last is 255 on ground
};

/// A corner of a line that is as wide on the picture wherever it is.
struct EdgeVertex {
  std::array<float, 3> from{};
  std::array<float, 3> to{};
  std::array<float, 2> corner{};  ///< 0 at `from`, 1 at `to`; −1 and 1 on its sides
  std::array<std::uint8_t, 4> colour{};
};

/// A scene as it is handed to the driver, once. In single precision around its own middle: a vertex
/// lies within a ten-millionth of the scene's extent of where it should, the same in all pictures.
struct SceneModel {
  /// What lies in one square of the ground plan.
  struct Part {
    Eigen::AlignedBox3d box;  ///< m, relative to origin
    Range surfaces;
    Range edges;
    std::size_t casters = 0;  ///< triangles of it that throw shadows
  };

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< world
  std::vector<SurfaceVertex> surfaces;
  std::vector<EdgeVertex> edges;
  std::vector<std::array<float, 3>> casters;  ///< corners of triangles that throw shadows
  std::vector<Part> parts;
};

/// A vehicle at one of its places.
struct DrawnBody {
  Range surfaces;                                         ///< of Picture::bodies
  Eigen::Affine3f toLocal = Eigen::Affine3f::Identity();  ///< vehicle's frame to the local one
  float paleness = 0.0F;                                  ///< share of white
  float opacity = 1.0F;  ///< less than 1: of several, only the nearest shows
};

/// A line of text, over everything that was added before.
struct TextLine {
  std::string text;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< pixels: left end of the baseline
  double size = 0.0;                                ///< pixels, em
  Colour colour;
  std::vector<Eigen::AlignedBox2d> covered;  ///< areas where later things lie over it
};

/// A picture of a scene, from back to front. The local frame is the world's with an origin near
/// what the picture is about, so that single precision is enough.
struct Picture {
  int width = 0;
  int height = 0;
  double mostOverdraw = 0.0;                                  ///< that of SnapshotOptions
  Eigen::Vector3d localOrigin = Eigen::Vector3d::Zero();      ///< world
  Eigen::Matrix4d localToClip = Eigen::Matrix4d::Identity();  ///< OpenGL clip space
  Eigen::Matrix4d localToSun = Eigen::Matrix4d::Identity();   ///< the sun's clip space
  Eigen::Vector4d viewer = Eigen::Vector4d::Zero();  ///< homogeneous, local: the eye, or where to
  Eigen::Vector3d sun = Eigen::Vector3d::UnitZ();    ///< unit, towards it
  bool perspective = false;
  /// In a plan, upright surfaces and their edges have a colour of their own, with opacity 1.
  Colour wallTint = Colour::Zero();
  double edgeWidth = 1.0;       ///< pixels
  double edgeFaintest = 0.0;    ///< opacity of edges that are far
  double edgeNearer = 0.0;      ///< clip depth, so that they show on the surfaces they lie on
  double pixelsPerMetre = 1.0;  ///< where clip w is 1
  double gridSpacing = 10.0;    ///< m
  Eigen::Vector3f hazeColour = Eigen::Vector3f::Ones();
  double hazeStart = 0.0;  ///< distance from the camera, m, where haze begins …
  double hazeEnd = 0.0;    ///< … and where it hides everything; 0: no haze

  Triangles background;  ///< behind everything; then the scene
  std::vector<SurfaceVertex> bodies;
  std::vector<DrawnBody> drawnBodies;  ///< solid ones throw shadows
  Triangles ribbons;                   ///< on the ground, hidden by what stands on it
  Triangles markers;                   ///< hidden by what is nearer
  Triangles overlay;                   ///< in front of everything
  std::vector<TextLine> textLines;
};

}  // namespace bumper::drawing
