#include "glint/study/variants.h"

#include <algorithm>
#include <cstring>

#include "glint/budget/error_budget.h"
#include "glint/image/error.h"
#include "glint/scene/look_text.h"

namespace glint {
namespace {

/// Whether two looks are drawn by the same programs with the same constants.
bool drawnAlike(const DrawList& a, const DrawList& b) {
  const auto bytes = [](const std::vector<LightEntry>& lights) {
    return std::as_bytes(std::span(lights));
  };
  return std::ranges::equal(bytes(a.lights), bytes(b.lights)) &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(),
                    [](const DrawItem& x, const DrawItem& y) {
                      return x.variant == y.variant &&
                             std::memcmp(&x.materialBlock, &y.materialBlock,
                                         sizeof x.materialBlock) == 0;
                    });
}

/// What the look's budget chooses for one of its programs, named after the variant that draws the
/// same, if there is one.
StudyVariant chosenVariant(const Scene& scene, const Bounds& bounds, const Look& look,
                           Shading program, const std::vector<StudyVariant>& others) {
  Look asked = look;
  asked.shading = program;
  const ResolvedLook resolved = resolveLook(scene, bounds, asked);
  StudyVariant v;
  v.look = resolved.look;
  v.bound = resolved.bound;
  v.program = resolved.look.shading;
  v.highlight = highlightText(v.look.highlight);
  if (v.program == Shading::environment) v.fresnel = fresnelText(v.look.fresnel);
  const bool byMaterial = std::ranges::any_of(v.look.material, [](const auto& each) {
    return each.second.highlight || each.second.fresnel;
  });
  v.name = std::string(shadingName(v.program)) + (byMaterial ? " by material"
                                                  : v.fresnel.empty()
                                                      ? " " + v.highlight
                                                      : " " + v.fresnel + " " + v.highlight);
  const DrawList own = makeDrawList(scene, bounds, v.look);
  for (const StudyVariant& other : others)
    if (other.program == v.program && drawnAlike(own, makeDrawList(scene, bounds, other.look)))
      v.name = other.name;
  char budget[32];
  std::snprintf(budget, sizeof budget, "%g", *look.maxError);
  v.name = std::string("max-error ") + budget + ": " + v.name;
  return v;
}

}  // namespace

bool anyHas(const DrawList& list, bool Variant::*feature) {
  return std::ranges::any_of(list.items,
                             [&](const DrawItem& item) { return item.variant.*feature; });
}

std::vector<std::string> formsOf(std::span<const std::string_view> texts, bool quick) {
  std::vector<std::string> forms;
  for (const std::string_view form : texts) {
    const std::size_t colon = form.find(':');
    const std::string_view number = colon == form.npos ? "" : form.substr(colon + 1);
    if (!quick || number.empty() || number == "4" || number == "16" || number == "256")
      forms.emplace_back(form);
  }
  return forms;
}

std::vector<std::string> lobeForms(bool quick) {
  const std::vector<std::string> texts = highlightTexts();
  return formsOf(std::vector<std::string_view>(texts.begin(), texts.end()), quick);
}

std::vector<std::string> reflectanceForms(bool quick) { return formsOf(fresnelTexts(), quick); }

Shading modelOf(Shading program) { return isPerPixel(program) ? program : Shading::phong; }

void setForms(Look& look, const std::string& highlight, const std::string& fresnel) {
  look.highlight = parseHighlights(highlight, "highlight");
  look.fresnel = parseFresnel(fresnel, "fresnel");
  for (auto& [name, edit] : look.material) {
    edit.highlight.reset();
    edit.fresnel.reset();
  }
  // These override the forms of the model's materials.
  look.material[""].highlight = look.highlight;
  look.material[""].fresnel = look.fresnel;
  look.maxError.reset();  // it would choose forms
}

glm::ivec2 resolutionOf(const Look& look, int longerSide) {
  const double shrink = double(longerSide) / std::max(look.resolution.x, look.resolution.y);
  return glm::max(glm::ivec2(1), glm::ivec2(glm::round(shrink * glm::dvec2(look.resolution))));
}

Look exactLook(const Look& look, Shading program) {
  Look exact = look;
  exact.shading = program;
  setForms(exact, "exact", "exact");
  return exact;
}

std::vector<StudyVariant> studyVariants(const Scene& scene, const Bounds& bounds, const Look& look,
                                        const StudyFilter& filter) {
  std::vector<StudyVariant> all;
  const auto wanted = [](const std::string& only, std::string_view name) {
    return only.empty() || only == name;
  };
  for (const std::string_view text : shadingTexts()) {
    const std::string name(text);
    if (!wanted(filter.shading, name)) continue;
    StudyVariant v;
    v.look = look;
    v.look.shading = parseShading(name, "shading");
    v.program = v.look.shading;
    if (v.program == Shading::automatic) continue;  // one of the others
    const bool environment = v.program == Shading::environment;
    const bool perPixel = v.program == modelOf(v.program);
    // The form that is asked for, whatever its number, or all forms.
    const std::string& only = environment ? filter.fresnel : filter.highlight;
    const std::string& other = environment ? filter.highlight : filter.fresnel;
    if (!wanted(other, "exact")) continue;  // a form that this program does not have
    const DrawList list = makeDrawList(scene, bounds, exactLook(look, v.program));
    const bool choosable = anyHas(list, environment ? &Variant::dielectric : &Variant::specular);
    std::vector<std::string> forms{"exact"};
    if (choosable && only.empty())
      forms = environment ? reflectanceForms(filter.quick) : lobeForms(filter.quick);
    else if (choosable)
      forms = {only};
    else if (!wanted(only, "exact"))
      continue;
    if (!perPixel && only.empty())
      std::erase_if(forms, [](const std::string& form) { return form.find(':') != form.npos; });
    std::vector<DrawList> drawn;
    for (const std::string& form : forms) {
      v.highlight = environment ? "exact" : form;
      v.fresnel = environment ? form : "";
      setForms(v.look, v.highlight, environment ? form : "exact");
      v.name = name + " " + form;
      DrawList own = makeDrawList(scene, bounds, v.look);
      if (std::any_of(drawn.begin(), drawn.end(),
                      [&](const DrawList& each) { return drawnAlike(own, each); }))
        continue;
      drawn.push_back(std::move(own));
      all.push_back(v);
    }
  }
  if (!look.maxError) return all;
  std::vector<Shading> programs{Shading::phong, Shading::blinnPhong, Shading::environment};
  if (look.shading == Shading::automatic) programs[0] = look.shading;
  if (!filter.shading.empty()) programs = {look.shading};
  std::vector<StudyVariant> chosen;
  for (const Shading program : programs)
    chosen.push_back(chosenVariant(scene, bounds, look, program, all));
  all.insert(all.end(), std::make_move_iterator(chosen.begin()),
             std::make_move_iterator(chosen.end()));
  return all;
}

}  // namespace glint
