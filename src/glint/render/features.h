#pragma once

#include <span>
#include <string>
#include <string_view>

#include "glint/render/variant.h"

namespace glint {

/// What the reason for a feature is derived from.
struct FeatureContext {
  const Variant& variant;
  const Mesh& mesh;
  const Material& material;
  const Look& look;
  bool orthographic = false;

  int lights() const;
  /// Why there is no light.
  std::string noLight() const;
};

/// A feature of a variant, and the only place that defines its names. A new one takes a member of
/// Variant, the code in variantFor() that sets it, a row in the table, and shader code under its
/// #define.
struct Feature {
  bool Variant::*flag = nullptr;
  int Variant::*count = nullptr;                        ///< instead of the flag
  std::string_view define;                              ///< in GLSL: 0 or 1, or the count
  std::string_view name;                                ///< in reports, without the form
  std::string (*yes)(const FeatureContext&) = nullptr;  ///< why it is there
  std::string (*no)(const FeatureContext&) = nullptr;   ///< why it is not
  /// Whether a reason is reported at all; null: for every variant that is not unlit.
  bool (*told)(const Variant&) = nullptr;
  std::string (*form)(const Variant&) = nullptr;  ///< follows the name
  std::string (*formReason)(const FeatureContext&) = nullptr;

  int value(const Variant& v) const { return flag ? int(v.*flag) : v.*count; }
};

/// In the order of Variant's members.
std::span<const Feature> features();

}  // namespace glint
