#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/stability/bench.h"
#include "glint/stability/scenes.h"

namespace glint::stability {

/// What a search for NaN and infinity did and found.
struct SearchReport {
  std::uint64_t evaluations = 0;  ///< of programs, one point each
  std::uint64_t variants = 0, materials = 0;
  std::uint64_t scenes = 0, pathological = 0;
  std::uint64_t refused = 0;       ///< scenes refused with a message
  std::uint64_t notFinite = 0;     ///< points and scenes
  std::vector<std::string> finds;  ///< the inputs of the first few
  double pointSeconds = 0, sceneSeconds = 0;
};

/// Puts `evaluations` random combinations of attributes, materials, lights and cameras through
/// every program on the driver, and draws evaluations / 10000 random scenes, half of them
/// pathological, on the driver and by the reference: finite input must never give NaN or infinity.
/// `progress` receives the share done.
SearchReport searchNotFinite(Bench&, std::uint64_t evaluations,
                             const std::function<void(double)>& progress = {});

std::string searchText(const SearchReport&);
nlohmann::ordered_json searchJson(const SearchReport&);

/// A random scene and look; a pathological one has degenerate, huge, tiny and coincident parts,
/// singular transforms and extreme cameras. Finite throughout, as a loader promises.
struct RandomScene {
  Scene scene;
  Look look;
};
RandomScene randomScene(const Look& base, Random&, bool pathological);

}  // namespace glint::stability
