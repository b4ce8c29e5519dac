#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "glint/study/study.h"

namespace glint {

/// The report as one HTML page that needs no other file. `json` is that of studyJson; the result
/// must have kept its pictures.
std::string studyPage(const nlohmann::ordered_json& json, const StudyResult& result);

/// The plot of time against the RMSE with the front, of the first model, as an SVG file.
std::string studyPlot(const nlohmann::ordered_json& json);

}  // namespace glint
