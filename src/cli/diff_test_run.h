#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "diff_html.h"
#include "diff_report.h"

namespace glint {

/// What one test of glint_add_image_test() left behind; paths are empty if the file does not exist.
struct TestRecord {
  std::string name, baseline;  ///< as given in CMake
  std::string actual, kept, difference;
};

struct TestRun {
  std::vector<TestRecord> records;
  std::vector<DiffEntry> entries;   ///< name, paths and status, for updating
  nlohmann::ordered_json pairs;     ///< what was recorded, one object for each test
  std::vector<std::string> unused;  ///< pictures beside the tests' baselines that belong to no test
};

/// Reads a folder of image tests (GLINT_IMAGE_TEST_OUTPUT, or image-tests in a build folder):
///
///     tests/FILE.txt          CMake's: the test's name, the baseline, the picture's extension, and
///                             the options of glint diff, one per line
///     status/FILE.txt         how far the test came: "started", "command N", "nothing",
///                             "compared N", "updated"
///     log/FILE.txt            the output of its program
///     result/FILE.json        the result of glint diff
///     actual/, baseline/, difference/FILE...
///
/// Throws InputError if there are no tests.
TestRun readTestRun(const std::string& folder);

/// The pictures of a record, for the layer that its result shows.
PairPictures picturesOf(const TestRecord& record, const DiffEntry& entry,
                        const nlohmann::ordered_json& pair);

}  // namespace glint
