#include "glint/image/matchers.h"

#include <ostream>
#include <utility>

#include "glint/image/error.h"

namespace glint {

bool PictureMatcher::MatchAndExplain(const Image& picture, std::ostream* listener) const {
  std::string message;
  bool same = false;
  try {
    if (baseline_.empty()) {
      const Comparison result = compare(expected_, picture, options_.compare);
      same = result.same;
      for (const std::string& failure : result.failures)
        message += (message.empty() ? "" : "; ") + failure;
      message += "\n" + result.worstText();
    } else if (!made_->empty()) {
      message = *made_;
    } else {
      const BaselineResult result = compareWithBaseline(picture, baseline_, options_);
      same = result.status == BaselineStatus::same;
      message = result.message;
      if (result.status == BaselineStatus::updated) *made_ = message;
    }
  } catch (const Error& error) {
    message = error.what();
  }
  if (listener && !same) *listener << message;
  return same;
}

std::string PictureMatcher::describe() const {
  std::string text = baseline_.empty() ? "like the picture expected" : "like " + baseline_;
  for (const auto& [metric, threshold] : options_.compare.conditions)
    text += (isSimilarity(metric) ? ", at least " : ", at most ") + std::to_string(threshold) +
            " by " + metric;
  return options_.compare.conditions.empty() ? text + ", pixel by pixel" : text;
}

void PictureMatcher::DescribeTo(std::ostream* out) const { *out << "looks " << describe(); }

void PictureMatcher::DescribeNegationTo(std::ostream* out) const {
  *out << "does not look " << describe();
}

PictureMatcher LooksLike(Image expected, CompareOptions options) {
  PictureMatcher matcher;
  matcher.expected_ = std::move(expected);
  matcher.options_.compare = std::move(options);
  return matcher;
}

PictureMatcher LooksLike(Image expected, std::vector<Condition> conditions) {
  CompareOptions options;
  options.conditions = std::move(conditions);
  return LooksLike(std::move(expected), std::move(options));
}

PictureMatcher MatchesBaseline(std::string path, BaselineOptions options) {
  PictureMatcher matcher;
  matcher.baseline_ = std::move(path);
  matcher.options_ = std::move(options);
  return matcher;
}

PictureMatcher MatchesBaseline(std::string path, std::vector<Condition> conditions) {
  BaselineOptions options;
  options.compare.conditions = std::move(conditions);
  return MatchesBaseline(std::move(path), std::move(options));
}

void PrintTo(const Image& picture, std::ostream* out) {
  *out << "a picture of " << picture.width << " x " << picture.height << " pixels";
}

}  // namespace glint
