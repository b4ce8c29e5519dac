#include <exception>
#include <new>
#include <span>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/format_writers.h"
#include "glint/image/srgb.h"

#if GLINT_WEBP
#include <webp/encode.h>
#endif

namespace glint::detail {

#if GLINT_WEBP
namespace {

/// Keeps the codes of the whole picture, since the library needs them all at once.
class WebpWriter : public PictureWriter {
 public:
  WebpWriter(const std::string& path, int width, int height, const PictureOptions& options)
      : PictureWriter(path, width, height), options_(options), file_(path) {
    codes_.resize(channels() * std::size_t(width) * std::size_t(height));
  }

 private:
  std::size_t channels() const { return options_.alpha ? 4 : 3; }

  void writeRows(const Image& rows) override {
    const std::size_t pixels = std::size_t(rows.width) * rows.height;
    std::uint8_t* const out = codes_.data() + channels() * std::size_t(width_) * rowsWritten_;
    const float scale = options_.exposureScale;
    nanPixels_ += options_.alpha ? encodeSrgb8(rows.values.data(), pixels, scale, out)
                                 : encodeSrgb8Opaque(rows.values.data(), pixels, scale, out);
  }

  void finishFile() override {
    WebPConfig config;
    if (!WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, float(options_.quality))) fail(nullptr);
    config.lossless = options_.quality == 100;
    struct Held : WebPPicture {
      ~Held() { WebPPictureFree(this); }
    } picture;
    if (!WebPPictureInit(&picture)) fail(nullptr);
    picture.width = width_;
    picture.height = height_;
    picture.use_argb = config.lossless;
    picture.writer = take;
    picture.custom_ptr = this;
    const int stride = int(channels()) * width_;
    if (!(options_.alpha ? WebPPictureImportRGBA(&picture, codes_.data(), stride)
                         : WebPPictureImportRGB(&picture, codes_.data(), stride)) ||
        !WebPEncode(&config, &picture))
      fail(&picture);
    file_.commit();
  }

  /// The library's output callback; exceptions must not pass through the library.
  static int take(const std::uint8_t* bytes, std::size_t count, const WebPPicture* picture) {
    auto* self = static_cast<WebpWriter*>(picture->custom_ptr);
    try {
      self->file_.write(std::as_bytes(std::span(bytes, count)));
      return 1;
    } catch (...) {
      self->writeError_ = std::current_exception();
      return 0;
    }
  }

  [[noreturn]] void fail(const WebPPicture* picture) const {
    if (writeError_) std::rethrow_exception(writeError_);
    if (picture && (picture->error_code == VP8_ENC_ERROR_OUT_OF_MEMORY ||
                    picture->error_code == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY))
      throw std::bad_alloc();
    throw Error(printablePath(path_) + ": the WebP cannot be made" +
                (picture ? ": libwebp's error " + std::to_string(picture->error_code) : ""));
  }

  PictureOptions options_;
  OutputFile file_;
  std::vector<std::uint8_t> codes_;
  std::exception_ptr writeError_;
};

}  // namespace
#endif

std::unique_ptr<PictureWriter> openWebp(const std::string& path, int width, int height,
                                        const PictureOptions& options) {
#if GLINT_WEBP
  checkFormatSides(path, width, height, WEBP_MAX_DIMENSION, "WebP");
  return std::make_unique<WebpWriter>(path, width, height, options);
#else
  (void)width, (void)height, (void)options;
  throw InputError(printablePath(path) + ": WebP, which this build does not write: use .png");
#endif
}

}  // namespace glint::detail
