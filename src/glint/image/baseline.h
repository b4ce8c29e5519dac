#pragma once

#include <string>

#include "glint/image/compare.h"
#include "glint/image/picture_writer.h"

namespace glint {

struct BaselineOptions {
  CompareOptions compare;
  /// How the picture is written before it is compared, as a program would write it: bit depth,
  /// exposure, alpha.
  PictureOptions file;
  /// Where the picture and its difference go, each by the baseline's name: FOLDER/actual/NAME and
  /// FOLDER/difference/NAME.png. Empty: the environment's GLINT_IMAGE_TEST_OUTPUT, or else
  /// "image-tests" in the working folder.
  std::string folder;
};

enum class BaselineStatus {
  same,
  differs,
  missing,  ///< there is no baseline; the actual picture is its candidate
  updated   ///< it has been made or replaced, since the environment says GLINT_UPDATE_BASELINES=1
};

struct BaselineResult {
  BaselineStatus status = BaselineStatus::missing;
  Comparison comparison;           ///< of same and differs
  std::string actual, difference;  ///< paths; difference is empty where there is none
  std::string message;             ///< what happened, and what to do; several lines
};

/// Writes a picture in the format of the baseline's name (PNG, EXR, PFM), and compares the file
/// with the baseline. Throws InputError for what cannot be read, written or compared.
BaselineResult compareWithBaseline(const Image& picture, const std::string& baseline,
                                   const BaselineOptions& options = {});

}  // namespace glint
