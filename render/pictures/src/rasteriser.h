#pragma once

#include <cstddef>
#include <span>

#include "bumper/render/image.h"
#include "gl_functions.h"
#include "offscreen_context.h"
#include "picture.h"

namespace bumper::drawing {

/// Draws pictures of one scene in one context. Every object that it makes there is freed by the
/// context's end. The context must be in use whenever a rasteriser is.
class Rasteriser {
 public:
  /// Hands the scene to the driver. Throws Error if the driver fails.
  Rasteriser(const OffscreenContext& context, const SceneModel& scene);

  /// All of a picture but its text, with four samples per pixel. Throws Error if the driver
  /// fails or the size lies beyond its limits.
  Image draw(const Picture& picture);

 private:
  /// Vertices that are handed over together, and how they are read.
  struct Buffer {
    GLuint array = 0;
    GLuint vertices = 0;
  };
  /// Where a picture is drawn, and where its samples come together.
  struct Target {
    int width = 0;
    int height = 0;
    GLuint samples = 0;
    GLuint pixels = 0;
    std::array<GLuint, 3> parts{};
  };

  [[nodiscard]] GLint limit(GLenum name) const;
  [[nodiscard]] GLuint shader(GLenum kind, const char* source) const;
  [[nodiscard]] GLuint program(const char* vertex, const char* fragment) const;
  [[nodiscard]] Buffer makeBuffer() const;
  void attribute(GLuint place, GLint size, GLenum type, std::size_t stride,
                 std::size_t offset) const;
  template <typename Vertex>
  void fill(const Buffer& buffer, std::span<const Vertex> vertices, GLenum usage) const;
  void readAsSurfaces() const;
  void makeShadowMap();
  void checkFramebuffer(const Picture& picture) const;
  void makeTarget(const Picture& picture);
  void setMatrix(GLuint program, const char* name, const Eigen::Matrix4d& matrix) const;
  void drawRanges(const std::vector<Range>& ranges) const;
  void drawShadowMap(const Picture& picture) const;
  void setUniforms(const Picture& picture) const;
  void chooseParts(const Picture& picture);
  void drawScene(const Picture& picture) const;
  void drawEdges(const Picture& picture) const;
  void drawBodies(const Picture& picture, bool ghosts) const;
  void drawLayers(const Picture& picture) const;
  [[nodiscard]] Image readBack() const;

  GlFunctions gl_;
  Eigen::Vector3d sceneOrigin_;
  std::vector<SceneModel::Part> parts_;
  std::vector<Range> seenSurfaces_;
  std::vector<Range> seenEdges_;
  std::size_t casterCount_ = 0;
  GLuint lit_ = 0;
  GLuint edge_ = 0;
  GLuint flat_ = 0;
  GLuint caster_ = 0;
  Buffer surfaces_;
  Buffer edges_;
  Buffer casters_;
  Buffer bodies_;
  Buffer layers_;
  GLuint shadowMap_ = 0;
  GLuint shadowTarget_ = 0;
  Target target_;
};

}  // namespace bumper::drawing
