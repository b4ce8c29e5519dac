#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/image/compare.h"

namespace glint {

/// A layer beside the main picture.
struct LayerResult {
  std::string name;
  Comparison result;
};

/// One pair of pictures and how it went.
struct DiffEntry {
  std::string name;                               ///< of the pair; for a folder the path in it
  std::string a, b;                               ///< paths; empty if missing
  std::vector<std::string> others;                ///< more baselines for it
  int status = 0;                                 ///< an exit status
  std::string error;                              ///< why it could not be compared
  std::vector<std::string> notes;                 ///< what else is to be said
  std::vector<std::string> notCompared;           ///< what the files hold besides, in words
  std::map<std::string, std::string> unfollowed;  ///< what the files say and is not followed
  bool readableB = false, updated = false, removed = false, acrossDrivers = false;
  Comparison result;                ///< of the main picture; its failures are those of all layers
  std::string mainName;             ///< of that layer
  std::vector<LayerResult> layers;  ///< the others
  std::string shown;                ///< the layer that the report shows
  int width = 0, height = 0;        ///< of the baseline
  std::map<std::string, std::string> textA, textB;
  double milliseconds = 0;
};

/// JSON as files have it; text that is no UTF-8 is made so.
std::string jsonText(const nlohmann::ordered_json& json);

/// All about one pair. The other reports are made of this, so that what a test has recorded is
/// reported as what has just been compared.
nlohmann::ordered_json diffJson(const DiffEntry& entry, const CompareOptions& options);

/// What a person reads, in one line.
std::string diffLine(const nlohmann::ordered_json& pair);

/// What the pictures say of colours and orientation and is not followed; empty: nothing.
std::string notFollowedText(const nlohmann::ordered_json& pair);

/// "same", "differs", "no baseline", "missing" or "error".
std::string kindOf(const nlohmann::ordered_json& pair);

/// JUnit's XML, one test case for each pair.
std::string junitXml(const nlohmann::ordered_json& pairs);

/// A summary for a merge request: counts, and a table of what is not the same.
std::string markdownText(const nlohmann::ordered_json& report);

/// Says that the pictures were drawn by different drivers, if they say so.
std::string driverNote(const DiffEntry& entry);

}  // namespace glint
