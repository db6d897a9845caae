#include "rasteriser.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bumper/response/error.h"
#include "gl_functions.h"
#include "offscreen_context.h"

namespace bumper::drawing {

namespace {

constexpr int wantedSamples = 4;
constexpr int shadowSide = 2048;

constexpr const char* vertexSource = R"(#version 330 core
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 colour;
layout(location = 2) in vec3 world;
layout(location = 3) in vec3 lighting;
uniform mat4 sunView;
out vec4 surfaceColour;
out vec3 surfaceLighting;
out vec2 ground;
out vec3 inShadowMap;
void main() {
  gl_Position = clip;
  surfaceColour = colour;
  surfaceLighting = lighting;
  ground = world.xy;
  inShadowMap = (sunView * vec4(world, 1.0)).xyz * 0.5 + 0.5;
}
)";

constexpr const char* litFragmentSource = R"(#version 330 core
in vec4 surfaceColour;
in vec3 surfaceLighting;
in vec2 ground;
in vec3 inShadowMap;
uniform sampler2DShadow shadowMap;
uniform float shadowTexel;
uniform float gridSpacing;
uniform vec3 hazeColour;
uniform float hazeStart;
uniform float hazePerMetre;
out vec4 drawn;

float sunlit() {
  vec2 reach = vec2(0.75, -0.75) * shadowTexel;
  return 0.25 * (texture(shadowMap, inShadowMap + vec3(reach.xx, 0.0)) +
                 texture(shadowMap, inShadowMap + vec3(reach.xy, 0.0)) +
                 texture(shadowMap, inShadowMap + vec3(reach.yx, 0.0)) +
                 texture(shadowMap, inShadowMap + vec3(reach.yy, 0.0)));
}

float gridLine() {
  vec2 perPixel = max(fwidth(ground), vec2(1e-6));
  vec2 distance = abs(fract(ground / gridSpacing + 0.5) - 0.5) * gridSpacing / perPixel;
  vec2 line = clamp(1.0 - distance, 0.0, 1.0) * clamp(1.5 - 6.0 * perPixel / gridSpacing, 0.0, 1.0);
  return max(line.x, line.y);
}

void main() {
  float light = surfaceLighting.x + surfaceLighting.y * sunlit();
  vec3 colour = surfaceColour.rgb * light * (1.0 - 0.08 * surfaceLighting.z * gridLine());
  float haze = clamp((1.0 / gl_FragCoord.w - hazeStart) * hazePerMetre, 0.0, 1.0);
  drawn = vec4(mix(colour, hazeColour, haze * haze * (3.0 - 2.0 * haze)), surfaceColour.a);
}
)";

constexpr const char* flatFragmentSource = R"(#version 330 core
in vec4 surfaceColour;
out vec4 drawn;
void main() { drawn = surfaceColour; }
)";

constexpr const char* shadowVertexSource = R"(#version 330 core
layout(location = 0) in vec3 world;
uniform mat4 sunView;
void main() { gl_Position = sunView * vec4(world, 1.0); }
)";

constexpr const char* shadowFragmentSource = R"(#version 330 core
void main() {}
)";

/// One drawing. The context's end frees every object made in it.
class Rasteriser {
 public:
  Rasteriser(const Picture& picture, OffscreenContext& context) : picture_(picture), gl_(context) {}

  Image draw() {
    checkSize();
    const GLuint shadowMap = drawShadowMap();
    const GLuint target = makeTarget(sampleCount());
    drawLayers(shadowMap);
    Image image = readBack(target);
    if (gl_.GetError() != GL_NO_ERROR) throw Error("OpenGL reports an error after drawing");
    return image;
  }

 private:
  /// A part of the vertex buffer.
  struct Range {
    GLint first = 0;
    GLsizei count = 0;
  };

  [[nodiscard]] GLint limit(GLenum name) const {
    std::array<GLint, 2> value{};
    gl_.GetIntegerv(name, value.data());
    return value[0];
  }

