#pragma once

#include <memory>

#include "bumper/render/offscreen_backend.h"

namespace bumper::drawing {

/// An OpenGL 3.3 core context without a window, current on no thread unless it is in use. Which
/// library provides it is known to osmesa_context.cpp and egl_context.cpp alone.
class OffscreenContext {
 public:
  using Function = void (*)();

  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  OffscreenContext(OffscreenContext&&) = delete;
  OffscreenContext& operator=(OffscreenContext&&) = delete;
  virtual ~OffscreenContext() = default;

  /// Makes it current on the calling thread, instead of any other. Throws Error if the driver
  /// refuses.
  virtual void use() = 0;
  /// Leaves the calling thread, which uses it, without a context.
  virtual void leave() noexcept = 0;
  /// Never null; throws Error if the driver has no such function. Only while it is in use.
  [[nodiscard]] virtual Function function(const char* name) const = 0;
  [[nodiscard]] virtual OffscreenBackend backend() const = 0;
};

/// Uses a context until the end of a block.
class ContextInUse {
 public:
  explicit ContextInUse(OffscreenContext& context) : context_(context) { context_.use(); }
  ContextInUse(const ContextInUse&) = delete;
  ContextInUse& operator=(const ContextInUse&) = delete;
  ContextInUse(ContextInUse&&) = delete;
  ContextInUse& operator=(ContextInUse&&) = delete;
  ~ContextInUse() { context_.leave(); }

 private:
  OffscreenContext& context_;
};

/// Throws Error if no context can be made or bumper was built without the backend.
std::unique_ptr<OffscreenContext> makeOffscreenContext(OffscreenBackend backend);

/// Each is built if its library was found. Throw Error if the driver gives no context.
std::unique_ptr<OffscreenContext> makeOsMesaContext();
std::unique_ptr<OffscreenContext> makeEglContext();

}  // namespace bumper::drawing
