#include "picture_plan.h"

#include <filesystem>

#include "glint/gltf/model_files.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_writer.h"
#include "glint/image/read_files.h"
#include "glint/options/outputs.h"
#include "model_loader.h"

namespace glint {
namespace {

/// The files of --terms that every model with a light has.
constexpr const char* termWords[] = {"ambient", "diffuse-0", "specular-0", "normal", "depth"};

/// The approximate cost of a model, in bytes of its file: even a trivial picture takes as long as
/// reading a few megabytes.
double costOf(const std::string& model) {
  std::error_code error;
  const auto size = std::filesystem::file_size(model, error);
  return 4e6 + (error ? 0.0 : double(size));
}

}  // namespace

PicturePlan::PicturePlan(const RenderOptions& options, ModelList& list)
    : options_(options),
      list_(list),
      pattern_(options.output, options.hasFrames()),
      shardsFrames_(!options.hasList() && options.models.size() == 1) {
  if (!options.reference.empty()) referencePattern_.emplace(options.reference, options.hasFrames());
  if (!options.shard.empty()) shard_ = parseShard(options.shard);
  checkPictureName(options.output, pictureOptions(options, options.output));
  list.lookThrough([](const ModelEntry&) {});
  models_ = list.count();
  if (!models_) return;
  if (shard_.of > 1 && !shardsFrames_) {
    std::vector<double> costs;
    list.lookThrough([&](const ModelEntry& entry) { costs.push_back(costOf(entry.model)); });
    members_ = membersOf(shard_, costs);
  }
  std::size_t count = 0;
  list.lookThrough([&](const ModelEntry& entry) {
    const auto pictures = named(entry);
    checkOwnName(entry);
    take(entry, pictures);
    count += entry.error.empty() ? pictures.size() : std::size_t(isMine(entry));
  });
  count_ = count;
  namesChecked_ = true;
}

bool PicturePlan::isMine(const ModelEntry& entry) const {
  if (shardsFrames_) return true;
  return entry.number < members_.size() ? members_[entry.number] : shard_.has(entry.number);
}

void PicturePlan::checkOwnName(const ModelEntry& entry) const {
  if (!entry.output.empty()) checkPictureName(entry.output, pictureOptions(options_, entry.output));
}

void PicturePlan::forEachOutput(const std::function<void(const std::string&)>& visit) {
  list_.lookThrough([&](const ModelEntry& entry) {
    for (const PlannedPicture& picture : named(entry)) {
      visit(picture.output);
      if (!options_.terms) continue;
      for (const char* word : termWords) visit(withWord(picture.output, word));
    }
  });
}

void PicturePlan::noteInputs(bool replaces) {
  forEachOutput([&](const std::string& output) { replaces = replaces || !isMissing(output); });
  list_.lookThrough([&](const ModelEntry& entry) {
    if (!entry.error.empty()) return;
    if (!entry.lookFile.empty()) noteReadFile(entry.lookFile);
    if (replaces)
      noteModelFiles(entry.model);
    else
      noteReadFile(entry.model);
    if (!referencePattern_) return;
    for (const PlannedPicture& picture : named(entry)) noteReadFile(picture.reference);
  });
}

void PicturePlan::checkOutputs() {
  forEachOutput([&](const std::string& output) {
    if (isReadFile(output))
      throw InputError("-o " + options_.output + ": " + printablePath(output) +
                       " is an input file and would be overwritten: give another name");
  });
}

std::vector<PlannedPicture> PicturePlan::picturesOf(const ModelEntry& entry) {
  if (!entry.error.empty() && isMine(entry)) throw InputError(entry.error);
  auto pictures = named(entry);
  if (!namesChecked_) {
    checkOwnName(entry);
    take(entry, pictures);
  }
  return pictures;
}

std::vector<PlannedPicture> PicturePlan::named(const ModelEntry& entry) const {
  std::vector<PlannedPicture> pictures;
  if (!isMine(entry) || !entry.error.empty()) return pictures;
  const std::size_t frames = options_.frameCount(), models = models_.value_or(0);
  const OutputPattern own =
      entry.output.empty() ? pattern_ : OutputPattern(entry.output, options_.hasFrames());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    if (shardsFrames_ && !shard_.has(frame)) continue;
    PlannedPicture picture;
    picture.frame = frame;
    picture.output = own.name(entry.model, entry.number, models, frame, frames);
    if (referencePattern_)
      picture.reference = referencePattern_->name(entry.model, entry.number, models, frame, frames);
    const auto vary = [&](const std::string& what) {
      picture.variation += (picture.variation.empty() ? "" : ", ") + what;
    };
    const std::string place = std::to_string(frame) + "/" + std::to_string(frames);
    if (options_.turntable > 0) vary("turntable " + place);
    if (options_.frames > 0) vary("frame " + place);
    for (const std::string& sweep : options_.sweeps) vary("sweep " + sweep);
    if (options_.terms) vary("terms");
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

void PicturePlan::take(const ModelEntry& entry, const std::vector<PlannedPicture>& pictures) {
  for (const PlannedPicture& picture : pictures) {
    if (!picture.reference.empty() && isSameFile(picture.output, picture.reference))
      throw InputError(
          "--reference " + printablePath(picture.reference) +
          ": -o writes to that file, so it would be compared with itself: give another file");
    // Raw pictures can be separated in a stream.
    if (picture.output == "-" &&
        pictureOptions(options_, picture.output).format->id == PictureFormat::Id::raw)
      continue;
    const std::size_t* other = names_.take(picture.output, entry.number);
    if (options_.terms)
      for (const char* word : termWords) {
        const auto* const same = names_.take(withWord(picture.output, word), entry.number);
        other = other ? other : same;
      }
    if (!other) continue;
    const std::string name = printablePath(picture.output);
    if (*other == entry.number)
      throw InputError("-o " + options_.output + ": two pictures of " + printablePath(entry.model) +
                       " would both become " + name + ": put {frame} into the name");
    const std::string which = options_.hasList()
                                  ? "model " + std::to_string(*other) + " of the list"
                                  : printablePath(options_.models[*other]);
    throw InputError("-o " + options_.output + ": " + which + " and " + printablePath(entry.model) +
                     " would both become " + name + ": put " +
                     (options_.output.find("{model}") == std::string::npos ? "{model} or " : "") +
                     "{n} into the name");
  }
}

Look lookOf(const PlannedPicture& picture, const RenderOptions& options, const Look& base,
            const LoadedModel& model) {
  Look look = base;
  const Bounds& bounds = model.allBounds;
  if (options.frames > 0) {
    look = definiteLook(base, model.scene, bounds);
    look.animationTime = model.duration * double(picture.frame) / options.frames;
  }
  if (options.turntable == 0 || picture.frame == 0) return look;
  return turnedLook(look, model.scene, bounds, 360.0 * double(picture.frame) / options.turntable);
}

}  // namespace glint
