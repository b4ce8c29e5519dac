#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace glint {

/// A float's place in the order of all floats: grows by one from each float to the next; 0 for both
/// 0 and -0.
std::int32_t floatOrder(float x);
float floatAtOrder(std::int32_t order);

/// The float `steps` floats above x (below, if negative); stops at the infinities.
float stepFloat(float x, std::int64_t steps);

/// The range of one number of a search's input.
struct SearchRange {
  float low = 0, high = 1;      ///< both included
  std::vector<float> specials;  ///< values near which errors hide: limits, switches, poles
};

struct SearchResult {
  std::vector<float> input;  ///< one number for each range
  double error = 0;
};

/// The errors of rows of inputs: one column for each range, one error for each row.
using SearchErrors = std::function<std::vector<double>(const std::vector<std::vector<float>>&)>;

/// Searches for the input with the largest error: draws uniformly over the range, over its floats,
/// and up to 2^16 floats away from ends and special values; then continues from the worst inputs
/// found, changing one number or all of them by steps from a quarter of the range down to a single
/// float. `rows` inputs a round. The result is a lower bound of the largest error, not a proof.
SearchResult huntWorst(const std::vector<SearchRange>& ranges, const SearchErrors& errors,
                       std::size_t rows, int rounds, std::uint32_t seed = 1);

}  // namespace glint
