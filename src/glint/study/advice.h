#pragma once

#include "glint/study/report.h"

namespace glint {

/// What to use where a picture may be off by so many 8-bit codes.
struct AdvisedForm {
  int codes = 1;
  /// Index of a variant: the most accurate of those within the codes at every compared pixel that
  /// cannot be told from the fastest of them. The exact one if none is faster than that.
  std::size_t variant = 0;
  TimeRatio time;  ///< of its time to the exact form's
};

/// For the model of the study's look, 1, 2 and 4 codes. Empty where the exact form was not timed
/// or no front can be told.
std::vector<AdvisedForm> advisedForms(const StudyHead& head, const StudyResult& result);

/// One paragraph: what to use for this model at this size, what it saves, and what a frame takes
/// its time for otherwise, with 95 % intervals. Empty if nothing was timed.
std::string adviceText(const StudyHead& head, const StudyResult& result);

}  // namespace glint
