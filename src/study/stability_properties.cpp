#include "glint/study/stability_bench.h"

namespace glint::stability {

std::span<const Case> propertyCases() { return {}; }

}  // namespace glint::stability
