#pragma once

#include <map>
#include <memory>

#include "glint/gl/handles.h"
#include "glint/render/decode.h"
#include "material_textures.h"
#include "measured.h"

namespace glint::viewer {

/// Small pictures in the window's context, made when they are first shown: a model's textures, and
/// balls of materials.
class Thumbnails {
 public:
  struct Shown {
    unsigned texture = 0;  ///< GL texture name; 0: none
    int width = 0, height = 0;
  };
  Shown of(const std::shared_ptr<const DecodedImages>&, int image);
  /// The ball of a preset, by its index in presets().
  Shown ofPreset(int preset, const FitForm&);
  /// The ball of a scene's material under the look, in the mean colour of its colour texture;
  /// redrawn when that changes.
  Shown ofMaterial(const std::shared_ptr<const DecodedImages>&, const Scene&, const Look&,
                   int material, const FitForm&);

 private:
  std::shared_ptr<const DecodedImages> images_;
  struct Kept {
    TextureHandle texture;
    int width = 0, height = 0;
  };
  struct Ball {
    ShadingParameters of;
    FitForm form;
    Kept kept;
  };
  static Kept kept(const Thumbnail&);
  void keepTo(const std::shared_ptr<const DecodedImages>&);
  glm::dvec3 meanOf(int image);
  static Shown shown(const Kept&);
  std::map<int, Kept> kept_;
  FitForm ballForm_;
  std::map<int, Kept> balls_;
  std::map<int, Ball> materialBalls_;
  std::map<int, glm::dvec3> means_;  ///< of images, linear
};

}  // namespace glint::viewer
