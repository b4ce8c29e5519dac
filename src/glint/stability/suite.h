#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/stability/bench.h"
#include "glint/stability/case.h"

namespace glint::stability {

/// A case as it came out.
struct CaseResult {
  const Group* group = nullptr;
  const Case* item = nullptr;
  std::vector<Finding> findings;
  std::string error;  ///< why it could not be run to its end; empty if it was
  double milliseconds = 0;

  bool passed() const;
};

/// Which cases: by id and by group, case-insensitive; both empty is all of them.
struct Selection {
  std::vector<std::string> ids, groups;

  /// Throws InputError for an id or a group that does not exist.
  void check() const;
  bool has(const Group&, const Case&) const;
  bool isAll() const { return ids.empty() && groups.empty(); }
};

/// Runs the cases in their order; `before` is told of each, and the share that is done.
std::vector<CaseResult> runCases(Bench&, const Selection&,
                                 const std::function<void(double share, const Case&)>& before = {});

/// The table of cases, one line each.
std::string listText(const Selection&);

/// A line for each group, then each failure with what went in, what must come out and what did.
std::string summaryText(const std::vector<CaseResult>&);

/// Whether all passed.
bool allPassed(const std::vector<CaseResult>&);

nlohmann::ordered_json casesJson(const std::vector<CaseResult>&);

}  // namespace glint::stability
