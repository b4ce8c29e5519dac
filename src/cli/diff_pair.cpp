#include "diff_pair.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <future>
#include <iostream>
#include <iterator>
#include <optional>

#include "commands.h"
#include "diff_layers.h"
#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_layers.h"
#include "glint/image/read_image.h"
#include "glint/image/row_window.h"
#include "glint/image/task.h"
#include "report_pictures.h"

namespace glint {
namespace {

namespace fs = std::filesystem;

std::string temporaryFolderName() {
  const char* given = std::getenv("TMPDIR");
  return given && *given ? printablePath(given) : "/tmp";
}

/// A file that is removed when this is destroyed.
struct TemporaryPng {
  std::string path;
  TemporaryPng() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    std::string name = (folder / "glint-XXXXXX.png").string();
    const int file = error ? -1 : ::mkstemps(name.data(), 4);
    if (file < 0)
      throw InputError("no temporary file can be made in " + temporaryFolderName() +
                       ": set TMPDIR to an existing folder with free space");
    ::close(file);
    path = name;
  }
  ~TemporaryPng() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

/// Larger pictures are read row by row.
constexpr std::size_t heldBytes = std::size_t(64) << 20;

PictureLayers layersOf(const std::vector<std::byte>& bytes, const std::string& path,
                       const std::string& wanted) {
  return decodePictureLayers(bytes, path == "-" ? "stdin" : path, wanted, heldBytes);
}

/// Throws InputError if a picture that may not have been read to its end is damaged: it must not
/// become a baseline.
void readToEnd(const PictureLayers& read) {
  if (const auto& window = read.layers[0].image.window) window->readToEnd();
}

bool isWhole(const PictureLayers& read) {
  try {
    readToEnd(read);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Both pictures of a pair. Identical bytes are decoded once.
struct BothPictures {
  std::vector<std::byte> bytesA, bytesB;
  PictureLayers a, b;

  void read(const DiffSettings& settings, DiffEntry& entry) {
    bytesB = pictureBytes(entry.b);
    bytesA = pictureBytes(entry.a);
    // Comparing vectors goes byte by byte.
    const bool same = bytesA.size() == bytesB.size() &&
                      std::memcmp(bytesA.data(), bytesB.data(), bytesA.size()) == 0;
    std::future<PictureLayers> reading;
    // Starting a thread costs as much as decoding a small picture.
    const auto readA = [&] { return layersOf(bytesA, entry.a, settings.layer); };
    if (!same && bytesA.size() > 200000) reading = startTask(readA);
    std::string errorB;
    try {
      b = layersOf(bytesB, entry.b, settings.layer);
      entry.readableB = true;
      entry.textB = b.layers[0].image.text;
    } catch (const InputError& error) {
      errorB = error.what();
    }
    try {
      a = same && errorB.empty() ? b : reading.valid() ? reading.get() : readA();
    } catch (const InputError&) {
      entry.readableB = errorB.empty() && isWhole(b);
      throw;
    }
    if (!errorB.empty()) throw InputError(errorB);
    // Formats other than OpenEXR have one picture, which is compared with the main one.
    if (a.named != b.named && settings.layer == "all") {
      (a.named ? a : b) = layersOf(a.named ? bytesA : bytesB, a.named ? entry.a : entry.b, "main");
    }
  }
};

/// The options of a comparison, with all metrics if they are wanted.
CompareOptions optionsFor(const DiffSettings& settings, const StoredImage& a,
                          const StoredImage& b) {
  CompareOptions options = settings.compare;
  if (settings.allMetrics) {
    for (const std::string& name : metricNames())
      if (name != "hdr-flip" || !(a.isEncoded() || b.isEncoded())) options.metrics.push_back(name);
  }
  return options;
}

bool asksFor(const CompareOptions& options, const char* metric) {
  return std::count(options.metrics.begin(), options.metrics.end(), metric) > 0 ||
         std::any_of(options.conditions.begin(), options.conditions.end(),
                     [&](const Condition& condition) { return condition.metric == metric; });
}

void compareFiles(const DiffSettings& settings, DiffEntry& entry, PairPictures* pictures) {
  BothPictures both;
  both.read(settings, entry);
  entry.width = both.a.layers[0].image.width;
  entry.height = both.a.layers[0].image.height;
  entry.textA = both.a.layers[0].image.text;
  const std::string note = driverNote(entry);
  entry.acrossDrivers = !note.empty();
  if (!note.empty()) entry.notes.push_back(note);
  const LayerPairs pairs = matchLayers(both.a, both.b, entry);
  if (pairs.matched.empty()) {
    entry.result.failures = pairs.missing;
    entry.status = differs;
    return;
  }
  // The layer to show: the main picture, or if it is equal the first layer that is not.
  const LayerPair& shown = pairs.matched[pairs.shown];
  const bool flipPossible =
      shown.a->colour &&
      std::uint64_t(shown.width()) * std::uint64_t(shown.height()) <= std::uint64_t(1) << 28;
  const bool flipOutput =
      flipPossible && !settings.output.empty() && settings.difference == DifferenceKind::flip;
  const bool flipOfPage = flipPossible && pictures;
  const bool besideColours = std::any_of(pairs.matched.begin(), pairs.matched.end(),
                                         [](const LayerPair& pair) { return pair.a->colour; });
  std::optional<TemporaryPng> map;
  // The page always gets its own map, whose colours encode errors, whatever format the file has.
  std::optional<FlipPicture> forPage, forFile;
  try {
    for (std::size_t i = 0; i < pairs.matched.size(); ++i) {
      const LayerPair& pair = pairs.matched[i];
      CompareOptions options = optionsFor(settings, pair.a->image, pair.b->image);
      if (i == pairs.shown && (flipOfPage || flipOutput)) {
        if (flipOfPage) forPage.emplace(map.emplace().path, shown.width(), shown.height());
        if (flipOutput) forFile.emplace(settings.output, shown.width(), shown.height());
        if (!asksFor(options, "hdr-flip")) options.metrics.push_back("flip");
        options.flipMap = [&](int, const float* errors) {
          if (forPage) forPage->add(errors);
          if (forFile) forFile->add(errors);
        };
      }
      addLayer(pair, options, i == 0, besideColours, entry);
    }
    readToEnd(both.a);
    readToEnd(both.b);
  } catch (const InputError& error) {
    entry.readableB = isWhole(both.b);
    if (!entry.readableB || !isWhole(both.a)) throw;
    throw InputError(printablePath(entry.a) + " and " + printablePath(entry.b) + ": " +
                     error.what());
  }
  entry.result.failures.insert(entry.result.failures.end(), pairs.missing.begin(),
                               pairs.missing.end());
  entry.result.same = entry.result.same && pairs.missing.empty();
  entry.shown = shown.a->name;
  if (forPage) forPage->finish();
  if (forFile) forFile->finish();
  const bool anyDifference =
      pairs.shown > 0 || entry.result.differing > 0 || entry.result.sizesDiffer;
  if (!settings.output.empty() && !flipOutput)
    writeDifference(settings.output, shown.a->image, shown.b->image, settings.compare,
                    shown.a->colour ? settings.difference : DifferenceKind::absolute,
                    shown.a->colour ? settings.scale : shownScale(shown));
  if (pictures) {
    pictures->a = browserPicture(both.bytesA, *shown.a, shown.range());
    if (anyDifference) {
      pictures->b = browserPicture(both.bytesB, *shown.b, shown.range());
      if (map) pictures->map = readFile(map->path, Noted::no);
      pictures->valuesA = trueValues(*shown.a);
      pictures->valuesB = trueValues(*shown.b);
    }
    pictures->thumbnail = thumbnailOf(anyDifference ? shown.b->image : shown.a->image);
  }
  entry.status = entry.result.same ? done : differs;
}

/// Chooses among several baselines: one that passes, or else the one with the fewest differing
/// pixels.
void chooseBaseline(const DiffSettings& settings, DiffEntry& entry) {
  DiffSettings plain = settings;
  plain.output.clear();
  plain.allMetrics = false;
  std::vector<std::string> candidates{entry.a};
  candidates.insert(candidates.end(), entry.others.begin(), entry.others.end());
  std::string best;
  double bestScore = INFINITY;
  for (const std::string& candidate : candidates) {
    DiffEntry trial = entry;
    trial.a = candidate;
    double score = INFINITY;
    try {
      compareFiles(plain, trial, nullptr);
      score = trial.status == done ? -1 : double(trial.result.differing);
      if (trial.result.sizesDiffer) score += 1e12;
    } catch (const InputError&) {
      continue;  // reported if this candidate is chosen
    }
    if (score >= bestScore) continue;
    bestScore = score;
    best = candidate;
    if (score < 0) break;
  }
  if (best.empty() || best == entry.a) return;
  entry.a = best;
  entry.notes.push_back("compared with " + fs::path(best).filename().string() +
                        ", the nearest of " + std::to_string(candidates.size()) + " baselines");
}

std::vector<std::byte> readStdin() {
  std::vector<std::byte> bytes;
  char piece[1 << 16];
  while (std::cin.read(piece, sizeof piece), std::cin.gcount() > 0) {
    const auto* const begin = reinterpret_cast<const std::byte*>(piece);
    bytes.insert(bytes.end(), begin, begin + std::cin.gcount());
    if (bytes.size() > std::size_t(4) << 30)
      throw InputError("stdin: more than 4 GiB: give a smaller picture");
  }
  return bytes;
}

/// Loads a picture without a partner for the report.
void showAlone(const DiffSettings& settings, const std::string& path, bool isA, DiffEntry& entry,
               PairPictures* pictures) {
  const std::vector<std::byte> bytes = pictureBytes(path);
  const PictureLayers read = layersOf(bytes, path, settings.layer);
  readToEnd(read);
  (isA ? entry.textA : entry.textB) = read.layers[0].image.text;
  if (!isA) entry.readableB = true;
  if (!pictures) return;
  (isA ? pictures->a : pictures->b) =
      browserPicture(bytes, read.layers[0], rangeOf(read.layers[0].image));
  pictures->thumbnail = thumbnailOf(read.layers[0].image);
}

}  // namespace

std::vector<std::byte> pictureBytes(const std::string& path) {
  if (path != "-") return readFile(path);
  static const std::vector<std::byte> bytes = readStdin();  // several baselines may be tried
  return bytes;
}

void diffPair(const DiffSettings& settings, DiffEntry& entry, PairPictures* pictures) {
  const auto start = Clock::now();
  try {
    if (entry.b.empty()) {
      entry.status = unusable;
      entry.error = "missing: there is a baseline but no picture";
      if (pictures) showAlone(settings, entry.a, true, entry, pictures);
    } else if (entry.a.empty()) {
      entry.status = noBaseline;
      entry.error = "no baseline: accept it with --update";
      showAlone(settings, entry.b, false, entry, pictures);
    } else {
      if (!entry.others.empty()) chooseBaseline(settings, entry);
      compareFiles(settings, entry, pictures);
    }
  } catch (const InputError& error) {
    entry.status = unusable;
    entry.error = error.what();
  } catch (const std::bad_alloc&) {
    entry.status = unusable;
    entry.error = "out of memory: compare smaller pictures, or fewer at a time (--jobs)";
  } catch (const std::system_error& error) {
    entry.status = unusable;
    entry.error = failureOf(error, entry.name);
  }
  // If a pair could not be compared, whichever picture can be read is shown.
  if (pictures && entry.status == unusable && !entry.b.empty()) {
    for (const bool isA : {true, false}) {
      const std::string& path = isA ? entry.a : entry.b;
      try {
        if (!path.empty() && path != "-") showAlone(settings, path, isA, entry, pictures);
      } catch (const std::exception&) {
        continue;  // the entry's error already reports it
      }
    }
  }
  entry.milliseconds = since(start);
}

std::string driverBaseline(const std::string& folder, const DiffEntry& entry) {
  const auto found = entry.textB.find("GL_RENDERER");
  if (found == entry.textB.end()) return folder + "/" + entry.name;
  std::string slug;
  for (const char letter : found->second) {
    const auto c = static_cast<unsigned char>(letter);
    if (std::isalnum(c)) {
      slug += static_cast<char>(std::tolower(c));
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return folder + "/driver-" + slug.substr(0, 100) + "/" + entry.name;
}

void useDriverBaseline(const std::string& folder, DiffEntry& entry) {
  if (entry.b.empty()) return;
  try {
    entry.textB = pictureTextIn(pictureBytes(entry.b), entry.b);
  } catch (const InputError&) {
    return;  // reported by the comparison
  }
  const std::string path = driverBaseline(folder, entry);
  if (!isMissing(path)) entry.a = path;
}

std::vector<std::string> otherBaselines(const std::string& path) {
  const fs::path whole(path);
  std::vector<std::string> found;
  std::error_code ignored;
  for (int i = 1;; ++i) {
    const fs::path other = whole.parent_path() / (whole.stem().string() + "_" + std::to_string(i) +
                                                  whole.extension().string());
    if (!fs::is_regular_file(other, ignored)) return found;
    found.push_back(other.string());
  }
}

}  // namespace glint
