#pragma once

namespace glint {

/// The report's page, before and after its data (diff_page.html, divided at its DATA comment).
extern const char* const diffPageBegin;
extern const char* const diffPageEnd;

}  // namespace glint
