#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "glint/image/baseline.h"

namespace glint {

/// Matchers for GoogleTest (1.11 or later), which this header does not depend on:
///
///     EXPECT_THAT(picture, glint::LooksLike(other, {{"flip", 0.02}}));
///     EXPECT_THAT(picture, glint::MatchesBaseline("baselines/teapot.png", {{"max", 0.01}}));
///
/// A failure's message lists the values that exceed their bounds and the worst pixels with both
/// values; MatchesBaseline's also gives the paths of the picture and its difference. Without
/// conditions the pictures must be equal. Pictures that cannot be compared or read do not match.
/// Nor does a picture whose baseline has just been created: a test never accepts it unseen.
class PictureMatcher {
 public:
  using is_gtest_matcher = void;

  bool MatchAndExplain(const Image& picture, std::ostream* listener) const;
  void DescribeTo(std::ostream* out) const;
  void DescribeNegationTo(std::ostream* out) const;

 private:
  friend PictureMatcher LooksLike(Image, CompareOptions);
  friend PictureMatcher MatchesBaseline(std::string, BaselineOptions);
  std::string describe() const;

  Image expected_;        ///< used if there is no baseline
  std::string baseline_;  ///< path
  BaselineOptions options_;
  /// Set when a baseline has been created: GoogleTest calls again for the explanation.
  std::shared_ptr<std::string> made_ = std::make_shared<std::string>();
};

/// Compares both pictures' values as they are, in linear light.
PictureMatcher LooksLike(Image expected, CompareOptions options);
PictureMatcher LooksLike(Image expected, std::vector<Condition> conditions = {});
/// See compareWithBaseline().
PictureMatcher MatchesBaseline(std::string path, BaselineOptions options);
PictureMatcher MatchesBaseline(std::string path, std::vector<Condition> conditions = {});

/// Prints a picture for GoogleTest: its size.
void PrintTo(const Image& picture, std::ostream* out);

}  // namespace glint
