#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/gl/context.h"
#include "glint/scene/look.h"

namespace glint {

/// What a picture was made from and with.
struct PictureOrigin {
  std::string modelHash;        ///< of modelHash(); empty where it is not known
  std::optional<GlStrings> gl;  ///< of the driver; the reference has none
  int bitDepth = 8;
  /// What else distinguishes it from other pictures of the model and the look: "turntable 3/36".
  /// Empty for a plain picture.
  std::string variation;
};

/// By which a picture is known to be there already: a hash of the program's version, the look, the
/// model's hash, the bit depth, the variation, and whether the reference drew it. The driver does
/// not count.
std::string pictureKey(const Look& look, const PictureOrigin&);

/// The texts of a picture's file, which say how it was made:
///
///     Software                           "glint 0.1.0"
///     GL_VENDOR, GL_RENDERER, GL_VERSION  the driver's; "glint-backend": "reference" without GL
///     glint-look                         the look, as saveLook() gives it
///     glint-model                        the hash of the model
///     glint-variation                    where there is one
///     glint-key                          the key, made with the look `keyed`
std::vector<std::pair<std::string, std::string>> pictureText(const Look& look, const Look& keyed,
                                                             const PictureOrigin&);

}  // namespace glint
