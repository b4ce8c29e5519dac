#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "glint/image/compare.h"

namespace glint {

/// One pair of pictures and how it went.
struct DiffEntry {
  std::string name;   ///< of the pair; for a folder the path in it
  std::string a, b;   ///< paths; empty if missing
  int status = 0;     ///< an exit status
  std::string error;  ///< why it could not be compared
  std::string note;   ///< what else is to be said
  bool readableB = false, updated = false, acrossDrivers = false;
  Comparison result;
  int width = 0, height = 0;
  std::map<std::string, std::string> textA, textB;
  double milliseconds = 0;
};

/// JSON as files have it; text that is no UTF-8 is made so.
std::string jsonText(const nlohmann::ordered_json& json);

nlohmann::ordered_json diffJson(const DiffEntry& entry, const CompareOptions& options);

/// What a person reads, in one line.
std::string diffLine(const DiffEntry& entry);

/// JUnit's XML, one test case for each entry.
std::string junitXml(const std::vector<DiffEntry>& entries);

/// Notes that the pictures were drawn by different drivers, if they say so.
std::string driverNote(const DiffEntry& entry);

}  // namespace glint
