#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/image/image.h"

namespace glint::stability {

class Bench;

/// The result of one check of a case.
struct Finding {
  std::string what;           ///< where and for which input
  std::string expected, got;  ///< as text
  double error = 0;           ///< in the value's unit; 0 where nothing numeric is compared
  double tolerance = 0;
  double ulp = 0;     ///< the error in float spacings at the expected value
  double levels = 0;  ///< the error in levels of an 8-bit picture, before the sRGB curve
  bool passed = false;
};

/// What a case finds. Every check is kept, so that a report can show how close each came to its
/// tolerance.
class Record {
 public:
  /// |got - expected| <= tolerance; a NaN fails.
  void near(const std::string& what, double got, double expected, double tolerance);
  /// low <= got <= high.
  void within(const std::string& what, double got, double low, double high);

  /// A property described in words.
  void that(const std::string& what, bool holds, const std::string& got = {});
  /// `action` must throw an InputError of one line that contains `part`.
  void refused(const std::string& what, const std::function<void()>& action,
               const std::string& part);
  /// The same for each of some texts, `what` and the text being its name.
  void refused(const std::string& what, std::initializer_list<const char*> texts,
               const std::function<void(const std::string&)>& take, const std::string& part);
  /// No value of the picture is NaN or infinite.
  void finite(const std::string& what, const Image& image);
  /// The worst of red, green and blue.
  void color(const std::string& what, const glm::dvec3& got, const glm::dvec3& expected,
             double tolerance);
  /// The largest difference of two pictures of one size.
  void alike(const std::string& what, const Image& got, const Image& expected, double tolerance);

  const std::vector<Finding>& findings() const { return findings_; }

 private:
  Finding& add(const std::string& what, const std::string& expected, const std::string& got,
               bool passed);

  std::vector<Finding> findings_;
};

/// The worst of many values against their truths, as one finding: that with the largest error
/// relative to its tolerance.
class Worst {
 public:
  void add(double got, double expected, double tolerance, const std::string& where);
  /// Adds the finding; `what` begins its text. It counts as a failure if no value was added.
  void into(Record& record, const std::string& what) const;
  double error() const { return error_; }

 private:
  double got_ = 0, expected_ = 0, tolerance_ = 0, error_ = 0, share_ = -1;
  std::string where_;
};

/// A hard case: what goes in, what must come out, how exactly and why.
struct Case {
  std::string_view id;         ///< "A1": the letter is its group
  std::string_view input;      ///< what goes in
  std::string_view expected;   ///< the value or property
  std::string_view tolerance;  ///< how exactly, and where that comes from
  std::string_view reason;     ///< what goes wrong otherwise
  std::string_view policy;  ///< the convention where there is no single right value; may be empty
  void (*run)(Bench&, Record&);
};

struct Group {
  char letter;
  std::string_view name;
  std::span<const Case> cases;
  bool catalogue = true;  ///< in the catalogue of 118 cases; otherwise added beyond it
};

// The groups, one file each.
std::span<const Case> attributeCases();
std::span<const Case> transformCases();
std::span<const Case> directionCases();
std::span<const Case> exponentCases();
std::span<const Case> fresnelCases();
std::span<const Case> lightCases();
std::span<const Case> cameraCases();
std::span<const Case> outputCases();
std::span<const Case> interpolationCases();
std::span<const Case> propertyCases();
std::span<const Case> limitCases();
std::span<const Case> mappingCases();

/// All groups, in the order of the report.
std::span<const Group> groups();

/// A number as reports show it: 9 significant digits.
std::string numberText(double);

}  // namespace glint::stability
