#pragma once

#include <memory>

namespace bumper::drawing {

/// An OpenGL 3.3 core context without a window, current on the thread that made it until it is
/// destroyed. Everything that knows which library provides it is in offscreen_context.cpp.
class OffscreenContext {
 public:
  using Function = void (*)();

  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  OffscreenContext(OffscreenContext&&) = delete;
  OffscreenContext& operator=(OffscreenContext&&) = delete;
  virtual ~OffscreenContext() = default;

  /// Never null; throws Error if the driver has no such function.
  [[nodiscard]] virtual Function function(const char* name) const = 0;
};

/// Throws Error if no context can be made.
std::unique_ptr<OffscreenContext> makeOffscreenContext();

}  // namespace bumper::drawing
