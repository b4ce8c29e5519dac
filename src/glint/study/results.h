#pragma once

#include <string>

#include "glint/study/report.h"

namespace glint {

/// The questions that a study answers, with the figures that answer them, in Markdown.
/// `command` is the command that reproduces the document.
std::string studyResults(const StudyHead& head, const StudyResult& result,
                         const std::string& command);

}  // namespace glint
