// What a picture costs beside the least that the driver can do: the same triangles from the same
// place in one colour each. Prints times per picture, on the clock and of all processors.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bumper/render/recording.h"
#include "bumper/render/snapshot_renderer.h"
#include "bumper/scenes/paper_scenes.h"
#include "gl_functions.h"
#include "offscreen_context.h"

namespace {

using bumper::drawing::GlFunctions;
using Eigen::Vector3d;

constexpr int width = 1280;
constexpr int height = 720;
constexpr int repetitions = 20;

struct Cost {
  double clock = 0.0;       ///< ms, the median
  double processors = 0.0;  ///< ms, the mean: includes waiting for no one
};

Cost measure(const std::function<void(int)>& work) {
  work(0);
  std::vector<double> times;
  const std::clock_t before = std::clock();
  for (int k = 0; k < repetitions; ++k) {
    const auto start = std::chrono::steady_clock::now();
    work(k);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    times.push_back(taken.count());
  }
  const double processors =
      1000.0 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC / repetitions;
  std::ranges::sort(times);
  return {times[times.size() / 2], processors};
}

/// The course, meshed so that it has 10,000 triangles.
bumper::Scene scene() { return bumper::course({.groundAlong = 1360}); }

/// A minute on the course's centre line.
bumper::Recording drive() {
  constexpr std::size_t points = 5400;
  constexpr double speed = 30.0;
  const auto line = bumper::courseCentreLine(points);
  const bumper::VehicleParameters car = {1226.0, 1539.0, 2.05, 2.35, 1.70, 0.56};
  bumper::Recording run;
  const std::size_t vehicle = run.addVehicle("car", car);
  for (int k = 0; k <= 60 * 200; ++k) {
    bumper::RecordedPose pose;
    pose.time = k / 200.0;
    const double way = pose.time * speed * points / 5400.0;
    const auto at = static_cast<std::size_t>(way) % points;
    const Eigen::Vector2d step = line[(at + 1) % points] - line[at];
    const Eigen::Vector2d place = line[at] + (way - std::floor(way)) * step;
    pose.position << place, car.massCentreHeight;
    pose.orientation = Eigen::AngleAxisd(std::atan2(step.y(), step.x()), Vector3d::UnitZ());
    pose.velocity << speed * step.normalized(), 0.0;
    run.addPose(vehicle, pose);
  }
  return run;
}

const bumper::FixedCamera camera{{-30.0, -12.0, 9.0}, {30.0, 0.0, 0.0}, 40.0};

/// One colour each, projected before.
class BareFrame {
 public:
  BareFrame(const bumper::Scene& scene, bumper::OffscreenBackend backend)
      : context_(bumper::drawing::makeOffscreenContext(backend)), use_(*context_), gl_(*context_) {
    const auto shader = [&](GLenum kind, const char* source) {
      const GLuint name = gl_.CreateShader(kind);
      gl_.ShaderSource(name, 1, &source, nullptr);
      gl_.CompileShader(name);
      return name;
    };
    const GLuint program = gl_.CreateProgram();
    gl_.AttachShader(program, shader(GL_VERTEX_SHADER,
                                     "#version 330 core\nlayout(location = 0) in vec4 clip;\n"
                                     "layout(location = 1) in vec4 colour;\nout vec4 shade;\n"
                                     "void main() { gl_Position = clip; shade = colour; }\n"));
    gl_.AttachShader(program, shader(GL_FRAGMENT_SHADER,
                                     "#version 330 core\nin vec4 shade;\nout vec4 drawn;\n"
                                     "void main() { drawn = shade; }\n"));
    gl_.LinkProgram(program);
    gl_.UseProgram(program);

    std::vector<std::array<float, 8>> vertices;
    const Vector3d back = (camera.eye - camera.target).normalized();
    const Vector3d right = Vector3d::UnitZ().cross(back).normalized();
    const Vector3d up = back.cross(right);
    const double tangent = std::tan(camera.fieldOfView * std::numbers::pi / 360.0);
    constexpr double nearest = 1.0;
    constexpr double farthest = 2000.0;
    for (const auto& triangle : scene.triangles) {
      const Eigen::Vector3f colour = scene.meshes[triangle.mesh].colour;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d p = scene.corner(triangle, k) - camera.eye;
        const double depth = -back.dot(p);
        vertices.push_back(
            {static_cast<float>(right.dot(p) / tangent * height / width),
             static_cast<float>(up.dot(p) / tangent),
             static_cast<float>((depth * (farthest + nearest) - 2.0 * farthest * nearest) /
                                (farthest - nearest)),
             static_cast<float>(depth), colour.x(), colour.y(), colour.z(), 1.0F});
      }
    }
    count_ = static_cast<GLsizei>(vertices.size());
    GLuint name = 0;
    gl_.GenVertexArrays(1, &name);
    gl_.BindVertexArray(name);
    gl_.GenBuffers(1, &name);
    gl_.BindBuffer(GL_ARRAY_BUFFER, name);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(vertices[0])),
                   vertices.data(), GL_STATIC_DRAW);
    for (const GLuint place : {0U, 1U}) {
      gl_.EnableVertexAttribArray(place);
      gl_.VertexAttribPointer(place, 4, GL_FLOAT, GL_FALSE, sizeof(vertices[0]),
                              // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL passes offsets so
                              reinterpret_cast<const void*>(std::size_t{16} * place));
    }
    samples_ = framebuffer(4);
    pixels_ = framebuffer(0);
    gl_.Viewport(0, 0, width, height);
    gl_.Enable(GL_DEPTH_TEST);
  }

  void draw() {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, samples_);
    gl_.ClearColor(0.8F, 0.9F, 1.0F, 1.0F);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_.DrawArrays(GL_TRIANGLES, 0, count_);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, pixels_);
    gl_.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, pixels_);
    gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, read_.data());
  }

 private:
  [[nodiscard]] GLuint framebuffer(GLsizei samples) const {
    GLuint name = 0;
    gl_.GenFramebuffers(1, &name);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, name);
    for (const auto& [attachment, format] :
         {std::pair<GLenum, GLenum>{GL_COLOR_ATTACHMENT0, GL_RGBA8},
          {GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24}}) {
      GLuint part = 0;
      gl_.GenRenderbuffers(1, &part);
      gl_.BindRenderbuffer(GL_RENDERBUFFER, part);
      gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
      gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, part);
    }
    return name;
  }

  std::unique_ptr<bumper::drawing::OffscreenContext> context_;
  bumper::drawing::ContextInUse use_;
  GlFunctions gl_;
  GLsizei count_ = 0;
  GLuint samples_ = 0;
  GLuint pixels_ = 0;
  std::vector<unsigned char> read_ = std::vector<unsigned char>(std::size_t{4} * width * height);
};

