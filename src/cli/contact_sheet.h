#pragma once

#include <memory>
#include <string>
#include <vector>

#include "picture_source.h"

namespace glint {

/// A parameter that varies in steps: KEY=FROM:TO:STEPS[:log|:linear]. KEY is a numeric parameter of
/// the look by its option name, or of a material: [NAME:]exponent. The steps are linear or
/// logarithmic as the suffix asks; without one, as the parameter's slider is.
class Sweep {
 public:
  /// Throws InputError for unknown parameters, values out of range and malformed steps.
  explicit Sweep(const std::string& text);

  int steps() const { return int(values_.size()); }
  void apply(Look& look, int step) const;
  /// "exponent 31.62".
  std::string label(int step) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_, key_, material_;
  bool ofMaterial_ = false;
  std::vector<double> values_;
};

/// A picture of pictures, each with its sweep values below it: for one sweep in rows of at most
/// six, for two the first across and the second down.
class ContactSheet : public PictureSource {
 public:
  /// `sweeps`: one or two. The stage must outlive it. Throws InputError for more than 65535 pixels
  /// across or down.
  ContactSheet(Stage& stage, const std::vector<Sweep>& sweeps, const Look& look);

  glm::ivec2 size() const override;
  bool draw(Image& rows) override;
  const DrawList& list() const override { return last_->list(); }
  RenderTimes times() const override { return times_; }
  int samples() const override { return last_->samples(); }

 private:
  void drawCell(int column, Image& rows);

  Stage& stage_;
  const std::vector<Sweep>& sweeps_;
  Look look_;
  int columns_, rows_, cells_, gap_, textScale_;
  int row_ = 0;
  std::unique_ptr<PictureSource> last_;
  RenderTimes times_;
};

}  // namespace glint
