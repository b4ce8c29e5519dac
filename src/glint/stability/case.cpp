#include "glint/stability/case.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "glint/image/error.h"
#include "glint/render/probe_error.h"

namespace glint::stability {

std::string numberText(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

namespace {

/// 0 where the expected value is 0, since its spacing says nothing.
double ulpsOf(double error, double expected) {
  return expected == 0 ? 0 : error / floatSpacing(expected);
}

}  // namespace

void Record::near(const std::string& what, double got, double expected, double tolerance) {
  Finding f;
  f.what = what;
  f.expected = numberText(expected);
  f.got = numberText(got);
  f.error = got == expected ? 0 : std::abs(got - expected);
  if (std::isnan(f.error)) f.error = std::numeric_limits<double>::infinity();
  f.tolerance = tolerance;
  f.ulp = f.error == 0 ? 0 : ulpsOf(f.error, expected);
  f.levels = 255 * f.error;
  f.passed = f.error <= tolerance;
  findings_.push_back(std::move(f));
}

void Record::within(const std::string& what, double got, double low, double high) {
  Finding f;
  f.what = what;
  f.expected = "from " + numberText(low) + " to " + numberText(high);
  f.got = numberText(got);
  f.passed = got >= low && got <= high;
  if (!f.passed) {
    const double nearest = got < low ? low : high;
    f.error = std::isnan(got) ? std::numeric_limits<double>::infinity() : std::abs(got - nearest);
    f.ulp = ulpsOf(f.error, nearest);
    f.levels = 255 * f.error;
  }
  findings_.push_back(std::move(f));
}

void Record::same(const std::string& what, const std::string& got, const std::string& expected) {
  Finding f;
  f.what = what;
  f.expected = expected;
  f.got = got;
  f.passed = got == expected;
  findings_.push_back(std::move(f));
}

void Record::that(const std::string& what, bool holds, const std::string& got) {
  Finding f;
  f.what = what;
  f.expected = "holds";
  f.got = holds ? "holds" : got.empty() ? "does not hold" : got;
  f.passed = holds;
  findings_.push_back(std::move(f));
}

void Record::refused(const std::string& what, const std::function<void()>& action,
                     const std::string& part) {
  Finding f;
  f.what = what;
  f.expected = "refused with \"..." + part + "...\"";
  f.got = "taken";
  try {
    action();
  } catch (const InputError& error) {
    f.got = error.what();
    f.passed = f.got.find(part) != std::string::npos && f.got.find('\n') == std::string::npos;
  }
  findings_.push_back(std::move(f));
}

void Record::finite(const std::string& what, const Image& image) {
  std::size_t count = 0;
  for (float x : image.values) count += !std::isfinite(x);
  Finding f;
  f.what = what;
  f.expected = "finite in every pixel";
  f.got = count == 0 ? f.expected : std::to_string(count) + " values are not finite";
  f.passed = count == 0 && !image.values.empty();
  findings_.push_back(std::move(f));
}

void Record::alike(const std::string& what, const Image& got, const Image& expected,
                   double tolerance) {
  if (got.values.size() != expected.values.size() || got.values.empty())
    return that(what, false, "pictures of different sizes");
  std::size_t at = 0;
  double worst = -1;
  for (std::size_t i = 0; i < got.values.size(); ++i) {
    const double error = absoluteError(got.values[i], expected.values[i]);
    if (error > worst) worst = error, at = i;
  }
  const std::size_t pixel = at / 4, width = std::size_t(got.width);
  near(what + ", worst at pixel " + std::to_string(pixel % width) + "," +
           std::to_string(pixel / width),
       got.values[at], expected.values[at], tolerance);
}

void Record::color(const std::string& what, const glm::dvec3& got, const glm::dvec3& expected,
                   double tolerance) {
  Worst worst;
  const char* const names[] = {"red", "green", "blue"};
  for (int i = 0; i < 3; ++i) worst.add(got[i], expected[i], tolerance, names[i]);
  worst.into(*this, what);
}

bool Record::passed() const {
  return !findings_.empty() &&
         std::all_of(findings_.begin(), findings_.end(), [](const Finding& f) { return f.passed; });
}

void Worst::add(double got, double expected, double tolerance, const std::string& where) {
  double error = got == expected ? 0 : std::abs(got - expected);
  if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
  const double share =
      error == 0 ? 0 : error / std::max(tolerance, std::numeric_limits<double>::min());
  if (!(share > share_)) return;
  got_ = got;
  expected_ = expected;
  tolerance_ = tolerance;
  error_ = error;
  share_ = share;
  where_ = where;
}

void Worst::into(Record& record, const std::string& what) const {
  if (share_ < 0) return record.that(what, false, "nothing was compared");
  record.near(where_.empty() ? what : what + ", worst at " + where_, got_, expected_, tolerance_);
}

}  // namespace glint::stability
