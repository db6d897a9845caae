#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string>
#include <string_view>

#include "bumper/response/error.h"
#include "offscreen_context.h"

namespace bumper::drawing {

namespace {

bool lists(const char* extensions, std::string_view wanted) {
  std::string_view rest = extensions == nullptr ? "" : extensions;
  while (!rest.empty()) {
    const std::size_t end = rest.find(' ');
    if (rest.substr(0, end) == wanted) return true;
    rest = end == std::string_view::npos ? "" : rest.substr(end + 1);
  }
  return false;
}

/// The one display without a surface, which lives until the program ends: to terminate it would end
/// every other user's contexts too.
EGLDisplay surfacelessDisplay() {
  if (!lists(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
    throw Error("this EGL cannot draw without a surface (EGL_MESA_platform_surfaceless)");
  const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
    throw Error("EGL cannot be started without a surface");
  return display;
}

class EglContext : public OffscreenContext {
 public:
  EglContext() : display_(surfacelessDisplay()) {
    static constexpr std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
                                                     EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
        eglChooseConfig(display_, wanted.data(), &config, 1, &found) == EGL_FALSE || found == 0)
      throw Error("this EGL has no OpenGL");
    static constexpr std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                         3,
                                                         EGL_CONTEXT_MINOR_VERSION,
                                                         3,
                                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                         EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) throw Error("EGL gives no OpenGL 3.3 core context");
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  EglContext(EglContext&&) = delete;
  EglContext& operator=(EglContext&&) = delete;
  ~EglContext() override { eglDestroyContext(display_, context_); }

  void use() override {
    // Each thread has a choice of its own.
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
      throw Error("EGL cannot make its context current on this thread");
  }

  void leave() noexcept override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  [[nodiscard]] Function function(const char* name) const override {
    const Function found = eglGetProcAddress(name);
    if (found == nullptr) throw Error(std::string("EGL has no function ") + name);
    return found;
  }

  [[nodiscard]] OffscreenBackend backend() const override { return OffscreenBackend::egl; }

 private:
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<OffscreenContext> makeEglContext() { return std::make_unique<EglContext>(); }

}  // namespace bumper::drawing
