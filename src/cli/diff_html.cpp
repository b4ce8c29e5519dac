#include "diff_html.h"

#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "glint/image/report_page.h"

namespace glint {

extern const ReportPage diffPage;  // diff_page.html

void DiffHtml::write(const std::string& text) {
  file_.write(std::as_bytes(std::span(text)));
  written_ += text.size();
}

void DiffHtml::add(std::size_t index, bool differs, PairPictures pictures) {
  later_[index] = {differs, std::move(pictures)};
  for (auto first = later_.begin(); first != later_.end() && first->first == next_;
       first = later_.erase(first), ++next_)
    writePictures(next_, first->second.pictures, first->second.differs);
}

void DiffHtml::writePictures(std::size_t index, const PairPictures& pictures, bool differs) {
  if (!begun_) write(std::string(diffPage.begin));
  begun_ = true;
  // A browser opens some 100 MB at once; what is the same is looked at least.
  constexpr std::size_t longPage = 48u << 20;
  const bool same = !differs && !pictures.a.empty() && pictures.b.empty();
  if (same && written_ > longPage) return;
  for (const auto& [kind, bytes] :
       {std::pair{"a", &pictures.a}, std::pair{"b", &pictures.b}, std::pair{"m", &pictures.map}})
    if (!bytes->empty()) write(base64Element(kind + std::to_string(index), *bytes));
}

void DiffHtml::finish(const nlohmann::ordered_json& json) {
  if (!begun_) write(std::string(diffPage.begin));
  write(jsonElement("data",
                    json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)));
  write(std::string(diffPage.end));
  file_.commit();
}

}  // namespace glint
