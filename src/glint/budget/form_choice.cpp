#include "glint/budget/form_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "glint/shading/bounds.h"
#include "glint/shading/lobe.h"
#include "glint/shading/safe.h"

namespace glint {
namespace {

constexpr std::size_t mostForms = 3;  // of one material: a fourth saves less than its loop costs

// A form of the lobe for one light of intensity 1 on a surface with m_s S = 1.
struct Lobe {
  HighlightForm form;
  double error = 0, rounding = 0, cost = 0;
  double both() const { return error + rounding; }
};

Lobe lobeOf(const HighlightForm& form, const FormNeeds& needs, const CostTable& costs, bool blinn) {
  const Highlight f = form.form;
  Lobe lobe{form};
  for (const double exponent : needs.exponents) {
    lobe.error = std::max(lobe.error, lobeFormulaBound(f, form.gamma, exponent));
    lobe.rounding = std::max(lobe.rounding, lobeRoundingBound(f, form.gamma, exponent, blinn));
    const int power = row(f).wholePowers ? int(exponent) : form.gamma;
    lobe.cost = std::max(lobe.cost, costs.lobe(f, power));
  }
  return lobe;
}

// The forms that may pay, from the most exact to the cheapest: each costs less than all that are
// more exact.
std::vector<Lobe> lobeCandidates(const FormNeeds& needs, const CostTable& costs, bool blinn) {
  const bool aboveZero = std::ranges::all_of(needs.exponents, [](double e) { return e > 0; });
  const bool whole = std::ranges::all_of(needs.exponents, isIntegerPower);
  std::vector<HighlightForm> forms;
  for (const HighlightRow& each : highlightRows()) {
    if ((!each.atZero && !aboveZero) || (each.wholePowers && !whole) ||
        (each.hasTable && needs.varyingExponent))
      continue;
    for (int gamma = each.leastGamma; gamma <= each.mostGamma; gamma = std::max(2 * gamma, 1))
      forms.emplace_back(each.form, gamma);
  }
  std::vector<Lobe> all;
  for (const HighlightForm& form : forms) all.push_back(lobeOf(form, needs, costs, blinn));
  std::ranges::stable_sort(all, {}, &Lobe::both);
  std::vector<Lobe> kept;
  for (const Lobe& each : all)
    if (kept.empty() || each.cost < kept.back().cost) kept.push_back(each);
  return kept;
}

// The lobe forms of all lights, and their total errors and cost.
struct Lobes {
  struct Run {
    const Lobe* form = nullptr;
    std::size_t from = 0;
  };
  std::array<Run, mostForms> runs;
  std::size_t count = 0;
  double error = 0, rounding = 0, cost = 0;
  double both() const { return error + rounding; }
  HighlightForms forms() const {
    HighlightForms all;
    if (count > 0) all.brightest = runs[0].form->form;
    for (std::size_t i = 1; i < count; ++i) all.add(runs[i].form->form, int(runs[i].from));
    return all;
  }
};

// Finds the cheapest forms for the lights, less exact ones for dimmer lights.
class LobeSearch {
 public:
  /// `change` is the cost of a change of form.
  LobeSearch(const std::vector<Lobe>& candidates, double change, const FormNeeds& needs,
             const LightReach& lights)
      : candidates_(candidates),
        change_(change),
        count_(lights.most.size()),
        weights_(count_ * (count_ + 1)) {
    for (std::size_t from = 0; from < count_; ++from)
      for (std::size_t end = from + 1; end <= count_; ++end)
        weight(from, end) = largest(needs.shine * lights.of(from, end));
  }

  /// One form for all lights.
  Lobes all(const Lobe& form) { return extended({}, form, 0, count_); }

  /// Replaces `best` by forms within `budget` that cost less, or as much with a smaller error, if
  /// there are any.
  void improve(Lobes& best, double budget) {
    best_ = &best;
    budget_ = budget;
    extend({}, 0, 0);
  }

 private:
  double& weight(std::size_t from, std::size_t end) { return weights_[from * (count_ + 1) + end]; }

