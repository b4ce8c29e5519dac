#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "diff_html.h"
#include "diff_report.h"

namespace glint {

/// What one test of glint_add_image_test() has left; paths are empty where there is no file.
struct TestRecord {
  std::string name, baseline;  ///< as CMake has them
  std::string actual, kept, difference;
};

struct TestRun {
  std::vector<TestRecord> records;
  std::vector<DiffEntry> entries;   ///< name, paths and status, for updating
  nlohmann::ordered_json pairs;     ///< what was recorded, one for each test
  std::vector<std::string> unused;  ///< baselines beside those of the tests, of none
};

/// Reads a folder of image tests (GLINT_IMAGE_TEST_OUTPUT, or image-tests in a build folder):
///
///     tests/FILE.txt          CMake's: the test's name, the baseline, the picture's ending, and
///                             the options of glint diff, a line each
///     status/FILE.txt         how far the test came: "started", "command N", "nothing",
///                             "compared N", "updated"
///     log/FILE.txt            what its program said
///     result/FILE.json        what glint diff said
///     actual/, baseline/, difference/FILE...
///
/// Throws InputError if there are no tests.
TestRun readTestRun(const std::string& folder);

/// The pictures of a record, of the layer that its result shows.
PairPictures picturesOf(const TestRecord& record, const DiffEntry& entry,
                        const nlohmann::ordered_json& pair);

}  // namespace glint
