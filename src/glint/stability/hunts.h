#pragma once

#include "glint/stability/bench.h"
#include "glint/stability/case.h"

// Cases of group P that search for the worst input of a shader function and check it against its
// bound.
namespace glint::stability {

void huntLobe(Bench&, Record&);
void huntFresnel(Bench&, Record&);
void huntUnit(Bench&, Record&);
void huntHighlight(Bench&, Record&);
void reflectanceStaysInRange(Bench&, Record&);

}  // namespace glint::stability
