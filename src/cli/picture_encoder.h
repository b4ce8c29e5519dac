#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "glint/image/picture_writer.h"
#include "render_report.h"

namespace glint {

/// A picture on its way from the renderer to its file.
struct OutgoingPicture {
  std::unique_ptr<PictureWriter> writer;
  std::function<std::size_t()> whole;  ///< instead of a writer: writes all, returns its NaN pixels
  double encodeTime = 0;               ///< ms
  std::string error;                   ///< filled in by the encoder
};

/// Encodes and writes pictures in a thread of its own, in order, so that the next rows and pictures
/// can be drawn meanwhile. At most a few bands wait.
class PictureEncoder {
 public:
  PictureEncoder();
  /// Completes the work that is waiting.
  ~PictureEncoder();
  PictureEncoder(const PictureEncoder&) = delete;
  PictureEncoder& operator=(const PictureEncoder&) = delete;

  /// An image to draw rows into; reuses memory if possible.
  Image takeImage();
  /// Writes the rows and keeps the image for takeImage(). False if the picture has failed and needs
  /// no more rows.
  bool write(const std::shared_ptr<OutgoingPicture>& picture, Image rows);
  /// Runs a task after all earlier work.
  void then(std::function<void()> task);
  /// Waits until everything is done. Throws what a task has thrown.
  void finish();

 private:
  void add(std::function<void()> task);
  void work();

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::vector<Image> images_;
  std::exception_ptr failure_;
  bool busy_ = false, ended_ = false;
  std::thread thread_;
};

}  // namespace glint
