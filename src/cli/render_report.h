#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "glint/gl/context.h"
#include "glint/image/file.h"
#include "render_options.h"
#include "status_line.h"

namespace glint {

/// The result of a picture.
struct PictureResult {
  nlohmann::ordered_json entry;       ///< everything except warnings and error
  std::vector<std::string> warnings;  ///< also added to the entry
  std::vector<std::string> news;      ///< those to print
  std::string error;                  ///< to print; empty if none
  bool errorIsNew = true;
};

/// Reports a run: warnings and errors on stderr, the JSON of --json as pictures are completed, for
/// a list one line of JSON per picture on stdout, and the progress. `add` may be called by only one
/// thread at a time.
class RenderReport {
 public:
  RenderReport(const RenderOptions& options, StatusLine& line);

  void begin(const std::string& backend, const std::optional<GlStrings>& gl);
  /// The total number of pictures, if known.
  void expect(std::optional<std::size_t> pictures) { expected_ = pictures; }
  void add(PictureResult result);
  void finish();

  std::size_t done() const { return done_; }
  /// The worst status of the pictures, in the order 2, 1, 4, 0.
  int status() const;

 private:
  const RenderOptions& options_;
  StatusLine& line_;
  std::unique_ptr<OutputFile> file_;
  std::optional<std::size_t> expected_;
  std::size_t done_ = 0, skipped_ = 0;
  bool failed_ = false, differs_ = false, noBaseline_ = false;
};

/// "12 of 100 pictures, 3.4 a second, 26 s left".
std::string progressText(std::size_t done, std::size_t skipped, std::optional<std::size_t> all,
                         double seconds);

}  // namespace glint
