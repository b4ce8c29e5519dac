#include "glint/study/stability_bench.h"

namespace glint::stability {

std::span<const Case> attributeCases() { return {}; }

}  // namespace glint::stability
