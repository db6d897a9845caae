#include "rasteriser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "bumper/response/error.h"

namespace bumper::drawing {

namespace {

constexpr int wantedSamples = 4;
constexpr int shadowSide = 1024;

// A picture's rows go down, OpenGL's up: everything is drawn upside down.
constexpr const char* surfaceVertexSource = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
uniform mat4 toLocal;
uniform mat4 localToClip;
uniform mat4 localToSun;
uniform vec4 viewer;
uniform vec3 sun;
uniform vec4 wallTint;
uniform float paleness;
uniform float opacity;
uniform float gridPerMetre;
uniform vec2 gridStart;
uniform float shadowScale;
flat out vec4 surfaceColour;
flat out vec3 lighting;
out vec2 ground;
out vec3 inShadowMap;
void main() {
  vec3 local = (toLocal * vec4(place, 1.0)).xyz;
  vec4 clip = localToClip * vec4(local, 1.0);
  gl_Position = vec4(clip.x, -clip.y, clip.zw);
  // Files do not always say which side is out: the side that is seen is.
  vec3 out_ = mat3(toLocal) * normal;
  if (dot(out_, viewer.xyz - viewer.w * local) < 0.0) out_ = -out_;
  lighting = vec3(0.60 + 0.10 * out_.z, 0.46 * max(0.0, dot(out_, sun)), colour.a);
  vec3 tinted = mix(colour.rgb, wallTint.rgb, (1.0 - colour.a) * wallTint.a);
  surfaceColour = vec4(mix(tinted, vec3(1.0), paleness), opacity);
  ground = local.xy * gridPerMetre + gridStart;
  inShadowMap = (localToSun * vec4(local, 1.0)).xyz * vec3(vec2(shadowScale), 0.5) + 0.5;
}
)";

constexpr const char* litFragmentSource = R"(#version 330 core
flat in vec4 surfaceColour;
flat in vec3 lighting;
in vec2 ground;
in vec3 inShadowMap;
uniform sampler2DShadow shadowMap;
uniform vec3 hazeColour;
uniform float hazeStart;
uniform float hazePerMetre;
out vec4 drawn;

float gridLine() {
  vec2 perPixel = max(fwidth(ground), vec2(1e-6));
  vec2 distance = abs(fract(ground + 0.5) - 0.5) / perPixel;
  vec2 line = clamp(1.0 - distance, 0.0, 1.0) * clamp(1.5 - 6.0 * perPixel, 0.0, 1.0);
  return max(line.x, line.y);
}

void main() {
  float light = lighting.x + lighting.y * texture(shadowMap, inShadowMap);
  vec3 colour = surfaceColour.rgb * light * (1.0 - 0.08 * lighting.z * gridLine());
  float haze = clamp((1.0 / gl_FragCoord.w - hazeStart) * hazePerMetre, 0.0, 1.0);
  drawn = vec4(mix(colour, hazeColour, haze * haze * (3.0 - 2.0 * haze)), surfaceColour.a);
}
)";

constexpr const char* edgeVertexSource = R"(#version 330 core
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec2 corner;
layout(location = 3) in vec4 colour;
uniform mat4 toLocal;
uniform mat4 localToClip;
uniform vec4 wallTint;
uniform vec2 halfSize;
uniform float pixelsPerMetre;
uniform float width;
uniform float faintest;
uniform float nearer;
out vec4 surfaceColour;
void main() {
  vec4 a = localToClip * toLocal * vec4(from, 1.0);
  vec4 b = localToClip * toLocal * vec4(to, 1.0);
  // Cut off what lies before the near plane.
  float insideA = a.z + a.w;
  float insideB = b.z + b.w;
  if (insideA < 0.0 && insideB > 0.0) a += (b - a) * (insideA / (insideA - insideB));
  if (insideB < 0.0 && insideA > 0.0) b += (a - b) * (insideB / (insideB - insideA));
  vec2 way = (b.xy / b.w - a.xy / a.w) * halfSize;
  float far = length(way);
  bool seen = insideA > 0.0 || insideB > 0.0;
  vec2 across = seen && far > 1e-6 ? vec2(-way.y, way.x) / far : vec2(0.0);
  vec4 clip = corner.x < 0.5 ? a : b;
  clip.xy += 0.5 * width * corner.y * across / halfSize * clip.w;
  clip.z -= nearer * clip.w;
  gl_Position = seen ? vec4(clip.x, -clip.y, clip.zw) : vec4(0.0, 0.0, -2.0, 1.0);
  // Far lines become fainter instead of crowding.
  float faint = clamp(pixelsPerMetre / clip.w / 7.0 - 0.2, faintest, 1.0);
  surfaceColour = vec4(mix(colour.rgb, wallTint.rgb, wallTint.a), faint);
}
)";

