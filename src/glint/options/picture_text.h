#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "glint/gl/context.h"
#include "glint/scene/look.h"

namespace glint {

/// What a picture was made from.
struct PictureOrigin {
  std::string modelHash;        ///< from modelHash(); empty if unknown
  std::optional<GlStrings> gl;  ///< of the driver; empty for the reference
  int bitDepth = 8;
  /// What distinguishes it from other pictures of the same model and look: "turntable 3/36". Empty
  /// for a plain picture.
  std::string variation;
};

/// The key that identifies an up-to-date picture: a hash of the program's version, the look, the
/// model's hash, the bit depth, the variation, and whether the reference drew it. The driver is not
/// included.
std::string pictureKey(const Look& look, const PictureOrigin&);

/// The text entries of a picture file, which record how it was made:
///
///     Software                           "glint 0.1.0"
///     GL_VENDOR, GL_RENDERER, GL_VERSION  the driver's; "glint-backend": "reference" without GL
///     glint-look                         the look, from saveLook()
///     glint-model                        the hash of the model
///     glint-variation                    if there is one
///     glint-key                          the key, computed with the look `keyed`
std::vector<std::pair<std::string, std::string>> pictureText(const Look& look, const Look& keyed,
                                                             const PictureOrigin&);

}  // namespace glint
