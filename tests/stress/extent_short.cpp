#include "extent.h"

namespace bumper::tests {

const bool isLong = false;

}  // namespace bumper::tests
