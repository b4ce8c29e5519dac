#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/image/compare.h"

namespace glint {

/// A layer other than the main picture.
struct LayerResult {
  std::string name;
  Comparison result;
};

/// One pair of pictures and its result.
struct DiffEntry {
  std::string name;                               ///< of the pair; in a folder, its path there
  std::string a, b;                               ///< paths; empty if missing
  std::vector<std::string> others;                ///< further baselines
  int status = 0;                                 ///< as an exit status
  std::string error;                              ///< why it could not be compared
  std::vector<std::string> notes;                 ///< further remarks
  std::vector<std::string> notCompared;           ///< what else the files contain, in words
  std::map<std::string, std::string> unfollowed;  ///< metadata in the files that is ignored
  bool readableB = false, updated = false, removed = false, acrossDrivers = false;
  Comparison result;                ///< of the main picture, but with the failures of all layers
  std::string mainName;             ///< of the main layer
  std::vector<LayerResult> layers;  ///< the others
  std::string shown;                ///< the layer that the report shows
  int width = 0, height = 0;        ///< of the baseline
  std::map<std::string, std::string> textA, textB;
  double milliseconds = 0;
};

/// A text of an object; empty if it has none of that key.
std::string textOf(const nlohmann::ordered_json& json, const char* key);

/// JSON as written to files; invalid UTF-8 is replaced.
std::string jsonText(const nlohmann::ordered_json& json);

/// Everything about one pair. The other reports are made from this JSON, so that recorded test
/// results are reported in the same way as new comparisons.
nlohmann::ordered_json diffJson(const DiffEntry& entry, const CompareOptions& options);

/// A one-line summary for people.
std::string diffLine(const nlohmann::ordered_json& pair);

/// Which colour and orientation metadata of the pictures is ignored; empty: none.
std::string notFollowedText(const nlohmann::ordered_json& pair);

/// "same", "differs", "no baseline", "missing" or "error".
std::string kindOf(const nlohmann::ordered_json& pair);

/// JUnit XML, one test case for each pair.
std::string junitXml(const nlohmann::ordered_json& pairs);

/// A summary for a merge request: counts, and a table of the pairs that are not the same.
std::string markdownText(const nlohmann::ordered_json& report);

/// Notes that the pictures were drawn by different drivers, if their metadata says so.
std::string driverNote(const DiffEntry& entry);

}  // namespace glint
