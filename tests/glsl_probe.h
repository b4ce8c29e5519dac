#pragma once

// Shared by the tests of GLSL functions: a probe on each software backend, columns of inputs, and
// failure messages with the worst input.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "backend_name.h"
#include "error_record.h"
#include "glint/gl/context.h"
#include "glint/render/probe.h"
#include "glint/render/probe_search.h"

namespace glint {

using Column = std::vector<float>;
using Columns = std::vector<std::span<const float>>;

inline constexpr double ulp1 = 1.0 / (1 << 24);  ///< the relative rounding error of a float: 2^-24

/// The shaders under test: the built-in ones, or a folder of edited ones in GLINT_GLSL, to see
/// which test a change breaks without building anything.
inline GlslSources glslSources() {
  const char* folder = std::getenv("GLINT_GLSL");
  return folder ? GlslSources(folder) : GlslSources();
}

class GlslTest : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    context_ = openContext(GetParam());
    context_->makeCurrent();
  }

  std::unique_ptr<Context> context_;
};

inline std::string backendTestName(const testing::TestParamInfo<Backend>& info) {
  return info.param == Backend::osmesa ? "osmesa" : "egl";
}

#define GLINT_ON_SOFTWARE_BACKENDS(Suite)                                                        \
  INSTANTIATE_TEST_SUITE_P(Software, Suite,                                                      \
                           testing::Values(glint::Backend::osmesa, glint::Backend::eglSoftware), \
                           glint::backendTestName)

/// Whether tests print the errors that they measure: if GLINT_PROBE_PRINT is set.
inline bool printsErrors() { return std::getenv("GLINT_PROBE_PRINT") != nullptr; }

/// Fails if a value is above its bound, and reports the worst input. `floats` is the number of
/// floats per row in each column.
inline void expectWithin(const ErrorRecord& record, const std::string& what, const Columns& columns,
                         const std::vector<std::size_t>& floats) {
  EXPECT_GT(record.values, 0u) << what;
  EXPECT_EQ(record.outside, 0u) << what << ": " << record.summary() << " at "
                                << describeRow(columns, floats, record.ofBound.row);
  if (printsErrors())
    std::printf("%-44s %s\n    abs %s\n    bound %s\n", what.c_str(), record.summary().c_str(),
                describeRow(columns, floats, record.absolute.row).c_str(),
                describeRow(columns, floats, record.ofBound.row).c_str());
}

}  // namespace glint
