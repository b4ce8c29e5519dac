#include "glint/image/baseline.h"

#include <cstdlib>
#include <filesystem>

#include "glint/image/difference_picture.h"
#include "glint/image/error.h"
#include "glint/image/file.h"

namespace glint {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

std::string madeFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(printablePath(folder) + ": " + error.message() +
                     ": give another folder for the pictures of tests");
  return folder;
}

void writePicture(const Image& picture, const std::string& path, const PictureOptions& options) {
  const auto writer = openPictureWriter(path, picture.width, picture.height, options);
  writer->write(picture);
  writer->finish();
}

}  // namespace

BaselineResult compareWithBaseline(const Image& picture, const std::string& baseline,
                                   const BaselineOptions& options) {
  std::string folder = options.folder;
  if (folder.empty()) folder = variable("GLINT_IMAGE_TEST_OUTPUT");
  if (folder.empty()) folder = "image-tests";
  const fs::path name = fs::path(baseline).filename();
  BaselineResult result;
  result.actual = madeFolder(folder + "/actual") + "/" + name.string();
  const std::string difference =
      madeFolder(folder + "/difference") + "/" + name.stem().string() + ".png";
  std::error_code ignored;
  fs::remove(difference, ignored);
  writePicture(picture, result.actual, options.file);
  const bool updating = variable("GLINT_UPDATE_BASELINES") == "1";
  const bool there = !isMissing(baseline);
  if (there) {
    const StoredImage a = readStoredImage(baseline), b = readStoredImage(result.actual);
    result.comparison = compare(a, b, options.compare);
    result.status = result.comparison.same ? BaselineStatus::same : BaselineStatus::differs;
    if (result.status == BaselineStatus::same) return result;
    for (const std::string& failure : result.comparison.failures)
      result.message += (result.message.empty() ? "" : "; ") + failure;
    result.message += "\n" + result.comparison.worstText();
    if (a.width == b.width && a.height == b.height) {
      writeDifference(difference, a, b, options.compare, DifferenceKind::flip, 1);
      result.difference = difference;
    }
  }
  if (updating) {
    madeFolder(fs::absolute(baseline).parent_path().string());
    writePicture(picture, baseline, options.file);
    result.status = BaselineStatus::updated;
    result.message = std::string(there ? "replaced" : "made") + " the baseline " +
                     printablePath(baseline) +
                     ": check it, and run the test again without GLINT_UPDATE_BASELINES";
    return result;
  }
  if (!there) result.message = "no baseline " + printablePath(baseline) + "\n";
  result.message += "the picture is " + printablePath(result.actual);
  if (!result.difference.empty())
    result.message += ", the difference " + printablePath(result.difference);
  result.message += "\nto accept it, run the test with GLINT_UPDATE_BASELINES=1 in the environment";
  return result;
}

}  // namespace glint
