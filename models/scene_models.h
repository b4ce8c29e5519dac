#pragma once

#include <string>

namespace glint::models {

/// Binary glTF files with more than one mesh and material.

/// An object for judging materials: a hollow dish, a rim, a ball with a belt of grooves and a
/// throat ("Preview") on a flat base with round edges ("Base").
std::string preview();

/// Spheres of one mesh: the exponent doubles to the right, the metalness increases upwards; the
/// materials are called "e10-m0.5".
std::string chart();

/// A rod with a skin of four joints, which bends to both sides in four seconds.
std::string bend();

/// A ball that becomes tall, then a cube, then a ball again, in three seconds.
std::string morph();

/// Three balls on a floor, below a directional light, a point light and a spot light.
std::string lights();

}  // namespace glint::models
