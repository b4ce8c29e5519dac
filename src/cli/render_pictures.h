#pragma once

#include <functional>
#include <optional>

#include "contact_sheet.h"
#include "glint/render/renderer.h"
#include "model_loader.h"
#include "picture_encoder.h"
#include "picture_source.h"
#include "render_report.h"

namespace glint {

/// What the pictures of a run have in common.
struct RenderRun {
  const RenderOptions& options;
  const std::vector<Sweep>& sweeps;
  Renderer* renderer = nullptr;  ///< without: the reference
  std::optional<GlStrings> gl;
  PictureEncoder& encoder;
  RenderReport& report;
  StatusLine& line;
  double contextTime = 0, startTime = 0;  ///< ms, told of the first picture
  bool first = true;
  std::function<void(const Look&)> saveResolved = {};  ///< of --save-look with a budget
};

/// Draws a model's pictures and hands them on; what goes wrong becomes part of the report. Leaves
/// off where it is if a signal has come.
void drawModel(RenderRun& run, LoadedModel model);

}  // namespace glint
