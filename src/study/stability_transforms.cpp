#include "glint/study/stability_bench.h"

namespace glint::stability {

std::span<const Case> transformCases() { return {}; }

}  // namespace glint::stability
