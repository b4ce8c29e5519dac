#include <spng.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <new>
#include <span>
#include <thread>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/format_writers.h"
#include "glint/image/srgb.h"
#include "glint/image/task.h"

namespace glint::detail {
namespace {

// The cost of filters and levels for 1024 x 1024 RGB on one thread (ms, kB): a Phong-shaded sphere
// with a noisy quarter on a flat background, and the same sphere textured and noisy all over.
// 16-bit: the first picture. Shading quantised to 8 bits has equal neighbours, which filters break
// up; the lower bytes of 16 bits are noise unless the row above is subtracted.
//
//     filter level   smooth      textured     16-bit
//     none   1       12.5  335   22.6   980   67.3  3124   <- 8 bits
//     none   2       12.6  318   24.4   962   68.4  3114
//     none   4       17.6  263   34.9   945
//     none   6       29.8  224
//     sub    1       17.4  394   24.1   887   55.8  1896
//     up     1       16.8  373   24.3   897   53.5  1712   <- 16 bits
//     up     6       74.5  277
//     best of all, 1 41.4  360   50.3   883  117.2  1931
constexpr int compressionLevel = 1;
constexpr int filterOf8Bits = SPNG_FILTER_CHOICE_NONE;
constexpr int filterOf16Bits = SPNG_FILTER_CHOICE_UP;

constexpr int blockRows = 32;
constexpr std::size_t blockCount = 3;  // one being encoded, one being deflated, one waiting

using Block = std::vector<std::uint16_t>;  // codes of either depth, whole rows

/// Encodes to sRGB in the caller's thread; deflates and writes in its own thread, so that the next
/// rows can be drawn meanwhile. The caller's thread spends 2.3 of the 15 ms of processor time that
/// a 1024 x 1024 picture takes.
class PngWriter : public PictureWriter {
 public:
  PngWriter(const std::string& path, int width, int height, const PictureOptions& options)
      : PictureWriter(path, width, height),
        options_(options),
        rowBytes_(std::size_t(width) * (options.alpha ? 4 : 3) * (options.bitDepth / 8)),
        file_(path),
        png_(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free),
        free_(blockCount) {
    start();
    deflater_ = startThread([this] { deflate(); });
  }

  ~PngWriter() override { end(true); }

 private:
  struct Rows {
    Block codes;
    int count;
  };

  void start() {
    if (!png_) throw std::bad_alloc();
    check(spng_set_png_stream(png_.get(), &PngWriter::take, this));
    spng_ihdr header{};
    header.width = static_cast<std::uint32_t>(width_);
    header.height = static_cast<std::uint32_t>(height_);
    header.bit_depth = static_cast<std::uint8_t>(options_.bitDepth);
    header.color_type =
        options_.alpha ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR;
    check(spng_set_ihdr(png_.get(), &header));
    check(spng_set_srgb(png_.get(), 0));  // perceptual
    setText();
    check(spng_set_option(png_.get(), SPNG_IMG_COMPRESSION_LEVEL, compressionLevel));
    check(spng_set_option(png_.get(), SPNG_FILTER_CHOICE,
                          options_.bitDepth == 8 ? filterOf8Bits : filterOf16Bits));
    check(spng_encode_image(png_.get(), nullptr, 0, SPNG_FMT_PNG,
                            SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE));
  }

  void setText() {
    std::vector<spng_text> chunks;
    for (auto& [keyword, text] : options_.text) {
      spng_text chunk{};
      if (keyword.empty() || keyword.size() >= sizeof chunk.keyword) {
        throw Error("a PNG keyword of " + std::to_string(keyword.size()) +
                    " characters: give 1 to 79");
      }
      keyword.copy(chunk.keyword, keyword.size());
      const bool ascii = std::all_of(text.begin(), text.end(), [](char letter) {
        return static_cast<signed char>(letter) >= 0;
      });
      chunk.type = ascii ? SPNG_TEXT : SPNG_ITXT;
      chunk.text = text.data();
      chunk.length = text.size();
      chunk.language_tag = chunk.translated_keyword = empty_;
      chunks.push_back(chunk);
    }
    if (chunks.empty()) return;
    check(spng_set_text(png_.get(), chunks.data(), static_cast<std::uint32_t>(chunks.size())));
  }