constexpr const char* flatVertexSource = R"(#version 330 core
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 colour;
out vec4 surfaceColour;
void main() {
  gl_Position = vec4(clip.x, -clip.y, clip.zw);
  surfaceColour = colour;
}
)";

constexpr const char* flatFragmentSource = R"(#version 330 core
in vec4 surfaceColour;
out vec4 drawn;
void main() { drawn = surfaceColour; }
)";

constexpr const char* shadowVertexSource = R"(#version 330 core
layout(location = 0) in vec3 place;
uniform mat4 toLocal;
uniform mat4 localToSun;
void main() { gl_Position = localToSun * toLocal * vec4(place, 1.0); }
)";

constexpr const char* shadowFragmentSource = R"(#version 330 core
void main() {}
)";

Eigen::Matrix4d movedBy(const Eigen::Vector3d& way) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topRightCorner<3, 1>() = way;
  return matrix;
}

/// Whether nothing of a box can be seen: all of its corners lie beyond one side of the picture.
bool outside(const Eigen::AlignedBox3d& box, const Eigen::Matrix4d& toClip) {
  constexpr double edgesReachFarther = 1.02;
  std::array<int, 6> beyond{};
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector4d clip =
        toClip * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)).homogeneous();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = clip[static_cast<Eigen::Index>(axis)];
      const double most = edgesReachFarther * clip.w();
      beyond[2 * axis] += place > most ? 1 : 0;
      beyond[2 * axis + 1] += place < -most ? 1 : 0;
    }
  }
  return std::ranges::find(beyond, 8) != beyond.end();
}

/// The share of a picture that a box covers at most.
double coveredShare(const Eigen::AlignedBox3d& box, const Eigen::Matrix4d& toClip) {
  Eigen::AlignedBox2d covered;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector4d clip =
        toClip * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)).homogeneous();
    if (!(clip.w() > 1e-9)) return 1.0;  // around the camera
    covered.extend(Eigen::Vector2d(clip.head<2>() / clip.w()));
  }
  const Eigen::Vector2d all = Eigen::Vector2d::Ones();
  covered = covered.intersection(Eigen::AlignedBox2d(-all, all));
  return covered.isEmpty() ? 0.0 : 0.25 * covered.volume();
}

/// Adds a range to a list, to the last of it if they join.
void join(const Range& range, std::vector<Range>& ranges) {
  if (range.count == 0) return;
  if (!ranges.empty() && ranges.back().first + ranges.back().count == range.first)
    ranges.back().count += range.count;
  else
    ranges.push_back(range);
}

}  // namespace

