#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/stability/bench.h"
#include "glint/stability/case.h"

namespace glint::stability {

/// The result of a case.
struct CaseResult {
  const Group* group = nullptr;
  const Case* item = nullptr;
  std::vector<Finding> findings;
  std::string error;  ///< why it did not run to its end; empty if it did
  double milliseconds = 0;

  bool passed() const;
};

/// Which cases to run: by id and by group, case-insensitive; all if both are empty.
struct Selection {
  std::vector<std::string> ids, groups;

  /// Throws InputError for an id or a group that does not exist.
  void check() const;
  bool has(const Group&, const Case&) const;
  bool isAll() const { return ids.empty() && groups.empty(); }
};

/// Runs the cases in their order; `before` is called before each, with the share that is done.
std::vector<CaseResult> runCases(Bench&, const Selection&,
                                 const std::function<void(double share, const Case&)>& before = {});

/// The list of cases, with what each expects and why.
std::string listText(const Selection&);

/// A line for each group, then each failure with its input, what was expected and what came out.
std::string summaryText(const std::vector<CaseResult>&);

/// Whether all passed.
bool allPassed(const std::vector<CaseResult>&);

nlohmann::ordered_json casesJson(const std::vector<CaseResult>&);

}  // namespace glint::stability
