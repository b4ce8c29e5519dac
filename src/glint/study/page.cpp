#include "glint/study/page.h"

#include <nlohmann/json.hpp>

#include "glint/image/report_page.h"

namespace glint {

extern const ReportPage studyPageText;  // study_page.html

std::string studyPage(const nlohmann::ordered_json& json, const StudyResult& result) {
  std::string page(studyPageText.begin);
  page += jsonElement("data",
                      json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
  for (const PagePicture& picture : result.pictures) page += base64Element(picture.id, picture.png);
  return page.append(studyPageText.end);
}

}  // namespace glint
