#include "output_names.h"

#include <filesystem>
#include <map>

#include "glint/image/error.h"

namespace glint {
namespace {

std::string padded(std::size_t number, std::size_t count) {
  std::string text = std::to_string(number);
  const std::size_t width = std::to_string(count > 0 ? count - 1 : 0).size();
  return std::string(width - text.size(), '0') + text;
}

std::string expand(const std::string& pattern, const std::string& model, const std::string& n) {
  std::string name;
  for (std::size_t i = 0; i < pattern.size();) {
    if (pattern[i] != '{') {
      name += pattern[i++];
      continue;
    }
    const std::size_t end = pattern.find('}', i);
    if (end == std::string::npos)
      throw InputError("-o " + pattern + ": '{' without '}': use {model} or {n}");
    const std::string key = pattern.substr(i + 1, end - i - 1);
    if (key == "model")
      name += std::filesystem::path(model).stem().string();
    else if (key == "n")
      name += n;
    else
      throw InputError("-o " + pattern + ": unknown {" + key + "}: use {model} or {n}");
    i = end + 1;
  }
  return name;
}

}  // namespace

std::vector<std::string> outputNames(const std::string& pattern,
                                     const std::vector<std::string>& models) {
  std::vector<std::string> names;
  std::map<std::string, std::string> taken;
  for (std::size_t i = 0; i < models.size(); ++i) {
    names.push_back(expand(pattern, models[i], padded(i, models.size())));
    const auto [other, isNew] = taken.emplace(names.back(), models[i]);
    if (!isNew)
      throw InputError("-o " + pattern + ": " + other->second + " and " + models[i] +
                       " would both become " + names.back() + ": put {model} or {n} into the name");
  }
  return names;
}

}  // namespace glint
