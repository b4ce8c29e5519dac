#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "glint/image/baseline.h"

namespace glint {

/// Matchers for GoogleTest (1.11 or later), which this header needs not:
///
///     EXPECT_THAT(picture, glint::LooksLike(other, {{"flip", 0.02}}));
///     EXPECT_THAT(picture, glint::MatchesBaseline("baselines/teapot.png", {{"max", 0.01}}));
///
/// A failure's message has the values that are over their bounds and the worst pixels with both
/// values; that of MatchesBaseline also says where the picture and its difference are. Without
/// conditions the pictures must be equal. What cannot be compared or read does not match either,
/// nor does a picture of which a baseline has just been made: a test never accepts it unseen.
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

  Image expected_;        ///< if there is no baseline
  std::string baseline_;  ///< path
  BaselineOptions options_;
  /// That a baseline has been made: GoogleTest asks once more for the explanation.
  std::shared_ptr<std::string> made_ = std::make_shared<std::string>();
};

/// Values of both pictures are compared as they are, in linear light.
PictureMatcher LooksLike(Image expected, CompareOptions options);
PictureMatcher LooksLike(Image expected, std::vector<Condition> conditions = {});
/// See compareWithBaseline().
PictureMatcher MatchesBaseline(std::string path, BaselineOptions options);
PictureMatcher MatchesBaseline(std::string path, std::vector<Condition> conditions = {});

/// What GoogleTest prints for a picture: its size.
void PrintTo(const Image& picture, std::ostream* out);

}  // namespace glint
