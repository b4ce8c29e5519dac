#include <cstdio>
// jpeglib.h needs FILE declared before it.
#include <jpeglib.h>

#include <csetjmp>
#include <exception>
#include <span>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/format_writers.h"
#include "glint/image/srgb.h"

// As in jpeg_decoder.cpp, libjpeg exits on errors by longjmp, into small functions that hold no
// object with a destructor.

namespace glint::detail {
namespace {

/// From this quality up, chroma has the full resolution of luma (4:4:4); below, half of it (4:2:0).
constexpr int fullColorQuality = 90;

struct JpegMaker {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_destination_mgr target{};
  std::jmp_buf failed{};
  char message[JMSG_LENGTH_MAX] = "";
  OutputFile* file = nullptr;
  std::exception_ptr writeError;
  std::vector<JOCTET> buffer = std::vector<JOCTET>(std::size_t(1) << 16);

  JpegMaker() = default;
  JpegMaker(const JpegMaker&) = delete;
  JpegMaker& operator=(const JpegMaker&) = delete;
  ~JpegMaker() { jpeg_destroy_compress(&info); }
};

JpegMaker& makerOf(void* clientData) { return *static_cast<JpegMaker*>(clientData); }

[[noreturn]] void onWriteError(j_common_ptr info) {
  JpegMaker& maker = makerOf(info->client_data);
  info->err->format_message(info, maker.message);
  std::longjmp(maker.failed, 1);
}

void ignoreMessage(j_common_ptr) {}

/// Exceptions must not pass through the library.
bool put(JpegMaker& maker, std::size_t count) {
  try {
    maker.file->write(std::as_bytes(std::span(maker.buffer.data(), count)));
    return true;
  } catch (...) {
    maker.writeError = std::current_exception();
    return false;
  }
}

void emptyBuffer(JpegMaker& maker) {
  maker.target.next_output_byte = maker.buffer.data();
  maker.target.free_in_buffer = maker.buffer.size();
}

void onBegin(j_compress_ptr info) { emptyBuffer(makerOf(info->client_data)); }

boolean onFull(j_compress_ptr info) {
  JpegMaker& maker = makerOf(info->client_data);
  if (!put(maker, maker.buffer.size())) std::longjmp(maker.failed, 1);
  emptyBuffer(maker);
  return TRUE;
}

void onEnd(j_compress_ptr info) {
  JpegMaker& maker = makerOf(info->client_data);
  if (!put(maker, maker.buffer.size() - maker.target.free_in_buffer)) std::longjmp(maker.failed, 1);
}

/// Returns false on an error and keeps a message or an exception; likewise below.
bool begin(JpegMaker& maker, int width, int height, int quality) {
  if (setjmp(maker.failed) != 0) return false;
  maker.info.err = jpeg_std_error(&maker.errors);
  maker.errors.error_exit = onWriteError;
  maker.errors.output_message = ignoreMessage;
  maker.info.client_data = &maker;
  jpeg_create_compress(&maker.info);
  maker.target.init_destination = onBegin;
  maker.target.empty_output_buffer = onFull;
  maker.target.term_destination = onEnd;
  maker.info.dest = &maker.target;
  maker.info.image_width = static_cast<JDIMENSION>(width);
  maker.info.image_height = static_cast<JDIMENSION>(height);
  maker.info.input_components = 3;
  maker.info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&maker.info);
  jpeg_set_quality(&maker.info, quality, TRUE);
  maker.info.optimize_coding = TRUE;
  if (quality >= fullColorQuality)
    maker.info.comp_info[0].h_samp_factor = maker.info.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&maker.info, TRUE);
  return true;
}

bool putRow(JpegMaker& maker, unsigned char* rgb) {
  if (setjmp(maker.failed) != 0) return false;
  jpeg_write_scanlines(&maker.info, &rgb, 1);
  return true;
}

bool end(JpegMaker& maker) {
  if (setjmp(maker.failed) != 0) return false;
  jpeg_finish_compress(&maker.info);
  return true;
}

class JpegWriter : public PictureWriter {
 public:
  JpegWriter(const std::string& path, int width, int height, const PictureOptions& options)
      : PictureWriter(path, width, height), options_(options), file_(path) {
    maker_.file = &file_;
    check(begin(maker_, width, height, options.quality));
  }

 private:
  void writeRows(const Image& rows) override {
    row_.resize(std::size_t(3) * width_);
    for (int y = 0; y < rows.height; ++y) {
      nanPixels_ +=
          encodeSrgb8Opaque(rows.row(y), std::size_t(width_), options_.exposureScale, row_.data());
      check(putRow(maker_, row_.data()));
    }
  }

  void finishFile() override {
    check(end(maker_));
    file_.commit();
  }

  void check(bool done) const {
    if (done) return;
    if (maker_.writeError) std::rethrow_exception(maker_.writeError);
    throw Error(printablePath(path_) + ": the JPEG cannot be made: " + maker_.message);
  }

  PictureOptions options_;
  OutputFile file_;
  JpegMaker maker_;
  std::vector<std::uint8_t> row_;
};

}  // namespace

std::unique_ptr<PictureWriter> openJpeg(const std::string& path, int width, int height,
                                        const PictureOptions& options) {
  checkFormatSides(path, width, height, JPEG_MAX_DIMENSION, "JPEG");
  return std::make_unique<JpegWriter>(path, width, height, options);
}

}  // namespace glint::detail
