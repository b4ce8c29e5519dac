#include "glint/study/stability_bench.h"

namespace glint::stability {

std::span<const Case> interpolationCases() { return {}; }

}  // namespace glint::stability