Rasteriser::Rasteriser(const OffscreenContext& context, const SceneModel& scene)
    : gl_(context),
      sceneOrigin_(scene.origin),
      parts_(scene.parts),
      casterCount_(scene.casters.size()),
      lit_(program(surfaceVertexSource, litFragmentSource)),
      edge_(program(edgeVertexSource, flatFragmentSource)),
      flat_(program(flatVertexSource, flatFragmentSource)),
      caster_(program(shadowVertexSource, shadowFragmentSource)),
      surfaces_(makeBuffer()),
      edges_(makeBuffer()),
      casters_(makeBuffer()),
      bodies_(makeBuffer()),
      layers_(makeBuffer()) {
  fill<SurfaceVertex>(surfaces_, scene.surfaces, GL_STATIC_DRAW);
  readAsSurfaces();
  fill<EdgeVertex>(edges_, scene.edges, GL_STATIC_DRAW);
  attribute(0, 3, GL_FLOAT, sizeof(EdgeVertex), offsetof(EdgeVertex, from));
  attribute(1, 3, GL_FLOAT, sizeof(EdgeVertex), offsetof(EdgeVertex, to));
  attribute(2, 2, GL_FLOAT, sizeof(EdgeVertex), offsetof(EdgeVertex, corner));
  attribute(3, 4, GL_UNSIGNED_BYTE, sizeof(EdgeVertex), offsetof(EdgeVertex, colour));
  fill<std::array<float, 3>>(casters_, scene.casters, GL_STATIC_DRAW);
  attribute(0, 3, GL_FLOAT, sizeof(std::array<float, 3>), 0);
  fill<SurfaceVertex>(bodies_, {}, GL_STREAM_DRAW);
  readAsSurfaces();
  fill<FlatVertex>(layers_, {}, GL_STREAM_DRAW);
  attribute(0, 4, GL_FLOAT, sizeof(FlatVertex), offsetof(FlatVertex, clip));
  attribute(1, 4, GL_FLOAT, sizeof(FlatVertex), offsetof(FlatVertex, colour));
  makeShadowMap();
}

Image Rasteriser::draw(const Picture& picture) {
  chooseParts(picture);
  makeTarget(picture);
  fill<SurfaceVertex>(bodies_, picture.bodies, GL_STREAM_DRAW);
  drawShadowMap(picture);
  drawLayers(picture);
  Image image = readBack();
  if (gl_.GetError() != GL_NO_ERROR) throw Error("OpenGL reports an error after drawing");
  return image;
}

GLint Rasteriser::limit(GLenum name) const {
  std::array<GLint, 2> value{};
  gl_.GetIntegerv(name, value.data());
  return value[0];
}

GLuint Rasteriser::shader(GLenum kind, const char* source) const {
  const GLuint name = gl_.CreateShader(kind);
  gl_.ShaderSource(name, 1, &source, nullptr);
  gl_.CompileShader(name);
  GLint compiled = GL_FALSE;
  gl_.GetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return name;
  std::array<GLchar, 1024> log{};
  gl_.GetShaderInfoLog(name, log.size(), nullptr, log.data());
  throw Error(std::string("the driver rejects a shader: ") + log.data());
}

GLuint Rasteriser::program(const char* vertex, const char* fragment) const {
  const GLuint name = gl_.CreateProgram();
  gl_.AttachShader(name, shader(GL_VERTEX_SHADER, vertex));
  gl_.AttachShader(name, shader(GL_FRAGMENT_SHADER, fragment));
  gl_.LinkProgram(name);
  GLint linked = GL_FALSE;
  gl_.GetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return name;
  std::array<GLchar, 1024> log{};
  gl_.GetProgramInfoLog(name, log.size(), nullptr, log.data());
  throw Error(std::string("the driver cannot link the shaders: ") + log.data());
}

Rasteriser::Buffer Rasteriser::makeBuffer() const {
  Buffer buffer;
  gl_.GenVertexArrays(1, &buffer.array);
  gl_.GenBuffers(1, &buffer.vertices);
  return buffer;
}

void Rasteriser::attribute(GLuint place, GLint size, GLenum type, std::size_t stride,
                           std::size_t offset) const {
  gl_.EnableVertexAttribArray(place);
  gl_.VertexAttribPointer(place, size, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                          static_cast<GLsizei>(stride),
                          // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL passes offsets so
                          reinterpret_cast<const void*>(offset));
}

/// Leaves the buffer bound.
template <typename Vertex>
void Rasteriser::fill(const Buffer& buffer, std::span<const Vertex> vertices, GLenum usage) const {
  gl_.BindVertexArray(buffer.array);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.vertices);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
                 usage);
}

void Rasteriser::readAsSurfaces() const {
  attribute(0, 3, GL_FLOAT, sizeof(SurfaceVertex), offsetof(SurfaceVertex, place));
  attribute(1, 3, GL_FLOAT, sizeof(SurfaceVertex), offsetof(SurfaceVertex, normal));
  attribute(2, 4, GL_UNSIGNED_BYTE, sizeof(SurfaceVertex), offsetof(SurfaceVertex, colour));
}

