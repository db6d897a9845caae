#include "extent.h"

namespace bumper::tests {

const bool isLong = true;

}  // namespace bumper::tests
