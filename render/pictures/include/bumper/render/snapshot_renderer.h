#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "bumper/base/api.h"
#include "bumper/render/image.h"
#include "bumper/render/offscreen_backend.h"
#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// Draws many pictures of one scene: keeps what does not change between them, which is a context of
/// the driver with its compiled shaders, the scene's prepared geometry, vehicle bodies and letters.
/// A replay is one picture after the other, each with its SnapshotOptions::moment.
///
/// May be used from any thread, but from one at a time; several may be used at once. No OpenGL
/// context is left current on the calling thread.
class SnapshotRenderer {
 public:
  /// Throws Error on an invalid scene, if bumper was built without the backend, or if the driver
  /// fails.
  explicit SnapshotRenderer(const Scene& scene,
                            OffscreenBackend backend = OffscreenBackend::automatic);
  SnapshotRenderer(const SnapshotRenderer&) = delete;
  SnapshotRenderer& operator=(const SnapshotRenderer&) = delete;
  SnapshotRenderer(SnapshotRenderer&& other) noexcept;
  SnapshotRenderer& operator=(SnapshotRenderer&& other) noexcept;
  ~SnapshotRenderer();

  /// The same picture as renderSnapshot() of the scene, and the same errors; it can be used on
  /// after an error.
  Image draw(const Recording& recording, const SnapshotOptions& options = {});

  /// As projectToSnapshot() of the scene.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Recording& recording,
                                                       const SnapshotOptions& options,
                                                       const Eigen::Vector3d& point) const;

  /// What draws: never OffscreenBackend::automatic.
  [[nodiscard]] OffscreenBackend backend() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace bumper
