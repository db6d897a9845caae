#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace bumper::drawing {

/// Red, green, blue, opacity in [0, 1]; not premultiplied.
using Colour = Eigen::Vector4f;

/// How a surface takes light: colour × (ambient + sun × what the shadows leave of it).
struct Lighting {
  float ambient = 1.0F;
  float sun = 0.0F;
  float grid = 0.0F;  ///< 1 on ground that carries the grid
};

struct Vertex {
  std::array<float, 4> clip{};  ///< OpenGL clip space
  std::array<float, 4> colour{};
  std::array<float, 3> world{};  ///< m, relative to Picture::origin
  Lighting lighting;
};

/// Triangles, three vertices each.
using Triangles = std::vector<Vertex>;

/// A picture as flat lists, from back to front.
struct Picture {
  int width = 0;
  int height = 0;
  Eigen::Vector3d origin =
      Eigen::Vector3d::Zero();  ///< world position that vertices are relative to

  Triangles background;  ///< behind everything
  Triangles surfaces;    ///< the scene: hides what is behind it, catches shadows
  Triangles outlines;    ///< edges on surfaces
  Triangles vehicles;    ///< solid
  Triangles ribbons;     ///< on the ground, hidden by what stands on it
  Triangles ghosts;      ///< translucent, of several only the nearest shows
  Triangles overlay;     ///< in front of everything

  std::vector<Eigen::Vector3f> casters;  ///< triangles that throw shadows, relative to origin
  Eigen::Matrix4f sunView =
      Eigen::Matrix4f::Identity();  ///< relative world to the sun's clip space

  double gridSpacing = 10.0;  ///< m
  Eigen::Vector3f hazeColour = Eigen::Vector3f::Ones();
  double hazeStart = 0.0;  ///< distance from the camera, m, where haze begins …
  double hazeEnd = 0.0;    ///< … and where it hides everything; 0: no haze
};

}  // namespace bumper::drawing
