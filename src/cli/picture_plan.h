#pragma once

#include <functional>
#include <string>
#include <vector>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"
#include "model_list.h"
#include "output_names.h"
#include "render_options.h"

namespace glint {

/// A planned picture.
struct PlannedPicture {
  std::string output;
  std::string reference;  ///< to compare with; empty: none
  std::size_t frame = 0;
  std::string variation;  ///< what distinguishes it from the model's other pictures, for its key
};

/// Which pictures a run makes and what they are called.
class PicturePlan {
 public:
  /// Scans the list if it is known beforehand. Throws InputError for invalid names and for two
  /// pictures with the same name.
  PicturePlan(const RenderOptions& options, ModelList& list);

  /// The pictures of a model that belong to this shard. Call it once for each model. Throws
  /// InputError if a picture has the name of another.
  std::vector<PlannedPicture> picturesOf(const ModelEntry& entry);

  /// Records as inputs the models, what they are compared with and, if an output exists already (a
  /// picture of the plan, or any other with `replaces`), the files that the models refer to.
  void noteInputs(bool replaces);
  /// Throws InputError if a picture would overwrite an input file.
  void checkOutputs();

  /// The total number of pictures, if known.
  std::optional<std::size_t> count() const { return count_; }

 private:
  /// Whether the model belongs to this shard.
  bool isMine(const ModelEntry& entry) const;
  /// Throws InputError for a list line's output name that no picture can have.
  void checkOwnName(const ModelEntry& entry) const;
  std::vector<PlannedPicture> named(const ModelEntry& entry) const;
  void take(const ModelEntry& entry, const std::vector<PlannedPicture>& pictures);

  void forEachOutput(const std::function<void(const std::string&)>& visit);

  const RenderOptions& options_;
  ModelList& list_;
  OutputPattern pattern_;
  std::optional<OutputPattern> referencePattern_;
  Shard shard_;
  std::vector<bool> members_;  ///< members of the shard, by number; empty: every N-th
  bool shardsFrames_;
  bool namesChecked_ = false;
  NamesTaken names_;
  std::optional<std::size_t> models_, count_;
};

struct LoadedModel;

/// The look of a planned picture; in a sequence, with its time and with a camera that sees all
/// poses.
Look lookOf(const PlannedPicture&, const RenderOptions&, const Look& base, const LoadedModel&);

}  // namespace glint