void Rasteriser::makeShadowMap() {
  gl_.GenTextures(1, &shadowMap_);
  gl_.BindTexture(GL_TEXTURE_2D, shadowMap_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, shadowSide, shadowSide, 0,
                 GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

  gl_.GenFramebuffers(1, &shadowTarget_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, shadowTarget_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadowMap_, 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error("the driver cannot draw shadows");
}

void Rasteriser::checkFramebuffer(const Picture& picture) const {
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  throw Error("the driver cannot draw into a framebuffer of " + std::to_string(picture.width) +
              " x " + std::to_string(picture.height) + " pixels");
}

/// Keeps the one there is if it has the size.
void Rasteriser::makeTarget(const Picture& picture) {
  if (picture.width == target_.width && picture.height == target_.height) return;
  std::array<GLint, 2> viewport{};
  gl_.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  const GLint side = limit(GL_MAX_RENDERBUFFER_SIZE);
  const GLint widest = std::min(side, viewport[0]);
  const GLint highest = std::min(side, viewport[1]);
  if (picture.width > widest || picture.height > highest)
    throw Error("a picture of " + std::to_string(picture.width) + " x " +
                std::to_string(picture.height) + " pixels: this driver allows " +
                std::to_string(widest) + " x " + std::to_string(highest));

  gl_.DeleteFramebuffers(1, &target_.samples);
  gl_.DeleteFramebuffers(1, &target_.pixels);
  gl_.DeleteRenderbuffers(static_cast<GLsizei>(target_.parts.size()), target_.parts.data());
  target_ = {};
  gl_.GenFramebuffers(1, &target_.samples);
  gl_.GenFramebuffers(1, &target_.pixels);
  gl_.GenRenderbuffers(static_cast<GLsizei>(target_.parts.size()), target_.parts.data());
  const auto attach = [&](GLuint part, GLenum attachment, GLenum format, GLsizei samples) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, part);
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, picture.width,
                                       picture.height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, part);
  };
  const GLsizei samples = std::min(wantedSamples, limit(GL_MAX_SAMPLES));
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.samples);
  attach(target_.parts[0], GL_COLOR_ATTACHMENT0, GL_RGBA8, samples);
  attach(target_.parts[1], GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, samples);
  checkFramebuffer(picture);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.pixels);
  attach(target_.parts[2], GL_COLOR_ATTACHMENT0, GL_RGBA8, 0);
  checkFramebuffer(picture);
  target_.width = picture.width;
  target_.height = picture.height;
}

void Rasteriser::setMatrix(GLuint program, const char* name, const Eigen::Matrix4d& matrix) const {
  const Eigen::Matrix4f single = matrix.cast<float>();
  gl_.UniformMatrix4fv(gl_.GetUniformLocation(program, name), 1, GL_FALSE, single.data());
}

void Rasteriser::drawRanges(const std::vector<Range>& ranges) const {
  std::vector<GLint> firsts;
  std::vector<GLsizei> counts;
  for (const Range& range : ranges) {
    firsts.push_back(static_cast<GLint>(range.first));
    counts.push_back(static_cast<GLsizei>(range.count));
  }
  gl_.MultiDrawArrays(GL_TRIANGLES, firsts.data(), counts.data(),
                      static_cast<GLsizei>(firsts.size()));
}