void print(const std::string& what, const Cost& cost, const Cost& bare) {
  std::printf("%-34s %8.1f %12.1f %9.2f\n", what.c_str(), cost.clock, cost.processors,
              cost.processors / bare.processors);
}

void report(const char* name, bumper::OffscreenBackend backend) {
  const bumper::Scene course = scene();
  const bumper::Recording run = drive();
  Cost bare;
  {
    BareFrame frame(course, backend);
    bare = measure([&](int) { frame.draw(); });
  }
  std::printf("%s, %zu triangles, %d x %d, 4 samples\n%-34s %8s %12s %9s\n", name,
              course.triangles.size(), width, height, "ms a picture", "clock", "processors",
              "of bare");
  print("bare frame", bare, bare);

  bumper::SnapshotRenderer renderer(course, backend);
  bumper::SnapshotOptions options;
  options.fixed = camera;
  const auto frame = [&](int k) {
    options.moment = 1.0 + k / 30.0;
    renderer.draw(run, options);
  };
  for (const auto& [view, label] :
       {std::pair{bumper::SnapshotView::fixed, "replay frame, the bare one's view"},
        {bumper::SnapshotView::chase, "replay frame, chase view"},
        {bumper::SnapshotView::top, "replay frame, top view"}}) {
    options.view = view;
    print(label, measure(frame), bare);
  }
  options.moment.reset();
  options.view = bumper::SnapshotView::fixed;
  print("snapshot, the bare one's view", measure([&](int) { renderer.draw(run, options); }), bare);
  print("with a renderer of its own",
        measure([&](int) { bumper::renderSnapshot(course, run, options, backend); }), bare);
}

}  // namespace

int main() {
  for (const bumper::OffscreenBackend backend : bumper::builtBackends())
    report(backend == bumper::OffscreenBackend::osmesa ? "OSMesa" : "EGL", backend);
}