  void writeRows(const Image& rows) override {
    for (int first = 0; first < rows.height; first += blockRows) {
      Rows block{takeFree(), std::min(blockRows, rows.height - first)};
      block.codes.resize((rowBytes_ * block.count + 1) / 2);
      nanPixels_ += encode(rows.row(first), std::size_t(width_) * block.count, block.codes.data());
      if (!deflater_.joinable()) {
        deflateRows(block);
        free_.push_back(std::move(block.codes));
        continue;
      }
      const std::lock_guard lock(mutex_);
      full_.push_back(std::move(block));
      changed_.notify_all();
    }
  }

  std::size_t encode(const float* rgba, std::size_t pixels, std::uint16_t* codes) const {
    const float scale = options_.exposureScale;
    auto* bytes = reinterpret_cast<std::uint8_t*>(codes);
    if (options_.bitDepth == 8) {
      return options_.alpha ? encodeSrgb8(rgba, pixels, scale, bytes)
                            : encodeSrgb8Opaque(rgba, pixels, scale, bytes);
    }
    return options_.alpha ? encodeSrgb16(rgba, pixels, scale, codes)
                          : encodeSrgb16Opaque(rgba, pixels, scale, codes);
  }

  void finishFile() override {
    end(false);
    if (error_) std::rethrow_exception(error_);
    file_.commit();
  }

  Block takeFree() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !free_.empty(); });
    if (error_) std::rethrow_exception(error_);
    Block block = std::move(free_.back());
    free_.pop_back();
    return block;
  }

  void end(bool abandon) {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      if (abandon) full_.clear();
      changed_.notify_all();
    }
    if (deflater_.joinable()) deflater_.join();
  }

  /// Runs in the deflating thread. After an error it only returns the blocks.
  void deflate() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return ended_ || !full_.empty(); });
      if (full_.empty()) return;
      Rows rows = std::move(full_.front());
      full_.pop_front();
      if (!error_) {
        lock.unlock();
        std::exception_ptr error;
        try {
          deflateRows(rows);
        } catch (...) {
          error = std::current_exception();
        }
        lock.lock();
        error_ = error;
      }
      free_.push_back(std::move(rows.codes));
      changed_.notify_all();
    }
  }

  void deflateRows(const Rows& rows) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(rows.codes.data());
    for (int y = 0; y < rows.count; ++y) {
      const int status = spng_encode_row(png_.get(), bytes + rowBytes_ * y, rowBytes_);
      if (status != SPNG_EOI) check(status);  // the last row gives SPNG_EOI
    }
  }

  /// The library's output callback; exceptions must not pass through the library.
  static int take(spng_ctx*, void* user, void* bytes, std::size_t length) {
    auto* self = static_cast<PngWriter*>(user);
    try {
      self->file_.write({static_cast<const std::byte*>(bytes), length});
      return 0;
    } catch (...) {
      self->writeError_ = std::current_exception();
      return SPNG_IO_ERROR;
    }
  }

  void check(int status) const {
    if (status == 0) return;
    if (writeError_) std::rethrow_exception(writeError_);
    throw Error(printablePath(path_) + ": the PNG cannot be made: " + spng_strerror(status));
  }

  PictureOptions options_;  ///< owns the texts, which the library refers to
  char empty_[1] = "";
  const std::size_t rowBytes_;
  OutputFile file_;
  std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> png_;
  std::exception_ptr writeError_;

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::deque<Rows> full_;
  std::vector<Block> free_;
  std::exception_ptr error_;
  bool ended_ = false;
  std::thread deflater_;
};

}  // namespace

std::unique_ptr<PictureWriter> openPng(const std::string& path, int width, int height,
                                       const PictureOptions& options) {
  return std::make_unique<PngWriter>(path, width, height, options);
}

}  // namespace glint::detail
