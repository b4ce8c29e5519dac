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
  /// Folder for the picture and its difference, both named after the baseline: FOLDER/actual/NAME
  /// and FOLDER/difference/NAME.png. If empty, the environment variable GLINT_IMAGE_TEST_OUTPUT, or
  /// else "image-tests" in the working folder.
  std::string folder;
};

enum class BaselineStatus {
  same,
  differs,
  missing,  ///< no baseline exists; the actual picture is the candidate
  updated   ///< the baseline was created or replaced because GLINT_UPDATE_BASELINES=1 is set
};

struct BaselineResult {
  BaselineStatus status = BaselineStatus::missing;
  Comparison comparison;           ///< set for `same` and `differs`
  std::string actual, difference;  ///< paths; difference is empty if none was written
  std::string message;             ///< what happened, and what to do; several lines
};

/// Writes a picture in the format that the baseline's name implies (PNG, EXR, PFM) and compares
/// that file with the baseline. Throws InputError for files that cannot be read, written or
/// compared.
BaselineResult compareWithBaseline(const Image& picture, const std::string& baseline,
                                   const BaselineOptions& options = {});

}  // namespace glint