void Rasteriser::drawShadowMap(const Picture& picture) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, shadowTarget_);
  // The rim stays lit, and with it what lies outside.
  gl_.Viewport(1, 1, shadowSide - 2, shadowSide - 2);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  // Moves what is drawn away from the sun, so that a lit face does not shade itself.
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(3.0F, 8.0F);
  gl_.UseProgram(caster_);
  setMatrix(caster_, "localToSun", picture.localToSun);
  setMatrix(caster_, "toLocal", movedBy(sceneOrigin_ - picture.localOrigin));
  gl_.BindVertexArray(casters_.array);
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(casterCount_));
  gl_.BindVertexArray(bodies_.array);
  for (const DrawnBody& body : picture.drawnBodies) {
    if (body.opacity < 1.0F) continue;
    setMatrix(caster_, "toLocal", body.toLocal.matrix().cast<double>());
    drawRanges({body.surfaces});
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

void Rasteriser::setUniforms(const Picture& picture) const {
  const auto vector4 = [&](GLuint program, const char* name, const Eigen::Vector4f& value) {
    gl_.Uniform4f(gl_.GetUniformLocation(program, name), value.x(), value.y(), value.z(),
                  value.w());
  };
  const auto vector3 = [&](GLuint program, const char* name, const Eigen::Vector3f& value) {
    gl_.Uniform3f(gl_.GetUniformLocation(program, name), value.x(), value.y(), value.z());
  };
  const auto number = [&](GLuint program, const char* name, double value) {
    gl_.Uniform1f(gl_.GetUniformLocation(program, name), static_cast<float>(value));
  };
  gl_.UseProgram(lit_);
  setMatrix(lit_, "localToClip", picture.localToClip);
  setMatrix(lit_, "localToSun", picture.localToSun);
  vector4(lit_, "viewer", picture.viewer.cast<float>());
  vector3(lit_, "sun", picture.sun.cast<float>());
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, shadowMap_);
  gl_.Uniform1i(gl_.GetUniformLocation(lit_, "shadowMap"), 0);
  number(lit_, "shadowScale", 0.5 * (shadowSide - 2) / shadowSide);
  // The grid's lines stand at round world coordinates.
  const auto start = [&](double origin) {
    return static_cast<float>(std::remainder(origin, picture.gridSpacing) / picture.gridSpacing);
  };
  number(lit_, "gridPerMetre", 1.0 / picture.gridSpacing);
  gl_.Uniform2f(gl_.GetUniformLocation(lit_, "gridStart"), start(picture.localOrigin.x()),
                start(picture.localOrigin.y()));
  vector3(lit_, "hazeColour", picture.hazeColour);
  const double hazeDepth = picture.hazeEnd - picture.hazeStart;
  number(lit_, "hazeStart", picture.hazeStart);
  number(lit_, "hazePerMetre", hazeDepth > 0.0 ? 1.0 / hazeDepth : 0.0);

  gl_.UseProgram(edge_);
  setMatrix(edge_, "localToClip", picture.localToClip);
  vector4(edge_, "wallTint", picture.wallTint);
  gl_.Uniform2f(gl_.GetUniformLocation(edge_, "halfSize"), 0.5F * static_cast<float>(picture.width),
                0.5F * static_cast<float>(picture.height));
  number(edge_, "pixelsPerMetre", picture.pixelsPerMetre);
  number(edge_, "width", picture.edgeWidth);
  number(edge_, "faintest", picture.edgeFaintest);
  number(edge_, "nearer", picture.edgeNearer);
}

/// Finds what of the scene can be seen, and whether it can be drawn in bearable time: a driver
/// tests every pixel of every triangle, and keeps them all until then.
void Rasteriser::chooseParts(const Picture& picture) {
  const Eigen::Matrix4d toLocal = movedBy(sceneOrigin_ - picture.localOrigin);
  const Eigen::Matrix4d toClip = picture.localToClip * toLocal;
  const Eigen::Matrix4d toSun = picture.localToSun * toLocal;
  seenSurfaces_.clear();
  seenEdges_.clear();
  double overdraw = 0.0;
  double shadows = 0.0;
  for (const SceneModel::Part& part : parts_) {
    if (part.casters > 0)
      shadows += static_cast<double>(part.casters) * coveredShare(part.box, toSun);
    if (outside(part.box, toClip)) continue;
    overdraw += static_cast<double>(part.surfaces.count) / 3.0 * coveredShare(part.box, toClip);
    join(part.surfaces, seenSurfaces_);
    join(part.edges, seenEdges_);
  }
  overdraw = std::max(overdraw, shadows);
  if (overdraw <= picture.mostOverdraw) return;
  throw Error("the scene's triangles lie in up to " + std::to_string(std::llround(overdraw)) +
              " layers over the picture or its shadows: SnapshotOptions::mostOverdraw, " +
              std::to_string(std::llround(picture.mostOverdraw)) + ", is the most");
}

