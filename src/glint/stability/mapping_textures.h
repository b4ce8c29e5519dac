#pragma once

#include "glint/stability/bench.h"

// The cases of group M about textures, which mapping.cpp lists.
namespace glint::stability {

void m6(Bench& bench, Record& record);
void m7(Bench& bench, Record& record);
void m8(Bench& bench, Record& record);
void m9(Bench& bench, Record& record);
void m10(Bench& bench, Record& record);
void m11(Bench& bench, Record& record);
void m13(Bench& bench, Record& record);
void m14(Bench& bench, Record& record);
void m15(Bench& bench, Record& record);

}  // namespace glint::stability
