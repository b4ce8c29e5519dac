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

/// What is no number is off by infinity.
double distance(double got, double expected) {
  if (got == expected) return 0;  // equal infinities too
  const double error = std::abs(got - expected);
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

}  // namespace

Finding& Record::add(const std::string& what, const std::string& expected, const std::string& got,
                     bool passed) {
  Finding& f = findings_.emplace_back();
  f.what = what;
  f.expected = expected;
  f.got = got;
  f.passed = passed;
  return f;
}

void Record::near(const std::string& what, double got, double expected, double tolerance) {
  const double error = distance(got, expected);
  Finding& f = add(what, numberText(expected), numberText(got), error <= tolerance);
  f.error = error;
  f.tolerance = tolerance;
  f.ulp = error == 0 ? 0 : ulpsOf(error, expected);
  f.levels = 255 * error;
}

void Record::within(const std::string& what, double got, double low, double high) {
  Finding& f = add(what, "from " + numberText(low) + " to " + numberText(high), numberText(got),
                   got >= low && got <= high);
  if (f.passed) return;
  const double nearest = got < low ? low : high;
  f.error = distance(got, nearest);
  f.ulp = ulpsOf(f.error, nearest);
  f.levels = 255 * f.error;
}

void Record::that(const std::string& what, bool holds, const std::string& got) {
  add(what, "holds", holds ? "holds" : got.empty() ? "does not hold" : got, holds);
}

void Record::refused(const std::string& what, const std::function<void()>& action,
                     const std::string& part) {
  Finding& f = add(what, "refused with \"..." + part + "...\"", "taken", false);
  try {
    action();
  } catch (const InputError& error) {
    f.got = error.what();
    f.passed = f.got.find(part) != std::string::npos && f.got.find('\n') == std::string::npos;
  }
}

void Record::refused(const std::string& what, std::initializer_list<const char*> texts,
                     const std::function<void(const std::string&)>& take, const std::string& part) {
  for (const std::string text : texts)
    refused(
        what + text, [&] { take(text); }, part);
}

void Record::finite(const std::string& what, const Image& image) {
  std::size_t count = 0;
  for (float x : image.values) count += !std::isfinite(x);
  const std::string good = "finite in every pixel";
  add(what, good, count == 0 ? good : std::to_string(count) + " values are not finite",
      count == 0 && !image.values.empty());
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

void Worst::add(double got, double expected, double tolerance, const std::string& where) {
  const double error = distance(got, expected);
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