void Rasteriser::drawScene(const Picture& picture) const {
  gl_.UseProgram(lit_);
  setMatrix(lit_, "toLocal", movedBy(sceneOrigin_ - picture.localOrigin));
  gl_.Uniform4f(gl_.GetUniformLocation(lit_, "wallTint"), picture.wallTint.x(),
                picture.wallTint.y(), picture.wallTint.z(), picture.wallTint.w());
  gl_.Uniform1f(gl_.GetUniformLocation(lit_, "paleness"), 0.0F);
  gl_.Uniform1f(gl_.GetUniformLocation(lit_, "opacity"), 1.0F);
  gl_.BindVertexArray(surfaces_.array);
  drawRanges(seenSurfaces_);
}

void Rasteriser::drawEdges(const Picture& picture) const {
  gl_.UseProgram(edge_);
  setMatrix(edge_, "toLocal", movedBy(sceneOrigin_ - picture.localOrigin));
  gl_.BindVertexArray(edges_.array);
  gl_.DepthMask(GL_FALSE);
  drawRanges(seenEdges_);
  gl_.DepthMask(GL_TRUE);
}

void Rasteriser::drawBodies(const Picture& picture, bool ghosts) const {
  gl_.UseProgram(lit_);
  gl_.Uniform4f(gl_.GetUniformLocation(lit_, "wallTint"), 0.0F, 0.0F, 0.0F, 0.0F);
  gl_.BindVertexArray(bodies_.array);
  for (const DrawnBody& body : picture.drawnBodies) {
    if ((body.opacity < 1.0F) != ghosts) continue;
    setMatrix(lit_, "toLocal", body.toLocal.matrix().cast<double>());
    gl_.Uniform1f(gl_.GetUniformLocation(lit_, "paleness"), body.paleness);
    gl_.Uniform1f(gl_.GetUniformLocation(lit_, "opacity"), body.opacity);
    drawRanges({body.surfaces});
  }
}

void Rasteriser::drawLayers(const Picture& picture) const {
  const std::array<const Triangles*, 4> layers = {&picture.background, &picture.ribbons,
                                                  &picture.markers, &picture.overlay};
  std::array<Range, layers.size()> ranges;
  Triangles all;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    ranges[k] = {all.size(), layers[k]->size()};
    all.insert(all.end(), layers[k]->begin(), layers[k]->end());
  }
  const auto& [background, ribbons, markers, overlay] = ranges;
  fill<FlatVertex>(layers_, all, GL_STREAM_DRAW);
  setUniforms(picture);
  const auto paint = [&](const Range& range) {
    gl_.UseProgram(flat_);
    gl_.BindVertexArray(layers_.array);
    drawRanges({range});
  };

  gl_.BindFramebuffer(GL_FRAMEBUFFER, target_.samples);
  gl_.Viewport(0, 0, picture.width, picture.height);
  gl_.ClearColor(1.0F, 1.0F, 1.0F, 1.0F);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_DEPTH_TEST);
  paint(background);
  gl_.Enable(GL_DEPTH_TEST);
  drawBodies(picture, false);
  drawScene(picture);
  gl_.Enable(GL_BLEND);
  drawEdges(picture);
  // Depth first, then colour where it is nearest: ghosts do not show through themselves.
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  drawBodies(picture, true);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

  // Ribbons pass for nearer than they are: vehicles once more, over their ends.
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_FALSE);
  paint(ribbons);
  gl_.DepthMask(GL_TRUE);
  drawBodies(picture, false);
  gl_.Enable(GL_BLEND);
  drawBodies(picture, true);
  paint(markers);

  gl_.Disable(GL_DEPTH_TEST);
  paint(overlay);
}

Image Rasteriser::readBack() const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, target_.samples);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target_.pixels);
  gl_.BlitFramebuffer(0, 0, target_.width, target_.height, 0, 0, target_.width, target_.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, target_.pixels);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  Image image(target_.width, target_.height);
  gl_.ReadPixels(0, 0, target_.width, target_.height, GL_RGB, GL_UNSIGNED_BYTE,
                 image.pixels().data());
  return image;
}

}  // namespace bumper::drawing
