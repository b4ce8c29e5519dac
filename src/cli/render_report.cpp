#include "render_report.h"

#include <cmath>
#include <cstdio>
#include <span>

#include "commands.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

std::string indented(const std::string& text, int spaces) {
  std::string out;
  for (const char c : text) {
    out += c;
    if (c == '\n') out.append(std::size_t(spaces), ' ');
  }
  return out;
}

std::string timeText(double seconds) {
  const long long all = std::llround(seconds);
  if (all < 60) return std::to_string(all) + " s";
  char text[32];
  if (all < 3600)
    std::snprintf(text, sizeof text, "%lld:%02lld min", all / 60, all % 60);
  else
    std::snprintf(text, sizeof text, "%lld:%02lld h", all / 3600, all / 60 % 60);
  return text;
}

}  // namespace

std::string progressText(std::size_t done, std::size_t skipped, std::optional<std::size_t> all,
                         double seconds) {
  std::string text = std::to_string(done);
  if (all) text += " of " + std::to_string(*all);
  text += done == 1 && !all ? " picture" : " pictures";
  if (skipped > 0) text += " (" + std::to_string(skipped) + " already existed)";
  const double rate = double(done - skipped) / seconds;  // skipped pictures take no time
  if (!(rate > 0) || !std::isfinite(rate)) return text;
  char words[48];
  std::snprintf(words, sizeof words, ", %.*f per second", rate < 10 ? 2 : 0, rate);
  text += words;
  if (all && *all >= done) text += ", " + timeText(double(*all - done) / rate) + " left";
  return text;
}

RenderReport::RenderReport(const RenderOptions& options, StatusLine& line)
    : options_(options), line_(line) {}

void RenderReport::begin(const std::string& backend, const std::optional<GlStrings>& gl) {
  if (options_.json.empty() || (options_.json == "-" && options_.hasList())) return;
  Json head{{"glint", GLINT_VERSION}, {"backend", backend}};
  if (gl)
    head["gl"] = {{"vendor", gl->vendor}, {"renderer", gl->renderer}, {"version", gl->version}};
  std::string text = head.dump(2, ' ', false, Json::error_handler_t::replace);
  text.resize(text.rfind('\n'));
  file_ = std::make_unique<OutputFile>(options_.json);
  file_->write(text + ",\n  \"pictures\": [");
}

void RenderReport::add(PictureResult result) {
  for (const std::string& warning : result.news) line_.print("glint: warning: " + warning);
  result.entry["warnings"] = result.warnings;
  if (!result.error.empty()) {
    if (result.errorIsNew) line_.print("glint: " + result.error);
    result.entry["error"] = result.error;
  }
  const int status = result.entry.value("status", int(glint::done));
  failed_ = failed_ || status == unusable;
  differs_ = differs_ || status == differs;
  noBaseline_ = noBaseline_ || status == noBaseline;
  // Paths need not be UTF-8.
  constexpr auto replace = Json::error_handler_t::replace;
  if (options_.hasList()) line_.printOut(result.entry.dump(-1, ' ', false, replace));
  if (file_)
    file_->write((done_ > 0 ? ",\n    " : "\n    ") +
                 indented(result.entry.dump(2, ' ', false, replace), 4));
  ++done_;
  skipped_ += result.entry.contains("skipped");
  if (expected_.value_or(2) > 1)
    line_.show(progressText(done_, skipped_, expected_, line_.seconds()));
}

void RenderReport::finish() {
  if (!file_) return;
  file_->write(done_ > 0 ? "\n  ]\n}\n" : "]\n}\n");
  file_->commit();
  file_.reset();
}

int RenderReport::status() const {
  return failed_ ? unusable : differs_ ? differs : noBaseline_ ? noBaseline : glint::done;
}

}  // namespace glint
