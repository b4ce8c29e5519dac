#include "glint/stability/suite.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/image/json_text.h"

namespace glint::stability {
namespace {

using Json = nlohmann::ordered_json;

bool equalIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

std::string letterOf(const Group& group) { return std::string(1, group.letter); }

std::string failureText(const Finding& f) {
  std::string text = "    " + f.what + ": expected " + f.expected + ", got " + f.got;
  if (f.error > 0) {
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, ", off by %.3g (%.3g ulp, %.3g levels)", f.error, f.ulp,
                  f.levels);
    text += numbers;
    if (f.tolerance > 0) text += ", allowed " + numberText(f.tolerance);
  }
  return text + "\n";
}

constexpr std::size_t mostFailures = 8;  // of a case, in the summary

}  // namespace

std::span<const Group> groups() {
  static const Group all[] = {
      {'A', "attributes and geometry", attributeCases()},
      {'B', "transforms and scale", transformCases()},
      {'C', "directions", directionCases()},
      {'D', "exponents and powers", exponentCases()},
      {'K', "Fresnel and refraction", fresnelCases()},
      {'F', "lights and colours", lightCases()},
      {'G', "camera, clipping, depth", cameraCases()},
      {'H', "output", outputCases()},
      {'I', "interpolation and precision", interpolationCases()},
      {'P', "properties and worst inputs", propertyCases(), false},
      {'L', "limits of the driver", limitCases(), false},
      {'M', "mapping", mappingCases(), false},
  };
  return all;
}

bool CaseResult::passed() const {
  return error.empty() && !findings.empty() &&
         std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.passed; });
}

bool Selection::has(const Group& group, const Case& item) const {
  if (isAll()) return true;
  const auto named = [&](const std::string& id) { return equalIgnoringCase(id, item.id); };
  const auto grouped = [&](const std::string& g) { return equalIgnoringCase(g, letterOf(group)); };
  return std::any_of(ids.begin(), ids.end(), named) ||
         std::any_of(groups.begin(), groups.end(), grouped);
}

void Selection::check() const {
  std::string letters;
  for (const Group& group : stability::groups())
    if (!group.cases.empty()) letters += (letters.empty() ? "" : ", ") + letterOf(group);
  for (const std::string& id : ids) {
    const auto known = [&](const Group& group) {
      return std::any_of(group.cases.begin(), group.cases.end(),
                         [&](const Case& c) { return equalIgnoringCase(c.id, id); });
    };
    if (std::none_of(stability::groups().begin(), stability::groups().end(), known))
      throw InputError("--case " + id + ": no such case: see glint stability --list");
  }
  for (const std::string& name : groups) {
    const auto known = [&](const Group& group) {
      return !group.cases.empty() && equalIgnoringCase(letterOf(group), name);
    };
    if (std::none_of(stability::groups().begin(), stability::groups().end(), known))
      throw InputError("--group " + name + ": no such group: use one of " + letters);
  }
}

std::vector<CaseResult> runCases(Bench& bench, const Selection& selection,
                                 const std::function<void(double share, const Case&)>& before) {
  selection.check();
  std::vector<CaseResult> results;
  std::size_t count = 0;
  for (const Group& group : groups())
    for (const Case& item : group.cases) count += selection.has(group, item);
  for (const Group& group : groups())
    for (const Case& item : group.cases) {
      if (!selection.has(group, item)) continue;
      if (before) before(double(results.size()) / double(count), item);
      CaseResult result{&group, &item, {}, {}, 0};
      const auto start = Clock::now();
      Record record;
      try {
        item.run(bench, record);
      } catch (const Error& error) {
        result.error = error.what();
      }
      result.findings = record.findings();
      result.milliseconds = since(start);
      results.push_back(std::move(result));
    }
  return results;
}

std::string listText(const Selection& selection) {
  selection.check();
  std::string text;
  for (const Group& group : groups()) {
    bool first = true;
    for (const Case& item : group.cases) {
      if (!selection.has(group, item)) continue;
      if (first)
        text +=
            (text.empty() ? "" : "\n") + letterOf(group) + "  " + std::string(group.name) + "\n";
      first = false;
      std::string id(item.id);
      id.resize(5, ' ');
      text += "  " + id + std::string(item.input) +
              "\n       expected: " + std::string(item.expected) +
              "\n       tolerance: " + std::string(item.tolerance) +
              "\n       reason: " + std::string(item.reason) + "\n";
      if (!item.policy.empty()) text += "       policy: " + std::string(item.policy) + "\n";
    }
  }
  return text;
}

bool allPassed(const std::vector<CaseResult>& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const CaseResult& r) { return r.passed(); });
}

std::string summaryText(const std::vector<CaseResult>& results) {
  std::string text, failures;
  std::size_t passed[2] = {0, 0}, count[2] = {0, 0}, checks = 0;
  double seconds = 0;
  for (const Group& group : groups()) {
    std::size_t own = 0, good = 0;
    for (const CaseResult& r : results) {
      if (r.group != &group) continue;
      ++own;
      good += r.passed();
      checks += r.findings.size();
      seconds += r.milliseconds / 1000;
      if (r.passed()) continue;
      failures += "FAIL " + std::string(r.item->id) + "  " + std::string(r.item->input) + "\n";
      if (!r.error.empty()) failures += "    " + r.error + "\n";
      std::size_t shown = 0, bad = 0;
      for (const Finding& f : r.findings) {
        if (f.passed) continue;
        if (++bad <= mostFailures) failures += failureText(f), ++shown;
      }
      if (bad > shown) failures += "    and " + std::to_string(bad - shown) + " more\n";
    }
    if (own == 0) continue;
    std::string name(group.name);
    name.resize(30, ' ');
    text += "  " + letterOf(group) + "  " + name + std::to_string(good) + " of " +
            std::to_string(own) + " pass\n";
    passed[!group.catalogue] += good;
    count[!group.catalogue] += own;
  }
  char last[160];
  std::snprintf(last, sizeof last, "%zu checks in %.1f s\n", checks, seconds);
  text += failures;
  if (count[0] > 0)
    text += "catalogue: " + std::to_string(passed[0]) + " of " + std::to_string(count[0]) +
            " cases pass; ";
  if (count[1] > 0)
    text += "beyond it: " + std::to_string(passed[1]) + " of " + std::to_string(count[1]) + "; ";
  return text + last;
}

Json casesJson(const std::vector<CaseResult>& results) {
  Json list = Json::array();
  for (const CaseResult& r : results) {
    Json one{{"id", r.item->id},
             {"group", letterOf(*r.group)},
             {"input", r.item->input},
             {"expected", r.item->expected},
             {"tolerance", r.item->tolerance},
             {"reason", r.item->reason}};
    if (!r.item->policy.empty()) one["policy"] = r.item->policy;
    one["passed"] = r.passed();
    if (!r.error.empty()) one["error"] = r.error;
    one["ms"] = r.milliseconds;
    one["checks"] = Json::array();
    for (const Finding& f : r.findings) {
      Json check{{"what", f.what}, {"expected", f.expected}, {"got", f.got}, {"passed", f.passed}};
      if (f.error > 0) {
        check["error"] = jsonNumber(f.error);
        check["ulp"] = jsonNumber(f.ulp);
        check["levels"] = jsonNumber(f.levels);
      }
      if (f.tolerance > 0) check["tolerance"] = jsonNumber(f.tolerance);
      one["checks"].push_back(check);
    }
    list.push_back(one);
  }
  return list;
}

}  // namespace glint::stability
