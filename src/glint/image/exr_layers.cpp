#include "glint/image/exr_layers.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfPartType.h>

#include <algorithm>
#include <set>

namespace glint::detail {
namespace {

/// The channels whose names are `prefix` plus one more word, without the prefix.
std::vector<std::string> channelsOf(const Imf::Header& header, const std::string& prefix) {
  std::vector<std::string> found;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    const std::string name = i.name();
    if (name.starts_with(prefix) && name.find('.', prefix.size()) == std::string::npos)
      found.push_back(name.substr(prefix.size()));
  }
  return found;
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() ? b : b.empty() ? a : a + "." + b;
}

/// Adds the layers with one prefix in one part. Every channel that is not a colour becomes its own
/// layer: X, Y, Z are not luminance, and depth next to RGB is compared as it is.
void addLayers(const Imf::Header& header, int part, const std::string& partName,
               const std::string& prefix, std::vector<ExrLayer>& layers) {
  std::vector<std::string> left = channelsOf(header, prefix);
  const auto has = [&](const char* name) {
    return std::find(left.begin(), left.end(), name) != left.end();
  };
  ExrLayer layer;
  layer.part = part;
  layer.prefix = prefix;
  layer.deep = header.hasType() && Imf::isDeepData(header.type());
  const auto add = [&](const std::string& name) {
    layer.alias = name;
    layer.name = joined(partName, name);
    layers.push_back(layer);
  };
  const bool rgb = has("R") || has("G") || has("B");
  const bool luminance = !rgb && has("Y") && !has("X");
  if (rgb || luminance) {
    layer.colour = true;
    layer.chroma = luminance && has("RY") && has("BY");
    for (const int c : {0, 1, 2}) {
      const char* const name = luminance ? "Y" : c == 0 ? "R" : c == 1 ? "G" : "B";
      if (has(name)) layer.channels[std::size_t(c)] = prefix + name;
    }
    if (has("A")) layer.channels[3] = prefix + "A";
    std::set<std::string> used{"R", "G", "B", "A"};
    if (luminance) used = {"Y", "A"};
    if (layer.chroma) used.insert({"RY", "BY"});
    std::erase_if(left, [&](const std::string& one) { return used.count(one) > 0; });
    add(prefix.substr(0, prefix.empty() ? 0 : prefix.size() - 1));
  }
  layer.colour = layer.chroma = false;
  for (const std::string& one : left) {
    layer.channels = {prefix + one, prefix + one, prefix + one, ""};
    add(prefix + one);
  }
}

}  // namespace

std::vector<std::string> ExrLayer::channelNames() const {
  std::vector<std::string> names;
  for (const std::string& name : channels)
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  if (chroma) names.insert(names.end(), {prefix + "RY", prefix + "BY"});
  return names;
}

bool ExrLayer::isOf(const std::string& wanted) const {
  for (const std::string& own : {name, alias})
    if (own == wanted || own.starts_with(wanted + ".")) return true;
  return false;
}

std::vector<ExrLayer> exrLayersOf(const Imf::MultiPartInputFile& file) {
  std::vector<ExrLayer> layers;
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    std::string partName;
    if (file.parts() > 1)
      partName = header.hasName() ? header.name() : "part " + std::to_string(part);
    std::vector<std::string> prefixes{""};
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
      const std::string name = i.name();
      const auto dot = name.rfind('.');
      if (dot == std::string::npos) continue;
      const std::string prefix = name.substr(0, dot + 1);
      if (std::find(prefixes.begin(), prefixes.end(), prefix) == prefixes.end())
        prefixes.push_back(prefix);
    }
    for (const std::string& prefix : prefixes) addLayers(header, part, partName, prefix, layers);
  }
  return layers;
}

}  // namespace glint::detail
