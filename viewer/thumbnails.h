#pragma once

#include <map>
#include <memory>

#include "glint/gl/handles.h"
#include "glint/render/decode.h"

namespace glint::viewer {

/// Small pictures of a model's textures in the window's context, made when they are first shown.
class Thumbnails {
 public:
  struct Shown {
    unsigned texture = 0;  ///< GL's name; 0: there is none
    int width = 0, height = 0;
  };
  Shown of(const std::shared_ptr<const DecodedImages>&, int image);

 private:
  std::shared_ptr<const DecodedImages> images_;
  struct Kept {
    TextureHandle texture;
    int width = 0, height = 0;
  };
  std::map<int, Kept> kept_;
};

}  // namespace glint::viewer