  void checkSize() const {
    std::array<GLint, 2> viewport{};
    gl_.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const GLint side = limit(GL_MAX_RENDERBUFFER_SIZE);
    const GLint width = std::min(side, viewport[0]);
    const GLint height = std::min(side, viewport[1]);
    if (picture_.width <= width && picture_.height <= height) return;
    throw Error("a picture of " + std::to_string(picture_.width) + " x " +
                std::to_string(picture_.height) + " pixels: this driver allows " +
                std::to_string(width) + " x " + std::to_string(height));
  }

  [[nodiscard]] GLsizei sampleCount() const {
    return std::min(wantedSamples, limit(GL_MAX_SAMPLES));
  }

  [[nodiscard]] GLuint shader(GLenum kind, const char* source) const {
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

  [[nodiscard]] GLuint program(const char* vertex, const char* fragment) const {
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

  void bindNewBuffer() const {
    GLuint array = 0;
    GLuint buffer = 0;
    gl_.GenVertexArrays(1, &array);
    gl_.BindVertexArray(array);
    gl_.GenBuffers(1, &buffer);
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer);
  }

  void attribute(GLuint place, GLint size, std::size_t stride, std::size_t offset) const {
    gl_.EnableVertexAttribArray(place);
    gl_.VertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                            // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL passes offsets so
                            reinterpret_cast<const void*>(offset));
  }

  void checkFramebuffer() const {
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw Error("the driver cannot draw into a framebuffer of " + std::to_string(picture_.width) +
                  " x " + std::to_string(picture_.height) + " pixels");
  }

  [[nodiscard]] GLuint drawShadowMap() const {
    GLuint texture = 0;
    gl_.GenTextures(1, &texture);
    gl_.BindTexture(GL_TEXTURE_2D, texture);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, shadowSide, shadowSide, 0,
                   GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    static constexpr std::array<GLfloat, 4> outsideIsLit = {1.0F, 1.0F, 1.0F, 1.0F};
    gl_.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, outsideIsLit.data());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

    GLuint framebuffer = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
    gl_.DrawBuffer(GL_NONE);
    gl_.ReadBuffer(GL_NONE);
    checkFramebuffer();

    const GLuint caster = program(shadowVertexSource, shadowFragmentSource);
    gl_.UseProgram(caster);
    gl_.UniformMatrix4fv(gl_.GetUniformLocation(caster, "sunView"), 1, GL_FALSE,
                         picture_.sunView.data());
    bindNewBuffer();
    const auto& casters = picture_.casters;
    gl_.BufferData(GL_ARRAY_BUFFER,
                   static_cast<GLsizeiptr>(casters.size() * sizeof(Eigen::Vector3f)),
                   casters.data(), GL_STATIC_DRAW);
    attribute(0, 3, sizeof(Eigen::Vector3f), 0);

