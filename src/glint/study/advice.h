#pragma once

#include "glint/study/report.h"

namespace glint {

/// What to use where a picture may be off by `codes` 8-bit codes.
struct AdvisedForm {
  int codes = 1;
  /// Index of a variant: of those within the codes at every compared pixel, the most accurate one
  /// whose time cannot be told from the fastest's. The exact one if none is faster than it.
  std::size_t variant = 0;
  TimeRatio time;  ///< of its time to that of the exact form
};

/// For the model of the study's look, with 1, 2 and 4 codes. Empty if the exact form was not timed
/// or there is no front.
std::vector<AdvisedForm> advisedForms(const StudyHead& head, const StudyResult& result);

/// One paragraph: what to use for this model at this size, what it saves, and where the rest of a
/// frame's time goes, with 95 % intervals. Empty if nothing was timed.
std::string adviceText(const StudyHead& head, const StudyResult& result);

}  // namespace glint
