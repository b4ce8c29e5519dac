#include "glint/study/advice.h"

#include <algorithm>

#include "glint/scene/look_text.h"
#include "glint/study/format.h"
#include "glint/study/report_words.h"
#include "glint/study/statistics.h"

namespace glint {
namespace {

Shading advisedModel(const StudyHead& head) { return modelOf(programOf(head.look)); }

const std::vector<double>& roundsOf(const StudyResult& r, std::size_t variant) {
  return r.variants[variant].times.by(r.clock);
}

/// The variant that draws a model exactly; none if it was not timed.
std::optional<std::size_t> exactOf(const StudyResult& r, Shading model) {
  const std::string name = std::string(shadingName(model)) + " exact";
  for (std::size_t i = 0; i < r.variants.size(); ++i)
    if (r.variants[i].variant.name == name && !roundsOf(r, i).empty()) return i;
  return {};
}

std::string percent(const TimeRatio& share) {
  return formatted("%.0f %% (%.0f to %.0f)", 100 * share.value, 100 * share.low, 100 * share.high);
}

std::string formsText(const StudyHead& head, const StudyResult& r) {
  const Shading model = advisedModel(head);
  const std::optional<std::size_t> exact = exactOf(r, model);
  if (!exact) return {};
  if (!r.noFront.empty())
    return " Which form is enough cannot be determined, because times are too uncertain.";
  std::string text, before;
  for (const AdvisedForm& form : advisedForms(head, r)) {
    const VariantResult& v = r.variants[form.variant];
    const std::string within = formatted("%d code%s", form.codes, form.codes > 1 ? "s" : "");
    if (v.variant.name == before) {
      text += ", as well as for " + within;
      continue;
    }
    text += text.empty() ? " To stay within " : "; within ";
    text += within + " of the exact picture ";
    if (form.variant == *exact)
      text += formatted("use `%s` (%.2f ms): nothing else is measurably faster",
                        v.variant.name.c_str(), quantile(roundsOf(r, *exact), 0.5));
    else
      text += formatted(
          "use `%s`, which takes %s of the time of exact's %.2f ms and is off by %.1e "
          "at most",
          v.variant.name.c_str(), ratioText(form.time).c_str(), quantile(roundsOf(r, *exact), 0.5),
          errorAgainst(v, model)->whole.max);
    before = v.variant.name;
  }
  return text + ".";
}

std::string partsText(const StudyResult& r) {
  if (r.parts.empty()) return {};
  std::vector<FramePart> parts = r.parts;
  std::ranges::stable_sort(parts, std::greater(), [](const FramePart& p) { return p.share.value; });
  std::string text = " In a frame of the exact form,";
  for (std::size_t i = 0; i < parts.size(); ++i)
    text +=
        (i == 0                 ? " "
         : i + 1 < parts.size() ? ", "
                                : " and ") +
        parts[i].name + " take" +
        (parts[i].name == "vertices" || parts[i].name == "textures" || parts[i].name == "highlights"
             ? " "
             : "s ") +
        percent(parts[i].share);
  text += ".";
  for (const FramePart& part : parts)
    if (part.name == "highlights")
      text += formatted(" Another form of the highlight can save less than %.0f %%",
                        100 * part.share.high) +
              " of it; most is taken by " + parts[0].name + ".";
  return text;
}

}  // namespace

std::vector<AdvisedForm> advisedForms(const StudyHead& head, const StudyResult& r) {
  const Shading model = advisedModel(head);
  const std::optional<std::size_t> exact = exactOf(r, model);
  std::vector<AdvisedForm> forms;
  if (!exact || !r.noFront.empty()) return forms;
  const auto faster = [&](std::size_t a, std::size_t b) {
    return isFaster(roundsOf(r, a), roundsOf(r, b), r.spread());
  };
  for (const int codes : {1, 2, 4}) {
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < r.variants.size(); ++i) {
      const VariantError* error = errorAgainst(r.variants[i], model);
      if (error && error->whole.levels <= codes && !r.variants[i].variant.bound &&
          !roundsOf(r, i).empty())
        within.push_back(i);
    }
    std::size_t chosen = *exact;
    if (!within.empty()) {
      const std::size_t fastest = *std::ranges::min_element(
          within, {}, [&](std::size_t i) { return quantile(roundsOf(r, i), 0.25); });
      std::ranges::sort(within, {}, [&](std::size_t i) {
        return errorAgainst(r.variants[i], model)->whole.rmse;
      });
      if (faster(fastest, *exact))
        chosen = *std::ranges::find_if(within, [&](std::size_t i) { return !faster(fastest, i); });
    }
    forms.push_back({codes, chosen, timeRatio(roundsOf(r, chosen), roundsOf(r, *exact))});
  }
  return forms;
}

std::string adviceText(const StudyHead& head, const StudyResult& r) {
  const std::string forms = formsText(head, r), parts = partsText(r);
  if (forms.empty() && parts.empty()) return {};
  return formatted("What to use for %s at %d x %d pixels by %s, on this machine and by %s:",
                   head.model.c_str(), head.look.resolution.x, head.look.resolution.y,
                   std::string(shadingName(advisedModel(head))).c_str(), clockWords(r.clock)) +
         forms + parts + " In brackets: 95 % intervals.";
}

}  // namespace glint
