#include "glint/study/study_variants.h"

#include <algorithm>
#include <cstring>

#include "glint/image/error.h"
#include "glint/scene/parameters.h"

namespace glint {
namespace {

const Parameter& parameterOf(const std::string& name) {
  for (const Parameter& p : lookParameters())
    if (p.name == name) return p;
  throw Error("no parameter '" + name + "'");
}

bool has(const DrawList& list, bool Variant::*feature) {
  return std::any_of(list.items.begin(), list.items.end(),
                     [&](const DrawItem& item) { return item.variant.*feature; });
}

/// Whether two looks are drawn by the same programs with the same constants.
bool drawnAlike(const DrawList& a, const DrawList& b) {
  return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(),
                    [](const DrawItem& x, const DrawItem& y) {
                      return x.variant == y.variant &&
                             std::memcmp(&x.materialBlock, &y.materialBlock,
                                         sizeof x.materialBlock) == 0;
                    });
}

}  // namespace

std::vector<std::string> formsOf(const std::string& parameter, bool quick) {
  std::vector<std::string> forms;
  for (const std::string& form : parameterOf(parameter).choices()) {
    const std::size_t colon = form.find(':');
    const std::string number = colon == std::string::npos ? "" : form.substr(colon + 1);
    if (!quick || number.empty() || number == "4" || number == "16") forms.push_back(form);
  }
  return forms;
}

void setParameter(Look& look, const std::string& parameter, const std::string& text) {
  parameterOf(parameter).read(look, text);
}

Shading modelOf(Shading program) {
  return program == Shading::flat || program == Shading::gouraud ? Shading::phong : program;
}

void setForms(Look& look, const std::string& highlight, const std::string& fresnel) {
  setParameter(look, "highlight", highlight);
  setParameter(look, "fresnel", fresnel);
  for (auto& [name, edit] : look.material) {
    edit.highlight.reset();
    edit.fresnel.reset();
  }
  // Before those of the model's materials.
  look.material[""].highlight = look.highlight;
  look.material[""].fresnel = look.fresnel;
  for (const Parameter& p : lookParameters())
    if (p.name == "max-error") p.reset(look);  // it would choose forms
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
  for (const std::string& name : formsOf("shading", filter.quick)) {
    if (!wanted(filter.shading, name)) continue;
    StudyVariant v;
    v.look = look;
    setParameter(v.look, "shading", name);
    v.program = v.look.shading;
    if (v.program == Shading::automatic) continue;  // one of the others
    const bool environment = v.program == Shading::environment;
    const bool perPixel = v.program == modelOf(v.program);
    const DrawList list = makeDrawList(scene, bounds, exactLook(look, v.program));
    std::vector<std::string> highlights{"exact"}, fresnels{""};
    if (!environment && has(list, &Variant::specular))
      highlights = formsOf("highlight", filter.quick);
    std::vector<DrawList> drawn;
    if (environment) fresnels = {"exact"};
    if (environment && has(list, &Variant::dielectric)) fresnels = formsOf("fresnel", filter.quick);
    for (const std::string& highlight : highlights)
      for (const std::string& fresnel : fresnels) {
        if (!perPixel && highlight.find(':') != std::string::npos) continue;
        if (!environment && !wanted(filter.highlight, highlight)) continue;
        if (environment && !wanted(filter.fresnel, fresnel)) continue;
        v.highlight = highlight;
        v.fresnel = fresnel;
        setForms(v.look, highlight, environment ? fresnel : "exact");
        v.name = name + " " + (environment ? fresnel : highlight);
        DrawList own = makeDrawList(scene, bounds, v.look);
        if (std::any_of(drawn.begin(), drawn.end(),
                        [&](const DrawList& other) { return drawnAlike(own, other); }))
          continue;
        drawn.push_back(std::move(own));
        all.push_back(v);
      }
  }
  return all;
}

}  // namespace glint
