#include "offscreen_context.h"

#include <algorithm>
#include <string>

#include "bumper/response/error.h"

namespace bumper {

std::vector<OffscreenBackend> builtBackends() {
  return {
#ifdef BUMPER_OSMESA
      OffscreenBackend::osmesa,
#endif
#ifdef BUMPER_EGL
      OffscreenBackend::egl,
#endif
  };
}

namespace drawing {

namespace {

std::unique_ptr<OffscreenContext> makeContextOf(OffscreenBackend backend) {
#ifdef BUMPER_OSMESA
  if (backend == OffscreenBackend::osmesa) return makeOsMesaContext();
#endif
#ifdef BUMPER_EGL
  if (backend == OffscreenBackend::egl) return makeEglContext();
#endif
  throw Error(backend == OffscreenBackend::osmesa ? "bumper was built without OSMesa"
                                                  : "bumper was built without EGL");
}

}  // namespace

std::unique_ptr<OffscreenContext> makeOffscreenContext(OffscreenBackend backend) {
  if (backend != OffscreenBackend::automatic) return makeContextOf(backend);
  std::string reasons;
  for (const OffscreenBackend built : builtBackends()) {
    try {
      return makeContextOf(built);
    } catch (const Error& error) {
      reasons += reasons.empty() ? "" : "; ";
      reasons += error.what();
    }
  }
  throw Error("nothing to draw with: " + reasons);
}

}  // namespace drawing

}  // namespace bumper
