#pragma once

#include "session.h"

namespace bumper::c_api {

/// Null: the defaults.
BarrierOptions barrierOptions(const bumper_barrier_options* given);

}  // namespace bumper::c_api
