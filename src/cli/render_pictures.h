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

/// What the pictures of a run share.
struct RenderRun {
  const RenderOptions& options;
  const std::vector<Sweep>& sweeps;
  Renderer* renderer = nullptr;  ///< null: the reference
  std::optional<GlStrings> gl;
  PictureEncoder& encoder;
  RenderReport& report;
  StatusLine& line;
  double contextTime = 0, startTime = 0;  ///< ms, reported with the first picture
  bool first = true;
  std::function<void(const Look&)> saveResolved = {};  ///< for --save-look with a budget
};

/// Draws a model's pictures and passes them on; errors become part of the report. Stops early after
/// a signal.
void drawModel(RenderRun& run, LoadedModel model);

}  // namespace glint
