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

/// A picture to be.
struct PlannedPicture {
  std::string output;
  std::string reference;  ///< to compare with; empty: none
  std::size_t frame = 0;
  std::string variation;  ///< what distinguishes it from the others of its model, for its key
};

/// Which pictures a run makes and how they are called.
class PicturePlan {
 public:
  /// Looks through the list if it is known beforehand. Throws InputError for names that cannot be
  /// and for two pictures with one name.
  PicturePlan(const RenderOptions& options, ModelList& list);

  /// The pictures of a model, without those of other shards. To be asked for once for each model.
  /// Throws InputError if a picture has the name of another.
  std::vector<PlannedPicture> picturesOf(const ModelEntry& entry);

  /// Notes the models, what they are compared with and, if a picture of the plan or something else
  /// that is written is there already (`replaces`), the files that the models name as read.
  void noteInputs(bool replaces);
  /// Throws InputError if a picture would be written over a file that is read.
  void checkOutputs();

  /// How many there are in all, if that is known.
  std::optional<std::size_t> count() const { return count_; }

 private:
  /// Whether it falls to this shard.
  bool isMine(const ModelEntry& entry) const;
  /// Throws InputError for a name of a line's own that no picture can have.
  void checkOwnName(const ModelEntry& entry) const;
  std::vector<PlannedPicture> named(const ModelEntry& entry) const;
  void take(const ModelEntry& entry, const std::vector<PlannedPicture>& pictures);

  void forEachOutput(const std::function<void(const std::string&)>& visit);

  const RenderOptions& options_;
  ModelList& list_;
  OutputPattern pattern_;
  std::optional<OutputPattern> referencePattern_;
  Shard shard_;
  std::vector<bool> members_;  ///< of the shard, by number; empty: every N-th
  bool shardsFrames_;
  bool namesChecked_ = false;
  NamesTaken names_;
  std::optional<std::size_t> models_, count_;
};

struct LoadedModel;

/// The look of a planned picture of the model; of a sequence with the moment, and the camera where
/// it sees all poses.
Look lookOf(const PlannedPicture&, const RenderOptions&, const Look& base, const LoadedModel&);

}  // namespace glint
