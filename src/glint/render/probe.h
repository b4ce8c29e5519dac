#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "glint/render/glsl_sources.h"

namespace glint {

/// What a probe's functions are compiled with.
struct ProbeText {
  /// Files of glsl/ in the order of composition: "vector.glsl" before what calls safeUnit.
  std::vector<std::string> files;
  /// #define NAME VALUE, before the files.
  std::vector<std::pair<std::string, int>> defines;
  /// Extra GLSL, after the defines and before the files.
  std::string text = {};
};

/// Runs GLSL functions, as the driver compiles them for the fragment stage, over arrays of inputs:
/// one evaluation a fragment, inputs through buffer textures, results through a float target.
/// Floats go in and come out bit for bit (except payloads of NaN). Whether the functions see
/// subnormal numbers or zeros is up to the driver: llvmpipe reads and returns them as zero.
///
///     Probe probe({}, {{"lobe.glsl"}, {}});
///     std::vector<float> lobes = probe.run("float lobeExact(float, float)", {lambdas, exponents});
///
/// It belongs to the context that is current when it is made, and must be destroyed before it.
/// run() leaves GL's depth test, blending, culling, scissor test and multisampling off and its own
/// framebuffer, viewport, program, vertex array and buffer textures bound.
class Probe {
 public:
  explicit Probe(GlslSources sources = {}, ProbeText text = {});
  ~Probe();
  Probe(Probe&&) noexcept;
  Probe& operator=(Probe&&) noexcept;

  /// Evaluates a function over columns of arguments.
  ///
  /// `function` is a GLSL prototype, "float fresnelExact(float, Boundary)", of a function in the
  /// files or of one built into the language; or a definition with its body, for an expression or a
  /// composition: "float quotient(float x, float y) { return x / y; }", and more functions may
  /// follow its closing brace if it declares them. Arguments are float, vec2, vec3, vec4 and
  /// structs of these that the files declare; the result is one of the first four.
  ///
  /// One column for each argument: its floats (for a struct, those of all members), row after row.
  /// All have the same number of rows, except that a column of a single row is used for every row.
  ///
  /// Returns the results' floats, row after row. Rows are evaluated in batches of up to 2^18.
  /// Programs are cached: a function is compiled once. Throws Error: a prototype that cannot be
  /// read, columns that do not fit it, the driver's compiler messages (with file and line), GL
  /// errors.
  std::vector<float> run(std::string_view function,
                         const std::vector<std::span<const float>>& columns);

  /// As above, into `results`, whose size must be that of the results.
  void run(std::string_view function, const std::vector<std::span<const float>>& columns,
           std::span<float> results);

 private:
  struct Function;
  struct Objects;

  Function& function(std::string_view text);
  std::unique_ptr<Function> compile(std::string_view text) const;

  GlslSources sources_;
  ProbeText text_;
  std::map<std::string, std::unique_ptr<Function>, std::less<>> functions_;
  std::unique_ptr<Objects> objects_;
};

}  // namespace glint
