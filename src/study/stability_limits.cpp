#include "glint/study/stability_bench.h"

namespace glint::stability {

std::span<const Case> limitCases() { return {}; }

}  // namespace glint::stability
