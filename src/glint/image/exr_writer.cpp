#include "glint/image/exr_writer.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/format_writers.h"

namespace glint {
namespace {

/// Presents an OutputFile as a stream to the library. Small writes are buffered until it seeks.
class FileStream : public Imf::OStream {
 public:
  explicit FileStream(const std::string& path) : OStream("picture"), file_(path) {}

  void write(const char* bytes, int count) override {
    pending_.insert(pending_.end(), bytes, bytes + count);
    if (pending_.size() > std::size_t(1) << 20) flush();
  }
  std::uint64_t tellp() override { return begin_ + pending_.size(); }
  void seekp(std::uint64_t at) override {
    flush();
    begin_ = at;
  }
  void commit() {
    flush();
    file_.commit();
  }

 private:
  void flush() {
    file_.writeAt(begin_, std::as_bytes(std::span(pending_)));
    begin_ += pending_.size();
    pending_.clear();
  }

  OutputFile file_;
  std::vector<char> pending_;
  std::uint64_t begin_ = 0;
};

template <class Text>
Imf::Header headerOf(const std::string& path, int width, int height, const Text& text) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  // As with PNG, a higher level takes several times as long to save a few per cent.
  header.zipCompressionLevel() = 1;
  for (const auto& [name, value] : text) {
    const bool own = header.find(name) != header.end() || name == "name" || name == "type";
    if (name.empty() || name.size() > 79 || own) {
      throw Error(printablePath(path) + ": '" + printablePath(name) +
                  "' cannot be the name of an EXR's text: give another one of 1 to 79 characters");
    }
    header.insert(name, Imf::StringAttribute(value));
  }
  return header;
}

/// Runs `write` and converts the library's errors to ours.
template <class Write>
void withSentence(const std::string& path, Write write) {
  try {
    write();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    const std::string text = error.what();
    throw Error(printablePath(path) +
                ": the EXR cannot be made: " + printablePath(text.substr(0, text.find('\n'))));
  }
}

/// A slice that maps channel `c` of the rows from `first` on to interleaved RGBA.
Imf::Slice slice(const float* rgba, std::size_t c, int width, int first) {
  const auto stride = std::size_t(4) * sizeof(float) * std::size_t(width);
  auto* base = const_cast<char*>(reinterpret_cast<const char*>(rgba + c));
  return {Imf::FLOAT, base - std::ptrdiff_t(stride) * first, 4 * sizeof(float), stride};
}

class ExrWriter : public PictureWriter {
 public:
  ExrWriter(const std::string& path, int width, int height, const PictureOptions& options)
      : PictureWriter(path, width, height), stream_(path) {
    channels_ = options.alpha ? 4 : 3;
    withSentence(path_, [&] {
      Imf::Header header = headerOf(path, width, height, options.text);
      for (std::size_t c = 0; c < channels_; ++c)
        header.channels().insert(std::string(1, "RGBA"[c]), Imf::Channel(Imf::FLOAT));
      file_ = std::make_unique<Imf::OutputFile>(stream_, header, 0);
    });
  }

 private:
  void writeRows(const Image& rows) override {
    const std::size_t pixels = std::size_t(rows.width) * rows.height;
    for (std::size_t i = 0; i < pixels; ++i) {
      bool nan = false;
      for (std::size_t c = 0; c < channels_; ++c) nan = nan || std::isnan(rows.values[4 * i + c]);
      nanPixels_ += nan;
    }
    withSentence(path_, [&] {
      Imf::FrameBuffer frame;
      for (std::size_t c = 0; c < channels_; ++c)
        frame.insert(std::string(1, "RGBA"[c]), slice(rows.values.data(), c, width_, rowsWritten_));
      file_->setFrameBuffer(frame);
      file_->writePixels(rows.height);
    });
  }

  void finishFile() override {
    withSentence(path_, [&] {
      file_.reset();  // writes the chunk offset table
      stream_.commit();
    });
  }

  FileStream stream_;
  std::unique_ptr<Imf::OutputFile> file_;
  std::size_t channels_;
};

}  // namespace

std::unique_ptr<PictureWriter> detail::openExr(const std::string& path, int width, int height,
                                               const PictureOptions& options) {
  return std::make_unique<ExrWriter>(path, width, height, options);
}

void writeExr(const std::string& path, std::span<const ExrLayer> layers,
              const std::map<std::string, std::string>& text) {
  if (layers.empty()) throw Error(printablePath(path) + ": an EXR without layers");
  const int width = layers[0].pixels->width, height = layers[0].pixels->height;
  withSentence(path, [&] {
    Imf::Header header = headerOf(path, width, height, text);
    Imf::FrameBuffer frame;
    for (const ExrLayer& layer : layers) {
      const Image& image = *layer.pixels;
      const std::size_t channels = layer.words.empty() ? layer.channels.size() : layer.words.size();
      if (image.width != width || image.height != height || channels > 4 ||
          image.values.size() != std::size_t(4) * width * height) {
        throw Error(printablePath(path) + ": the layer '" + printablePath(layer.name) +
                    "' does not fit the others");
      }
      for (std::size_t c = 0; c < channels; ++c) {
        const std::string name =
            (layer.name.empty() ? "" : layer.name + ".") +
            (layer.words.empty() ? std::string(1, layer.channels[c]) : layer.words[c]);
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        frame.insert(name, slice(image.values.data(), c, width, 0));
      }
    }
    FileStream stream(path);
    {
      Imf::OutputFile file(stream, header, 0);
      file.setFrameBuffer(frame);
      file.writePixels(height);
    }
    stream.commit();
  });
}

}  // namespace glint
