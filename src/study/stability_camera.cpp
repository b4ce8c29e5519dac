#include "glint/study/stability_bench.h"

namespace glint::stability {

std::span<const Case> cameraCases() { return {}; }

}  // namespace glint::stability