    gl_.Viewport(0, 0, shadowSide, shadowSide);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    // Moves what is drawn away from the sun, so that a lit face does not shade itself.
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(3.0F, 8.0F);
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(casters.size()));
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
    return texture;
  }

  /// A framebuffer with colour and depth, bound; 0 samples for one that can be read.
  [[nodiscard]] GLuint makeTarget(GLsizei samples) const {
    GLuint framebuffer = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    static constexpr std::array<std::array<GLenum, 2>, 2> parts = {
        {{GL_COLOR_ATTACHMENT0, GL_RGBA8}, {GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24}}};
    for (const auto& [attachment, format] : parts) {
      GLuint part = 0;
      gl_.GenRenderbuffers(1, &part);
      gl_.BindRenderbuffer(GL_RENDERBUFFER, part);
      gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, picture_.width,
                                         picture_.height);
      gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, part);
    }
    checkFramebuffer();
    return framebuffer;
  }

  void setUniforms(GLuint lit, GLuint shadowMap) const {
    const auto uniform = [&](const char* name) { return gl_.GetUniformLocation(lit, name); };
    gl_.UseProgram(lit);
    gl_.UniformMatrix4fv(uniform("sunView"), 1, GL_FALSE, picture_.sunView.data());
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, shadowMap);
    gl_.Uniform1i(uniform("shadowMap"), 0);
    gl_.Uniform1f(uniform("shadowTexel"), 1.0F / shadowSide);
    gl_.Uniform1f(uniform("gridSpacing"), static_cast<float>(picture_.gridSpacing));
    gl_.Uniform3f(uniform("hazeColour"), picture_.hazeColour.x(), picture_.hazeColour.y(),
                  picture_.hazeColour.z());
    const double hazeDepth = picture_.hazeEnd - picture_.hazeStart;
    gl_.Uniform1f(uniform("hazeStart"), static_cast<float>(picture_.hazeStart));
    gl_.Uniform1f(uniform("hazePerMetre"),
                  hazeDepth > 0.0 ? static_cast<float>(1.0 / hazeDepth) : 0.0F);
  }

  void drawLayers(GLuint shadowMap) const {
    const std::array<const Triangles*, 7> layers = {
        &picture_.background, &picture_.surfaces, &picture_.outlines, &picture_.vehicles,
        &picture_.ribbons,    &picture_.ghosts,   &picture_.overlay};
    std::array<Range, layers.size()> ranges;
    Triangles all;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      ranges[k] = {static_cast<GLint>(all.size()), static_cast<GLsizei>(layers[k]->size())};
      all.insert(all.end(), layers[k]->begin(), layers[k]->end());
    }
    const auto& [background, surfaces, outlines, vehicles, ribbons, ghosts, overlay] = ranges;

    const GLuint flat = program(vertexSource, flatFragmentSource);
    const GLuint lit = program(vertexSource, litFragmentSource);
    setUniforms(lit, shadowMap);
    bindNewBuffer();
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(all.size() * sizeof(Vertex)),
                   all.data(), GL_STATIC_DRAW);
    attribute(0, 4, sizeof(Vertex), offsetof(Vertex, clip));
    attribute(1, 4, sizeof(Vertex), offsetof(Vertex, colour));
    attribute(2, 3, sizeof(Vertex), offsetof(Vertex, world));
    attribute(3, 3, sizeof(Vertex), offsetof(Vertex, lighting));
    const auto paint = [&](const Range& range) {
      gl_.DrawArrays(GL_TRIANGLES, range.first, range.count);
    };

    gl_.Viewport(0, 0, picture_.width, picture_.height);
    gl_.ClearColor(1.0F, 1.0F, 1.0F, 1.0F);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl_.Enable(GL_BLEND);
    gl_.DepthFunc(GL_LEQUAL);

    gl_.UseProgram(flat);
    gl_.Disable(GL_DEPTH_TEST);
    paint(background);

    gl_.UseProgram(lit);
    gl_.Enable(GL_DEPTH_TEST);
    paint(surfaces);

    gl_.UseProgram(flat);
    gl_.DepthMask(GL_FALSE);
    paint(outlines);
    gl_.DepthMask(GL_TRUE);

    gl_.UseProgram(lit);
    paint(vehicles);
    // Depth first, then colour where it is nearest: ghosts do not show through themselves.
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    paint(ghosts);
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    // Ribbons pass for nearer than they are: vehicles once more, over their ends.
    gl_.UseProgram(flat);
    gl_.DepthMask(GL_FALSE);
    paint(ribbons);
    gl_.DepthMask(GL_TRUE);
    gl_.UseProgram(lit);
    paint(vehicles);
    paint(ghosts);

    gl_.UseProgram(flat);
    gl_.Disable(GL_DEPTH_TEST);
    paint(overlay);
  }

  [[nodiscard]] Image readBack(GLuint drawnInto) const {
    const GLuint readable = makeTarget(0);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, drawnInto);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, readable);
    gl_.BlitFramebuffer(0, 0, picture_.width, picture_.height, 0, 0, picture_.width,
                        picture_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, readable);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    Image image(picture_.width, picture_.height);
    gl_.ReadPixels(0, 0, picture_.width, picture_.height, GL_RGB, GL_UNSIGNED_BYTE,
                   image.pixels().data());
    // OpenGL's rows go up.
    for (int y = 0; y < picture_.height / 2; ++y) {
      std::swap_ranges(&image.at(0, y), &image.at(0, y) + picture_.width,
                       &image.at(0, picture_.height - 1 - y));
    }
    return image;
  }

  const Picture& picture_;
  GlFunctions gl_;
};

}  // namespace

Image rasterise(const Picture& picture, OffscreenContext& context) {
  const ContextInUse use(context);
  return Rasteriser(picture, context).draw();
}

}  // namespace bumper::drawing
