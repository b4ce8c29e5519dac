#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "glint/study/study.h"

namespace glint {

/// What a report says about a study besides its figures.
struct StudyHead {
  std::string version, model, backend;
  bool quick = false;
  Look look;
  std::string lookText;  ///< the look as a look file
  int rounds = 0, warmUp = 0, builds = 0;
  /// If not 0, the picture has half the usual width and height, since a frame takes more than this
  /// many ms.
  double longFrame = 0;
};

/// The whole result, without pictures.
nlohmann::ordered_json studyJson(const StudyHead& head, const StudyResult& result);

/// A line for each variant and model it is compared with.
std::string studyCsv(const StudyResult& result);

/// The table for a terminal: variants by model with times, errors and the front of RMSE.
std::string studyTable(const StudyHead& head, const StudyResult& result);

/// How it was measured, in sentences.
std::vector<std::string> studyMethod(const StudyHead& head, const StudyResult& result);

}  // namespace glint
