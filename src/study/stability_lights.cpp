#include "glint/study/stability_bench.h"

namespace glint::stability {

std::span<const Case> lightCases() { return {}; }

}  // namespace glint::stability
