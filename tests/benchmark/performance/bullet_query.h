#pragma once

#include <memory>

#include "query_scheme.h"

namespace bumper::benchmark {

/// Bullet's pair test of a box with its triangle mesh; single precision, its own margins.
std::unique_ptr<QueryScheme> makeBulletQuery(const Scene& scene);

}  // namespace bumper::benchmark
