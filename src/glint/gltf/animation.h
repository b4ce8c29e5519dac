#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "glint/gltf/document.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

enum class Interpolation { step, linear, cubic };

/// Key frames of a quantity. Times ascend or repeat (then the last key with a time counts).
/// `values` holds `width` numbers per key (three times that for cubic ones: in-tangent, value,
/// out-tangent), all finite.
struct Keys {
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times;  ///< seconds
  std::vector<double> values;
};

enum class AnimatedPath { translation, rotation, scale, weights };

/// Animates one property of one node.
struct Channel {
  std::size_t node = 0;
  AnimatedPath path = AnimatedPath::translation;
  std::size_t width = 3;  ///< numbers per value
  std::size_t keys = 0;   ///< index into Animation::keys
};

struct Animation {
  std::vector<Keys> keys;
  std::vector<Channel> channels;
};

/// Names and durations of all animations. A broken one has duration 0; its faults are reported when
/// it is read.
std::vector<FileAnimation> listAnimations(Document& document, Budget& budget,
                                          const Messages& messages);

/// Reads an animation. A channel that cannot be played (keys out of order or not finite, of the
/// wrong number or type, a node with a matrix) is left out with a warning. Fails on invalid
/// indices.
Animation readAnimation(Document& document, std::size_t index, Budget& budget, Messages& messages);

/// The value at a time, by appendix C of the standard: constant before the first and after the last
/// key; rotations take the shorter way and have unit length.
std::vector<double> valueAt(const Keys& keys, std::size_t width, bool rotation, double seconds);

}  // namespace glint::gltf
