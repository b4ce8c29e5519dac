#include "diff_layers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "glint/image/file.h"
#include "glint/image/metrics.h"

namespace glint {
namespace {

bool isOfValues(const std::string& metric) {
  for (const detail::MetricRow& row : detail::metricRows())
    if (row.name == metric) return row.ofValues != nullptr;
  return false;
}

std::string layerName(const std::string& name) {
  return name.empty() ? "the main picture" : "layer " + printablePath(name);
}

void noteUnfollowed(const StoredImage& a, const StoredImage& b, DiffEntry& entry) {
  std::map<std::string, std::pair<std::string, std::string>> facts;
  for (const auto& [what, value] : a.unfollowed) facts[what].first = value.empty() ? "yes" : value;
  for (const auto& [what, value] : b.unfollowed) facts[what].second = value.empty() ? "yes" : value;
  for (const auto& [what, values] : facts) {
    const auto& [inA, inB] = values;
    const std::string text =
        inA == inB ? inA : (inA.empty() ? "none" : inA) + " and " + (inB.empty() ? "none" : inB);
    entry.unfollowed[what] = printablePath(text);
  }
}

}  // namespace

std::pair<float, float> rangeOf(const StoredImage& image) {
  if (image.isEncoded()) return {0.0f, 1.0f};
  float low = INFINITY, high = -INFINITY;
  for (const float value : std::get<2>(image.values)) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low <= high ? std::pair{low, high} : std::pair{0.0f, 1.0f};
}

std::pair<float, float> LayerPair::range() const {
  const auto [lowA, highA] = rangeOf(a->image);
  const auto [lowB, highB] = rangeOf(b->image);
  return {std::min(lowA, lowB), std::max(highA, highB)};
}

double shownScale(const LayerPair& pair) {
  const auto [low, high] = pair.range();
  return high > low ? 1.0 / (double(high) - double(low)) : 1;
}

LayerPairs matchLayers(const PictureLayers& a, const PictureLayers& b, DiffEntry& entry) {
  LayerPairs pairs;
  noteUnfollowed(a.layers[0].image, b.layers[0].image, entry);
  for (const PictureLayers* read : {&a, &b})
    for (const std::string& what : read->skipped)
      if (std::find(entry.notCompared.begin(), entry.notCompared.end(), what) ==
          entry.notCompared.end())
        entry.notCompared.push_back(what);
  const bool named = a.named && b.named;
  if (!named) {
    pairs.matched.push_back({&a.layers[0], &b.layers[0]});
    return pairs;
  }
  const auto find = [](const PictureLayers& in, const std::string& name) -> const PictureLayer* {
    for (const PictureLayer& layer : in.layers)
      if (layer.name == name) return &layer;
    return nullptr;
  };
  for (const PictureLayer& layer : a.layers) {
    const PictureLayer* const other = find(b, layer.name);
    if (!other) {
      pairs.missing.push_back(layerName(layer.name) + " is missing in the picture");
      continue;
    }
    pairs.matched.push_back({&layer, other});
    for (const std::string& channel : layer.channels)
      if (std::count(other->channels.begin(), other->channels.end(), channel) == 0)
        pairs.missing.push_back("channel " + printablePath(channel) + " is missing in the picture");
    for (const std::string& channel : other->channels)
      if (std::count(layer.channels.begin(), layer.channels.end(), channel) == 0)
        pairs.missing.push_back("channel " + printablePath(channel) +
                                " is missing in the baseline");
  }
  for (const PictureLayer& layer : b.layers)
    if (!find(a, layer.name))
      pairs.missing.push_back(layerName(layer.name) + " is missing in the baseline");
  for (std::size_t i = 0; i < pairs.matched.size(); ++i) {
    if (pairs.matched[i].a->image.values == pairs.matched[i].b->image.values) continue;
    pairs.shown = i;
    break;
  }
  return pairs;
}

void addLayer(const LayerPair& pair, const CompareOptions& given, bool first, bool besideColours,
              DiffEntry& entry) {
  CompareOptions options = given;
  bool judged = true;
  if (!pair.a->colour) {
    const bool equality = given.conditions.empty() && given.maxPixels.empty();
    std::erase_if(options.conditions, [](const auto& c) { return !isOfValues(c.metric); });
    std::erase_if(options.metrics, [](const auto& name) { return !isOfValues(name); });
    options.maxPixels.clear();
    options.flipMap = {};
    options.alpha = AlphaUse::ignored;
    options.values = ValueSpace::asStored;
    judged = equality || !options.conditions.empty();
  }
  Comparison result = compare(pair.a->image, pair.b->image, options);
  if (!judged && !result.sizesDiffer) {
    result.failures.clear();
    if (result.differing > 0) {
      char text[128];
      std::snprintf(text, sizeof text, " %zu %s (max %.5g), which no condition judges",
                    result.differing, result.differing == 1 ? "pixel" : "pixels",
                    result.values["max"]);
      if (besideColours)
        entry.notes.push_back(layerName(pair.a->name) + " differs in" + text);
      else
        result.failures.push_back(std::string("it differs in") + text +
                                  ": give a condition on values (--metric max --threshold T)");
    }
    result.same = result.failures.empty();
  }
  if (first) {
    entry.result = std::move(result);
    entry.mainName = pair.a->name;
    return;
  }
  for (const std::string& failure : result.failures)
    entry.result.failures.push_back(layerName(pair.a->name) + ": " + failure);
  entry.result.same = entry.result.same && result.same;
  entry.layers.push_back({pair.a->name, std::move(result)});
}

}  // namespace glint
