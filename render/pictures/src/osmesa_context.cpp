#include <GL/glcorearb.h>
// After glcorearb.h, which it would otherwise replace by the declarations of OpenGL 1.
#include <GL/osmesa.h>

#include <array>
#include <string>

#include "bumper/response/error.h"
#include "offscreen_context.h"

namespace bumper::drawing {

namespace {

class OsMesaContext : public OffscreenContext {
 public:
  OsMesaContext() {
    static constexpr std::array<int, 11> attributes = {OSMESA_FORMAT,
                                                       OSMESA_RGBA,
                                                       OSMESA_PROFILE,
                                                       OSMESA_CORE_PROFILE,
                                                       OSMESA_CONTEXT_MAJOR_VERSION,
                                                       3,
                                                       OSMESA_CONTEXT_MINOR_VERSION,
                                                       3,
                                                       OSMESA_DEPTH_BITS,
                                                       0,
                                                       0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context_ == nullptr)
      throw Error("OSMesa gives no OpenGL 3.3 core context; it must be Mesa 17 or newer");
  }
  OsMesaContext(const OsMesaContext&) = delete;
  OsMesaContext& operator=(const OsMesaContext&) = delete;
  OsMesaContext(OsMesaContext&&) = delete;
  OsMesaContext& operator=(OsMesaContext&&) = delete;
  ~OsMesaContext() override { OSMesaDestroyContext(context_); }

  void use() override {
    if (OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, windowSide, windowSide) ==
        GL_FALSE)
      throw Error("OSMesa cannot make its context current on this thread");
  }

  void leave() noexcept override { OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0); }

  [[nodiscard]] Function function(const char* name) const override {
    const OSMESAproc found = OSMesaGetProcAddress(name);
    if (found == nullptr) throw Error(std::string("OSMesa has no function ") + name);
    return found;
  }

  [[nodiscard]] OffscreenBackend backend() const override { return OffscreenBackend::osmesa; }

 private:
  /// What a context needs to be current; pictures are drawn into framebuffers of their own.
  static constexpr int windowSide = 4;
  std::array<unsigned char, std::size_t{4} * windowSide * windowSide> window_{};
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<OffscreenContext> makeOsMesaContext() { return std::make_unique<OsMesaContext>(); }

}  // namespace bumper::drawing
