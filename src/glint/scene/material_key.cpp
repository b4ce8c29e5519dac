#include "glint/scene/material_key.h"

#include <algorithm>
#include <map>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/scene/material_parameters.h"

namespace glint {
namespace {

/// A parsed key.
struct Parts {
  std::string name, number;  ///< the digits after the last '#'
  bool isQuoted = false;
  bool hasNumber() const { return !number.empty(); }
};

bool isDigits(const std::string& text) {
  return !text.empty() && text.size() <= 9 &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// The position after the closing quotation mark in a text that begins with '"'.
std::size_t endOfQuotation(const std::string& text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      return i + 1;
  }
  throw InputError("material '" + printablePath(text) +
                   "': the quotation mark before the name is not closed: add one after it");
}

std::string withoutLeadingZeros(const std::string& digits) {
  const auto first = digits.find_first_not_of('0');
  return first == std::string::npos ? "0" : digits.substr(first);
}

Parts partsOf(const std::string& text) {
  Parts parts;
  if (text.starts_with('"')) {
    const std::size_t end = endOfQuotation(text);
    for (std::size_t i = 1; i + 1 < end; ++i) {
      if (text[i] == '\\') ++i;
      parts.name += text[i];
    }
    const std::string rest = text.substr(end);
    if (!rest.empty() && (rest[0] != '#' || !isDigits(rest.substr(1))))
      throw InputError("material '" + printablePath(text) +
                       "': a name in quotation marks can only be followed by #N");
    if (parts.name.empty())
      throw InputError("material '" + printablePath(text) +
                       "': no name between the quotation marks");
    parts.isQuoted = true;
    if (!rest.empty()) parts.number = withoutLeadingZeros(rest.substr(1));
    return parts;
  }
  parts.name = text;
  const auto mark = text.rfind('#');
  if (mark == std::string::npos || !isDigits(text.substr(mark + 1))) return parts;
  parts.name = text.substr(0, mark);
  parts.number = withoutLeadingZeros(text.substr(mark + 1));
  return parts;
}

std::string nameText(const std::string& name) {
  const auto mark = name.rfind('#');
  const bool endsInNumber = mark != std::string::npos && isDigits(name.substr(mark + 1));
  if (!endsInNumber && !name.starts_with('"') && name.find('=') == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

/// Whether it is called "#N" because the file gives no name.
bool isNameless(const Material& m) {
  return m.index >= 0 && m.name == "#" + std::to_string(m.index);
}

}  // namespace

std::string materialKey(const std::string& text) {
  if (text.empty()) return text;
  const Parts parts = partsOf(text);
  const std::string name = parts.name.empty() ? "" : nameText(parts.name);
  return parts.hasNumber() ? name + "#" + parts.number : name;
}

std::size_t endOfMaterialKey(const std::string& text) {
  if (!text.starts_with('"')) return text.rfind(':', text.find('='));
  const std::size_t end = endOfQuotation(text);
  const std::size_t colon = text.find(':', end), equals = text.find('=', end);
  return colon < equals ? colon : std::string::npos;
}

std::string materialKey(const Material& m) {
  if (isNameless(m)) return m.name;
  return nameText(m.name) + (m.nameShared ? "#" + std::to_string(m.nth) : "");
}

std::array<std::string, 4> materialKeys(const Material& m) {
  if (m.name.empty()) return {};
  const std::string name = isNameless(m) ? m.name : nameText(m.name);
  const std::string index = m.index >= 0 ? "#" + std::to_string(m.index) : name;
  return {"", name, isNameless(m) ? m.name : name + "#" + std::to_string(m.nth), index};
}

bool isEdited(const Material& m, const Look& look) {
  return std::ranges::any_of(materialKeys(m),
                             [&](const std::string& key) { return look.material.contains(key); });
}

void countMaterials(std::vector<Material>& materials) {
  std::map<std::string, int> counts;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    materials[i].index = int(i);
    materials[i].nth = counts[materials[i].name]++;
  }
  for (Material& m : materials) m.nameShared = counts[m.name] > 1;
}

void gatherMaterialEdits(Look& look, const Scene& scene) {
  for (const Material& m : scene.materials) {
    const std::string own = materialKey(m);
    const auto keys = materialKeys(m);
    for (std::size_t i = 2; i < keys.size(); ++i) {
      const auto found = keys[i] == own ? look.material.end() : look.material.find(keys[i]);
      if (found == look.material.end()) continue;
      const MaterialEdit edit = found->second;
      look.material.erase(found);
      mergeEdit(look.material[own], edit);
    }
  }
}

void mergeEdit(MaterialEdit& to, const MaterialEdit& from) {
  forEachEdit([&](auto edit) {
    if (from.*edit) to.*edit = from.*edit;
  });
}

}  // namespace glint
