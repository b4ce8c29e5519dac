#include "diff_pair.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <optional>

#include "commands.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_writer.h"
#include "glint/image/task.h"

namespace glint {
namespace {

namespace fs = std::filesystem;

std::string temporaryFolderName() {
  const char* given = std::getenv("TMPDIR");
  return given && *given ? printablePath(given) : "/tmp";
}

/// A file that goes when its user does.
struct TemporaryPng {
  std::string path;
  TemporaryPng() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    std::string name = (folder / "glint-XXXXXX.png").string();
    const int file = error ? -1 : ::mkstemps(name.data(), 4);
    if (file < 0)
      throw InputError("no temporary file can be made in " + temporaryFolderName() +
                       ": set TMPDIR to a folder that is there and has room");
    ::close(file);
    path = name;
  }
  ~TemporaryPng() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

/// The picture as a browser can show it.
std::vector<std::byte> pngOf(const std::string& path, const StoredImage& image) {
  std::vector<std::byte> bytes = readFile(path);
  constexpr unsigned char magic[4] = {0x89, 'P', 'N', 'G'};
  if (bytes.size() > 4 &&
      std::equal(magic, magic + 4, bytes.begin(),
                 [](unsigned char m, std::byte b) { return std::byte(m) == b; }))
    return bytes;
  const TemporaryPng temporary;
  PictureOptions options;
  options.alpha = image.hasAlpha();
  const auto writer = openPictureWriter(temporary.path, image.width, image.height, options);
  Image row{image.width, 1, std::vector<float>(std::size_t(4) * image.width)};
  for (int y = 0; y < image.height; ++y) {
    image.linearRows(y, 1, row.values.data());
    writer->write(row);
  }
  writer->finish();
  return readFile(temporary.path);
}

void compareFiles(const DiffSettings& settings, DiffEntry& entry, PairPictures* pictures) {
  auto reading = startTask([&] { return readStoredImage(entry.a, settings.layer); });
  StoredImage b;
  std::string errorB;
  try {
    b = readStoredImage(entry.b, settings.layer);
  } catch (const InputError& error) {
    errorB = error.what();
  }
  entry.readableB = errorB.empty();
  entry.textB = b.text;
  const StoredImage a = reading.get();
  if (!errorB.empty()) throw InputError(errorB);
  entry.width = a.width;
  entry.height = a.height;
  entry.textA = a.text;
  entry.note = driverNote(entry);
  entry.acrossDrivers = !entry.note.empty();
  CompareOptions options = settings.compare;
  if (settings.allMetrics) {
    for (const std::string& name : metricNames())
      if (name != "hdr-flip" || !(a.isEncoded() || b.isEncoded())) options.metrics.push_back(name);
  }
  const bool flipOutput = !settings.output.empty() && settings.difference == DifferenceKind::flip;
  std::optional<TemporaryPng> map;
  std::optional<FlipPicture> output;
  const bool sameSize = a.width == b.width && a.height == b.height;
  if (sameSize && (pictures || flipOutput)) {
    if (!flipOutput) map.emplace();
    output.emplace(flipOutput ? settings.output : map->path, a.width, a.height);
    const auto hdr = [](const auto& asked, auto nameOf) {
      return std::any_of(asked.begin(), asked.end(),
                         [&](const auto& one) { return nameOf(one) == "hdr-flip"; });
    };
    if (!hdr(options.metrics, [](const std::string& name) { return name; }) &&
        !hdr(options.conditions, [](const Condition& condition) { return condition.metric; }))
      options.metrics.push_back("flip");
    options.flipMap = [&](int, const float* errors) { output->add(errors); };
  }
  try {
    entry.result = compare(a, b, options);
  } catch (const InputError& error) {
    throw InputError(printablePath(entry.a) + " and " + printablePath(entry.b) + ": " +
                     error.what());
  }
  if (output) output->finish();
  if (sameSize && !settings.output.empty() && !flipOutput)
    writeDifference(settings.output, a, b, options, settings.difference, settings.scale);
  if (pictures) {
    pictures->a = pngOf(entry.a, a);
    if (entry.result.differing > 0 || !sameSize) pictures->b = pngOf(entry.b, b);
    if (entry.result.differing > 0)
      pictures->map = readFile(flipOutput ? settings.output : map->path);
  }
  entry.status = entry.result.same ? done : differs;
}

}  // namespace

void diffPair(const DiffSettings& settings, DiffEntry& entry, PairPictures* pictures) {
  const auto start = std::chrono::steady_clock::now();
  try {
    if (entry.b.empty()) {
      entry.status = unusable;
      entry.error = "missing: there is a baseline and no picture";
      if (pictures) pictures->a = pngOf(entry.a, readStoredImage(entry.a, settings.layer));
    } else if (entry.a.empty()) {
      const StoredImage b = readStoredImage(entry.b, settings.layer);
      entry.status = noBaseline;
      entry.error = "no baseline: accept it with --update";
      entry.textB = b.text;
      entry.readableB = true;
      if (pictures) pictures->b = pngOf(entry.b, b);
    } else {
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
  entry.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
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
    entry.textB = readStoredImage(entry.b).text;
  } catch (const InputError&) {
    return;  // said when it is compared
  }
  const std::string path = driverBaseline(folder, entry);
  std::error_code ignored;
  if (fs::exists(path, ignored)) entry.a = path;
}

}  // namespace glint
