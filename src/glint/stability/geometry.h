#pragma once

#include <string>
#include <vector>

#include "glint/stability/bench.h"

// The cases of group A about positions and indices, which attributes.cpp lists, and what they share
// with those about normals.
namespace glint::stability {

void expectVector(Record& record, const std::string& what, const glm::dvec3& got,
                  const glm::dvec3& expected, double tolerance);

/// The vector's components, `count` times.
std::vector<float> repeated(const glm::vec3& v, int count);

/// Checks that all programs draw the scene's triangle without NaN and infinity, and lit if `lit`.
void expectDrawn(Bench& bench, Record& record, const std::string& what, const Scene& scene,
                 bool lit = true);

void a11(Bench& bench, Record& record);
void a12(Bench& bench, Record& record);
void a13(Bench& bench, Record& record);
void a14(Bench& bench, Record& record);
void a15(Bench& bench, Record& record);
void a16(Bench& bench, Record& record);
void a17(Bench& bench, Record& record);
void a18(Bench& bench, Record& record);
void a19(Bench& bench, Record& record);

}  // namespace glint::stability
