#include "edits.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>

#include "glint/image/error.h"
#include "glint/options/parameters.h"
#include "glint/scene/look_text.h"
#include "light_edit.h"
#include "materials.h"
#include "presets.h"

namespace glint::viewer {
namespace {

const Parameter& parameterNamed(std::string_view name) {
  return *std::ranges::find(lookParameters(), name, &Parameter::name);
}

std::string textOf(const Parameter& p, const Look& look) {
  const nlohmann::ordered_json value = p.save(look);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void sayChoice(Session& session, std::string_view parameter) {
  nextChoice(session.document.a, parameter);
  std::string name(parameter);
  std::ranges::replace(name, '-', ' ');
  session.say(name + " " + textOf(parameterNamed(parameter), session.document.a));
}

void sayForm(Session& session, std::string_view parameter) {
  if (session.document.a.maxError)
    session.say("the forms are chosen by max error: turn it off first (Shift+P)");
  else
    sayChoice(session, parameter);
}

void sayFlag(Session& session, const std::string& what, bool& flag) {
  flag = !flag;
  session.say(what + (flag ? ": on" : ": off"));
}

void selectMaterial(Session& session, int step) {
  const std::vector<int> drawn = drawnMaterials(session.model->scene);
  const int count = int(drawn.size()) + 1;  // plus the entry for all materials
  const auto found = std::ranges::find(drawn, session.material);
  const int place = found == drawn.end() ? 0 : int(found - drawn.begin()) + 1;
  const int next = (place + step + count) % count;
  session.material = next == 0 ? -1 : drawn[std::size_t(next - 1)];
  session.say("selected " + materialLabel(session.model->scene, session.material));
}

void takePreset(Session& session, int step) {
  const Scene& scene = session.model->scene;
  Look& look = session.document.a;
  const int count = int(presets().size());
  const int now = presetOf(effectiveParameters(scene, look, session.material));
  const int next = now < 0 ? (step > 0 ? 0 : count - 1) : (now + step + count) % count;
  const Preset& preset = presets()[std::size_t(next)];
  setParameters(look, materialKey(scene, session.material), presetParameters(preset));
  session.say(materialLabel(scene, session.material) + ": " + std::string(preset.name));
}

// Scales all lights. Those of the file are not copied; the look's light scale changes instead.
void scaleLights(Session& session, double factor) {
  Look& look = session.document.a;
  const Scene* scene = session.model ? &session.model->scene : nullptr;
  if (lightsAreTheFiles(scene, look)) {
    const double scale = look.lightScale.value_or(scene->lightScale) * factor;
    const double place = std::pow(10.0, std::floor(std::log10(scale)) - 3);  // four digits
    look.lightScale = std::clamp(std::round(scale / place) * place, 1e-30, 1e30);
    return session.say("light scale " + numberText(*look.lightScale));
  }
  std::vector<Light> lights = shownLights(scene, look);
  if (lights.empty()) return session.say("there are no lights");
  for (Light& light : lights) light.intensity = glm::min(light.intensity * factor, 1e6);
  look.light = std::move(lights);
  session.say(factor > 1 ? "brighter lights" : "darker lights");
}

void editLights(Session& session, Action command, const glm::dmat3& axes) {
  Look& look = session.document.a;
  const Scene* scene = session.model ? &session.model->scene : nullptr;
  const Bounds bounds = session.model ? session.model->bounds : Bounds{};
  std::vector<Light> lights = shownLights(scene, look);
  const std::size_t count = lights.size();
  session.light = std::min(session.light, count > 0 ? count - 1 : 0);
  if (command == Action::switchLight || command == Action::soloLight) {
    if (count == 0) return session.say("there are no lights");
    const bool solo = command == Action::soloLight;
    (solo ? soloLight : switchLight)(lights, session.light, session.lightsOff);
    const bool on = lights[session.light].intensity != glm::dvec3(0.0);
    const std::string became = setLights(look, scene, bounds, std::move(lights));
    return session.say("light " + std::to_string(session.light + 1) +
                       (solo ? ": solo, or all again"
                        : on ? ": on"
                             : ": off") +
                       (became.empty() ? "" : "; " + became));
  }
  if (command != Action::nextLight) session.lightsOff.clear();  // their indices change
  if (command == Action::addLight) {
    if (count >= maxLights) return session.say("no light added: the maximum is reached");
    Light sun;
    sun.direction = {1, 1, 1};
    lights.push_back(count == 0 ? sun : anotherLight(lights[session.light], bounds, axes));
    session.light = count;
  } else {
    if (count == 0) return session.say("there are no lights");
    if (command == Action::nextLight) {
      session.light = (session.light + 1) % count;
      return session.say("selected light " + std::to_string(session.light + 1) + " of " +
                         std::to_string(count));
    }
    lights.erase(lights.begin() + std::ptrdiff_t(session.light));
  }
  const std::string became = setLights(look, scene, bounds, std::move(lights));
  session.say(!became.empty()               ? became
              : command == Action::addLight ? "added a light"
                                            : "removed a light");
}

void moveTime(Session& session, double step) {
  Look& look = session.document.a;
  const double duration = animationDuration(session.model->scene, look);
  const double now = look.animationTime.value_or(0);
  // Rounded to hundredths, so that steps back and forth return to the same time.
  look.animationTime = std::clamp(std::round((now + step) * 100) / 100, 0.0, duration);
  session.say("animation at " + numberText(*look.animationTime) + " of " + numberText(duration) +
              " s");
}

void nextAnimation(Session& session) {
  Look& look = session.document.a;
  const auto& all = session.model->scene.animations;
  std::size_t now = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (look.animation == all[i].name || look.animation == std::to_string(i)) now = i;
  const std::size_t next = (now + 1) % all.size();
  look.animation = std::to_string(next);
  if (!look.animationTime) look.animationTime = 0;
  session.say("animation " + look.animation + " " + all[next].name);
}

void fitToMeasured(Session& session) {
  if (!session.model || !session.measured) {
    session.say("open a measured material (MERL .binary) first: Ctrl+O");
    return;
  }
  Look& look = session.document.a;
  const Scene& scene = session.model->scene;
  const ShadingParameters s = effectiveParameters(scene, look, session.material);
  const FitForm form{usesBlinn(look.shading), look.blinnFactor};
  const ShadingParameters nearest = fitted(*session.measured, form, s);
  setParameters(look, materialKey(scene, session.material), nearest);
  const FitError error = errorOf(*session.measured, nearest, form);
  char text[120];
  std::snprintf(text, sizeof text, "exponent %.4g, RMSE %.3g: %.3g %% of the measured RMS",
                nearest.exponent, error.rmse, 100 * error.relative);
  session.say(materialLabel(scene, session.material) + ": " + text);
}

void resetSelected(Session& session) {
  const Scene& scene = session.model->scene;
  resetMaterial(session.document.a, materialKey(scene, session.material));
  session.say(materialLabel(scene, session.material) + " as in the file");
}

void switchMaxError(Session& session) {
  Look& look = session.document.a;
  look.maxError = look.maxError ? std::nullopt : std::optional(0.01);
  look.maxErrorInCodes = false;
  session.say(look.maxError ? "the cheapest forms within 0.01" : "max error: off");
}

void nextEnvironment(Session& session) {
  session.document.a.hdriFile.clear();
  sayChoice(session, "environment");
}

void defaultLights(Session& session) {
  session.document.a.light.reset();
  session.lightsOff.clear();
  session.document.a.noLights = false;
  session.say("the lights are the file's, or the default one");
}

void moveExposure(Session& session, double step) {
  Look& look = session.document.a;
  const Parameter& p = parameterNamed("exposure");
  look.exposure = std::clamp(look.exposure + step, p.min, p.max);
  session.say("exposure " + numberText(look.exposure) + " EV");
}

void nextAntiAliasing(Session& session) {
  using Mode = AntiAliasing::Mode;
  AntiAliasing& now = session.document.a.antiAliasing;
  now = now.mode == Mode::none   ? AntiAliasing{Mode::msaa, 4}
        : now.mode == Mode::msaa ? AntiAliasing{Mode::ssaa, 2}
                                 : AntiAliasing{Mode::none, 1};
  session.say("anti-aliasing " + antiAliasingText(now));
}

struct Edit {
  Action command;
  void (*make)(Session&);
};

constexpr Edit lookEdits[] = {
    {Action::nextProgram, [](Session& s) { sayChoice(s, "shading"); }},
    {Action::nextHighlight, [](Session& s) { sayForm(s, "highlight"); }},
    {Action::nextFresnel, [](Session& s) { sayForm(s, "fresnel"); }},
    {Action::maxError, switchMaxError},
    {Action::viewer, [](Session& s) { sayChoice(s, "viewer"); }},
    {Action::twoSided, [](Session& s) { sayFlag(s, "two-sided", s.document.a.twoSided); }},
    {Action::nextEnvironment, nextEnvironment},
    {Action::environmentBackground,
     [](Session& s) {
       sayFlag(s, "environment as background", s.document.a.environmentBackground);
     }},
    {Action::noLights, [](Session& s) { sayFlag(s, "no lights", s.document.a.noLights); }},
    {Action::brighter, [](Session& s) { scaleLights(s, 1.05); }},
    {Action::darker, [](Session& s) { scaleLights(s, 1 / 1.05); }},
    {Action::defaultLights, defaultLights},
    {Action::exposureUp, [](Session& s) { moveExposure(s, 0.25); }},
    {Action::exposureDown, [](Session& s) { moveExposure(s, -0.25); }},
    {Action::noBackground,
     [](Session& s) { sayFlag(s, "transparent background", s.document.a.noBackground); }},
    {Action::antiAliasing, nextAntiAliasing},
};

// Of a model.
constexpr Edit materialEdits[] = {
    {Action::nextMaterial, [](Session& s) { selectMaterial(s, 1); }},
    {Action::previousMaterial, [](Session& s) { selectMaterial(s, -1); }},
    {Action::nextPreset, [](Session& s) { takePreset(s, 1); }},
    {Action::previousPreset, [](Session& s) { takePreset(s, -1); }},
    {Action::resetMaterial, resetSelected},
    {Action::fitMeasured, fitToMeasured},
};

// Of a model with an animation.
constexpr Edit animationEdits[] = {
    {Action::earlier, [](Session& s) { moveTime(s, -0.1); }},
    {Action::later, [](Session& s) { moveTime(s, 0.1); }},
    {Action::nextAnimation, nextAnimation},
    {Action::play, [](Session& s) { sayFlag(s, "playing", s.playing); }},
};

constexpr Action lightEdits[] = {Action::nextLight, Action::addLight, Action::removeLight,
                                 Action::switchLight, Action::soloLight};

const Edit* find(std::span<const Edit> edits, Action command) {
  const auto found = std::ranges::find(edits, command, &Edit::command);
  return found == edits.end() ? nullptr : &*found;
}

}  // namespace

bool edit(Session& session, Action command, const glm::dmat3& axes) {
  if (std::ranges::find(lightEdits, command) != std::end(lightEdits)) {
    editLights(session, command, axes);
    return true;
  }
  const Edit* edit = find(lookEdits, command);
  if (!edit && session.model) edit = find(materialEdits, command);
  if (!edit && session.model) edit = find(animationEdits, command);
  if (!edit) return false;
  if (find(animationEdits, command) && session.model->scene.animations.empty())
    session.say("the file has no animation");
  else
    edit->make(session);
  return true;
}

void nextChoice(Look& look, std::string_view parameter) {
  const Parameter& p = parameterNamed(parameter);
  std::vector<std::string> texts = p.choices();
  const std::string now = textOf(p, look);
  std::erase_if(texts, [&](const std::string& text) {
    const std::size_t colon = text.find(':');
    return text != now && colon != std::string::npos && text.substr(colon) != ":8";
  });
  const auto found = std::ranges::find(texts, now);
  const bool last = found == texts.end() || found + 1 == texts.end();
  p.read(look, last ? texts.front() : *(found + 1));
}

int presetOf(const ShadingParameters& values) {
  const auto same = [&](const Preset& preset) {
    const ShadingParameters its = presetParameters(preset);
    return its.color == values.color &&
           std::ranges::all_of(materialParameters(), [&](const MaterialParameter& p) {
             return its.*p.value == values.*p.value;
           });
  };
  const auto found = std::ranges::find_if(presets(), same);
  return found == presets().end() ? -1 : int(found - presets().begin());
}

double animationDuration(const Scene& scene, const Look& look) {
  const auto& all = scene.animations;
  if (all.empty()) return 0;
  if (!look.animation.empty())
    for (std::size_t i = 0; i < all.size(); ++i)
      if (look.animation == all[i].name || look.animation == std::to_string(i))
        return all[i].duration;
  return all.front().duration;
}

}  // namespace glint::viewer
