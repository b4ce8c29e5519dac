#pragma once

#include <string>

#include "glint/study/report.h"

namespace glint {

/// The questions that a study answers, with the figures that answer them, in Markdown.
/// `command` is what makes the document again.
std::string studyResults(const StudyHead& head, const StudyResult& result,
                         const std::string& command);

}  // namespace glint