  Lobes extended(Lobes lobes, const Lobe& form, std::size_t from, std::size_t end) {
    const double reach = weight(from, end);
    lobes.error += reach * form.error;
    lobes.rounding += reach * form.rounding;
    lobes.cost += double(end - from) * form.cost + (lobes.count > 0 ? change_ : 0);
    lobes.runs[lobes.count++] = {&form, from};
    return lobes;
  }

  void extend(const Lobes& begun, std::size_t from, std::size_t first) {
    const std::size_t shortest = begun.count + 1 < mostForms ? from + 1 : count_;
    for (std::size_t i = first; i < candidates_.size(); ++i)
      for (std::size_t end = shortest; end <= count_; ++end) {
        const Lobes lobes = extended(begun, candidates_[i], from, end);
        if (!(lobes.both() <= budget_)) break;
        if (lobes.cost > best_->cost) continue;
        if (end < count_)
          extend(lobes, end, i + 1);
        else if (lobes.cost < best_->cost || lobes.both() < best_->both())
          *best_ = lobes;
      }
  }

  const std::vector<Lobe>& candidates_;
  double change_;
  std::size_t count_;
  std::vector<double> weights_;
  Lobes* best_ = nullptr;
  double budget_ = 0;
};

struct Reflectance {
  Fresnel form;
  double error = 0, rounding = 0, cost = 0;
};

Reflectance reflectanceOf(Fresnel fresnel, const FormNeeds& needs, const Look& look,
                          const CostTable& costs) {
  Reflectance r{fresnel};
  if (!needs.dielectric) return r;
  r.cost = costs.reflectance(fresnel, look.schlickExponent, needs.denserSide);
  for (const FormNeeds::Mirror& m : needs.mirrors) {
    const double n1 = look.mediumIor, n2 = m.ior;
    const double error = fresnelFormulaBound(fresnel, n1, n2, look.schlickExponent);
    double rounding = fresnelRoundingBound(fresnel, n1, n2, look.schlickExponent);
    if (m.back)
      rounding = std::max(rounding, fresnelRoundingBound(fresnel, n2, n1, look.schlickExponent));
    r.error = std::max(r.error, m.radiance * error);
    r.rounding = std::max(r.rounding, m.radiance * rounding);
  }
  return r;
}

}  // namespace

glm::dvec3 LightReach::of(std::size_t from, std::size_t end) const {
  glm::dvec3 sum(0.0);
  for (std::size_t i = from; i < end; ++i) sum += most[i];
  return glm::min(sum, together);
}

ChosenForms cheapestForms(const FormNeeds& needs, const LightReach& lights, const Look& look,
                          const CostTable& costs, bool blinn, double budget) {
  std::vector<Reflectance> reflectances{reflectanceOf(Fresnel::exact, needs, look, costs)};
  if (needs.dielectric)
    for (const FresnelRow& each : fresnelRows().subspan(1))
      reflectances.push_back(reflectanceOf(each.form, needs, look, costs));
  std::vector<Lobe> candidates;
  if (needs.specular) candidates = lobeCandidates(needs, costs, blinn);
  const Lobe exactLobe = lobeOf(Highlight::exact, needs, costs, blinn);
  LobeSearch search(candidates, costs.change, needs, lights);
  Lobes exact;
  if (needs.specular) exact = search.all(exactLobe);

  ChosenForms best;
  const auto take = [&](const Lobes& lobes, const Reflectance& r) {
    best.highlight = lobes.forms();
    best.fresnel = r.form;
    best.lobe = lobes.error;
    best.reflectance = r.error;
    best.rounding = lobes.rounding + r.rounding;
    best.cost = lobes.cost + r.cost;
  };
  take(exact, reflectances.front());
  best.exactCost = best.cost;
  best.within = needs.rest + best.error() <= budget;
  for (const Reflectance& r : reflectances) {
    const double left = budget - needs.rest - r.error - r.rounding;
    Lobes lobes = exact;
    if (!(exact.both() <= left)) lobes.cost = std::numeric_limits<double>::infinity();
    if (needs.specular) search.improve(lobes, left);
    const double cost = lobes.cost + r.cost, error = lobes.both() + r.error + r.rounding;
    if (!std::isfinite(cost)) continue;
    if (best.within && (cost > best.cost || (cost == best.cost && error >= best.error()))) continue;
    take(lobes, r);
    best.within = true;
  }
  return best;
}

}  // namespace glint
