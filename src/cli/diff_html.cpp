#include "diff_html.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "diff_report.h"
#include "glint/image/error.h"
#include "glint/image/flip.h"
#include "glint/image/report_page.h"

namespace glint {

extern const ReportPage diffPage;  // diff_page.html

namespace {

namespace fs = std::filesystem;

/// The pair that the page shows first: the one with the largest error among those that differ, or
/// else one of the next kind in the list.
std::size_t firstShown(const nlohmann::ordered_json& pairs) {
  const auto rank = [](const nlohmann::ordered_json& pair) {
    constexpr std::string_view kinds[] = {"differs", "error", "missing", "no baseline", "same"};
    const auto place = std::find(std::begin(kinds), std::end(kinds), kindOf(pair));
    double error = 0;
    for (const char* name : {"max", "hdr-flip", "flip"})
      if (pair.contains("metrics") && pair["metrics"].contains(name) &&
          pair["metrics"][name]["value"].is_number())
        error = pair["metrics"][name]["value"].get<double>();
    return std::pair(place - std::begin(kinds), -error);
  };
  const auto first = std::min_element(
      pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return std::size_t(first - pairs.begin());
}

/// The colours of FLIP's map as "rrggbb", one for each of 256 errors, so that a colour gives its
/// error.
std::string magmaText() {
  std::string text;
  for (int i = 0; i < 256; ++i) {
    unsigned char rgb[3];
    magma(float(i) / 255, rgb);
    char hex[8];
    std::snprintf(hex, sizeof hex, "%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
    text += hex;
  }
  return text;
}

}  // namespace

DiffHtml::DiffHtml(const std::string& path, bool beside)
    : file_(path), folder_(beside ? path + ".pictures" : ""), kept_(std::tmpfile(), std::fclose) {
  if (!kept_)
    throw InputError("cannot make a temporary file: set TMPDIR to a folder with free space");
}

void DiffHtml::keep(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), kept_.get()) != text.size())
    throw InputError(
        "the report's temporary file: no space left: set TMPDIR to a folder with free space");
  written_ += text.size();
}

void DiffHtml::add(std::size_t index, bool differs, PairPictures pictures) {
  later_[index] = {differs, std::move(pictures)};
  for (auto first = later_.begin(); first != later_.end() && first->first == next_;
       first = later_.erase(first), ++next_)
    writePictures(next_, first->second.pictures, first->second.differs);
}

void DiffHtml::writePictures(std::size_t index, const PairPictures& pictures, bool differs) {
  thumbnails_[index] = pictures.thumbnail;
  // A browser opens some 100 MB at once; equal pairs are the least interesting.
  constexpr std::size_t longPage = 48u << 20;
  const bool same = !differs && !pictures.a.empty() && pictures.b.empty();
  if (same && written_ > longPage) return;
  const std::size_t begin = written_;
  for (const auto& [kind, bytes] :
       {std::pair{'a', &pictures.a}, std::pair{'b', &pictures.b}, std::pair{'m', &pictures.map},
        std::pair{'v', &pictures.valuesA}, std::pair{'w', &pictures.valuesB}}) {
    if (bytes->empty()) continue;
    const std::string name = kind + std::to_string(index);
    kinds_[index] += kind;
    if (folder_.empty()) {
      keep(base64Element(name, *bytes));
      continue;
    }
    // A page opened from a file must not read other files, but it may run their scripts.
    const std::string text = "picture('" + name + "','" + base64(*bytes) + "')\n";
    OutputFile file(folder_ + "/" + name + ".js");
    file.write(text);
    file.commit();
  }
  places_[index] = {begin, written_};
}

void DiffHtml::copyKept(std::size_t begin, std::size_t end) {
  if (std::fseek(kept_.get(), long(begin), SEEK_SET) != 0)
    throw InputError("the temporary file of the report cannot be read: set TMPDIR");
  std::vector<char> piece(1 << 20);
  while (begin < end) {
    const std::size_t count =
        std::fread(piece.data(), 1, std::min(piece.size(), end - begin), kept_.get());
    if (count == 0) throw InputError("the temporary file of the report cannot be read: set TMPDIR");
    file_.write(std::string_view(piece.data(), count));
    begin += count;
  }
}

void DiffHtml::finish(const nlohmann::ordered_json& json) {
  nlohmann::ordered_json whole = json;
  whole["magma"] = magmaText();
  if (!folder_.empty()) whole["pictures"] = fs::path(folder_).filename().string();
  for (const auto& [index, kinds] : kinds_) whole["pairs"][index]["pictures"] = kinds;
  for (const auto& [index, bytes] : thumbnails_)
    if (!bytes.empty()) whole["pairs"][index]["thumbnail"] = base64(bytes);
  file_.write(diffPage.begin);
  file_.write(jsonElement(
      "data", whole.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)));
  file_.write(diffPage.end);
  // The pair that is shown first is written first: the others may be 100 MB.
  const auto [begin, end] = places_[firstShown(whole["pairs"])];
  copyKept(begin, end);
  copyKept(0, begin);
  copyKept(end, written_);
  file_.commit();
}

}  // namespace glint
