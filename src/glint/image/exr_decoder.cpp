#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgbaFile.h>

#include <algorithm>
#include <cstring>
#include <mutex>

#include "glint/image/decoders.h"
#include "glint/image/exr_header.h"
#include "glint/image/exr_layers.h"

namespace glint::detail {
namespace {

/// Presents the file in memory as a stream to the library.
class MemoryStream : public Imf::IStream {
 public:
  explicit MemoryStream(std::span<const std::byte> bytes) : IStream("picture"), bytes_(bytes) {}

  bool read(char* out, int count) override {
    if (count < 0 || at_ > bytes_.size() || bytes_.size() - at_ < std::uint64_t(count))
      throw Error("the end is missing");
    if (count > 0) std::memcpy(out, bytes_.data() + at_, std::size_t(count));
    at_ += std::uint64_t(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t at_ = 0;
};

class ExrReader {
 public:
  ExrReader(std::span<const std::byte> bytes, const std::string& name)
      : bytes_(bytes), name_(name), stream_(bytes), file_(stream_, 0) {}

  std::map<std::string, std::string> text() const { return textOf(file_.header(0)); }

  StoredImage read(const std::string& wanted) {
    const std::vector<ExrLayer> layers = exrLayersOf(file_);
    const ExrLayer* const layer = find(layers, wanted);
    if (!layer) refuse(layers, wanted);
    if (layer->deep)
      throw InputError(printablePath(name_) + ": deep pixels: flatten the picture first");
    PictureLayers read;
    readTogether({layer}, read);
    return std::move(read.layers[0].image);
  }

  PictureLayers readAll(const std::string& wanted) {
    const std::vector<ExrLayer> layers = exrLayersOf(file_);
    PictureLayers read;
    read.named = true;
    std::vector<const ExrLayer*> chosen;
    std::uint64_t values = 0;
    const ExrLayer* const main = find(layers, "");
    for (const ExrLayer& layer : layers) {
      // A layer of the file may itself be named "all" or "main".
      const bool isWanted =
          layer.isOf(wanted) || wanted == "all" || (wanted == "main" && &layer == main);
      if (!isWanted) {
        if (wanted == "main") read.skipped.push_back("layer " + printablePath(layer.name));
        continue;
      }
      if (layer.deep) {
        const std::string what = "the deep layer " + printablePath(layer.name);
        if (std::find(read.skipped.begin(), read.skipped.end(), what) == read.skipped.end())
          read.skipped.push_back(what);
        continue;
      }
      chosen.push_back(&layer);
      const Imath::Box2i& box = file_.header(layer.part).displayWindow();
      values += std::uint64_t(std::int64_t(box.max.x) - box.min.x + 1) *
                std::uint64_t(std::int64_t(box.max.y) - box.min.y + 1) * (layer.isGrey() ? 1 : 4);
    }
    if (chosen.empty()) refuse(layers, wanted == "all" ? "" : wanted);
    if (values > maxValues)
      throw InputError(
          printablePath(name_) + ": " + std::to_string(chosen.size()) +
          " layers of that size are too many to compare at once: choose one (--layer)");
    // The main picture first, then part by part, decoding each part once.
    std::stable_partition(chosen.begin(), chosen.end(), [&](auto* one) { return one == main; });
    for (std::size_t i = 0; i < chosen.size();) {
      std::vector<const ExrLayer*> together{chosen[i++]};
      // Chroma is read separately.
      while (!together[0]->chroma && i < chosen.size() && !chosen[i]->chroma &&
             chosen[i]->part == together[0]->part)
        together.push_back(chosen[i++]);
      readTogether(together, read);
    }
    return read;
  }

 private:
  static constexpr std::uint64_t maxValues = std::uint64_t(1) << 29;  // 2 GiB of floats

  /// The layer with a given name, or null. The main picture has no name.
  static const ExrLayer* find(const std::vector<ExrLayer>& layers, const std::string& wanted) {
    if (wanted.empty()) {
      for (const ExrLayer& layer : layers)
        if (layer.part == 0 && layer.colour && layer.prefix.empty()) return &layer;
      return layers.size() == 1 ? &layers[0] : nullptr;
    }
    for (const bool whole : {true, false}) {
      const ExrLayer* found = nullptr;
      for (const ExrLayer& layer : layers) {
        if (whole ? layer.name != wanted && layer.alias != wanted : !layer.isOf(wanted)) continue;
        if (!found) found = &layer;
        if (!whole && found != &layer) return nullptr;  // ambiguous
      }
      if (found) return found;
    }
    return nullptr;
  }

  [[noreturn]] void refuse(const std::vector<ExrLayer>& layers, const std::string& wanted) const {
    std::string names;
    for (const ExrLayer& layer : layers) {
      if (!layer.name.empty()) names += (names.empty() ? "" : ", ") + printablePath(layer.name);
      if (names.size() > 300) break;
    }
    const std::string what = wanted.empty() ? "no main picture in the EXR"
                                            : "no layer '" + printablePath(wanted) + "' in the EXR";
    throw InputError(printablePath(name_) + ": " + what + ": " +
                     (names.empty() ? "it has no named colour layers, either"
                                    : "name one of its layers: " + names));
  }

  void setSizes(const Imf::Header& header) {
    display_ = header.displayWindow();
    data_ = header.dataWindow();
    const auto side = [](int low, int high) { return std::uint64_t(std::int64_t(high) - low + 1); };
    for (const Imath::Box2i& box : {display_, data_})
      checkSize(name_, side(box.min.x, box.max.x), side(box.min.y, box.max.y));
    width_ = display_.max.x - display_.min.x + 1;
    height_ = display_.max.y - display_.min.y + 1;
    const auto pixels = side(data_.min.x, data_.max.x) * side(data_.min.y, data_.max.y);
    // At the very least the file has a chunk header (20 bytes including its offset table entry) per
    // 256 rows, and two bytes a value. Checked before memory is spent on the picture.
    if (pixels * 2 / 16 > bytes_.size() * largestExpansion(header.compression())) cut();
  }

  /// Reads layers of the same part in one pass over it.
  void readTogether(const std::vector<const ExrLayer*>& layers, PictureLayers& read) {
    const Imf::Header& header = file_.header(layers[0]->part);
    setSizes(header);
    std::vector<Target> targets;
    for (const ExrLayer* layer : layers) {
      Target& target = targets.emplace_back();
      target.layer = layer;
      target.channels = !layer->channels[3].empty() || (data_ != display_ && layer->colour) ? 4
                        : layer->isGrey() && !layer->colour                                 ? 1
                                                                                            : 3;
      target.values.resize(std::size_t(target.channels) * width_ * height_);
    }
    if (layers[0]->chroma) {
      readChroma(targets[0]);
    } else {
      readChannels(targets, header);
    }
    for (Target& target : targets) {
      PictureLayer& layer = read.layers.emplace_back();
      layer.name = target.layer->name;
      layer.channels = target.layer->channelNames();
      layer.colour = target.layer->colour;
      layer.image = {width_,         height_, target.channels, std::move(target.values),
                     textOf(header), {}};
      if (hasOtherPrimaries(header))
        layer.image.unfollowed["chromaticities"] = primariesText(header);
      if (target.rounded)
        layer.image.unfollowed["whole numbers above 16777216"] = "compared as 32-bit floats";
    }
  }

  struct Target {
    const ExrLayer* layer = nullptr;
    int channels = 4;
    std::vector<float> values;
    bool rounded = false;
  };

  /// Calls use(y, x, count) with the columns of each data row that lie in the display window.
  template <class Use>
  void overlap(Use use) const {
    const int left = std::max(display_.min.x, data_.min.x);
    const int right = std::min(display_.max.x, data_.max.x);
    if (left > right) return;
    for (int y = std::max(display_.min.y, data_.min.y); y <= std::min(display_.max.y, data_.max.y);
         ++y)
      use(y, left, right - left + 1);
  }

  float* at(Target& target, int x, int y) const {
    return target.values.data() +
           std::size_t(target.channels) *
               (std::size_t(y - display_.min.y) * width_ + std::size_t(x - display_.min.x));
  }

  /// Reads all rows of the data window, a few at a time.
  void readChannels(std::vector<Target>& targets, const Imf::Header& header) {
    std::vector<std::string> names;  // each once: the library refuses duplicates
    for (const Target& target : targets) {
      for (const std::string& name : target.layer->channelNames()) {
        const Imf::Channel* const kind = header.channels().findChannel(name);
        if (kind->xSampling != 1 || kind->ySampling != 1) {
          throw InputError(printablePath(name_) + ": the channel " + printablePath(name) +
                           " is subsampled: save it at full resolution");
        }
        names.push_back(name);
      }
    }
    Imf::InputPart part(file_, targets[0].layer->part);
    const std::size_t width = std::size_t(data_.max.x) - data_.min.x + 1;
    constexpr int pieceRows = 64;
    const std::size_t plane = width * pieceRows;
    std::vector<float> rows(names.size() * plane);
    for (int first = data_.min.y; first <= data_.max.y; first += pieceRows) {
      const int last = std::min(data_.max.y, first + pieceRows - 1);
      Imf::FrameBuffer frame;
      for (std::size_t i = 0; i < names.size(); ++i) {
        frame.insert(names[i],
                     Imf::Slice::Make(Imf::FLOAT, &rows[i * plane],
                                      Imath::Box2i({data_.min.x, first}, {data_.max.x, last}),
                                      sizeof(float), sizeof(float) * width));
      }
      part.setFrameBuffer(frame);
      part.readPixels(first, last);
      for (Target& target : targets) {
        const float* planes[4] = {};
        for (std::size_t c = 0; c < 4; ++c) {
          const auto found = std::find(names.begin(), names.end(), target.layer->channels[c]);
          if (found != names.end()) planes[c] = &rows[std::size_t(found - names.begin()) * plane];
        }
        const Imf::Channel* const kind = header.channels().findChannel(target.layer->channels[0]);
        const bool whole = kind && kind->type == Imf::UINT;
        overlap([&](int y, int x, int count) {
          if (y < first || y > last) return;
          const std::size_t from = width * std::size_t(y - first) + std::size_t(x - data_.min.x);
          float* out = at(target, x, y);
          for (std::size_t i = from; i < from + std::size_t(count); ++i) {
            for (int c = 0; c < target.channels; ++c)
              *out++ = planes[c] ? planes[c][i] : c == 3 ? 1 : 0;
            target.rounded = target.rounded || (whole && out[-1] > 16777216);
          }
        });
      }
    }
  }

  /// Reads luminance and chroma, which the library converts to RGB in half floats.
  void readChroma(Target& target) {
    if (target.layer->part != 0) {
      throw InputError(printablePath(name_) +
                       ": luminance and chroma in a part that is not the first: save it as RGB");
    }
    MemoryStream stream(bytes_);
    std::string name = target.layer->prefix;
    if (!name.empty()) name.pop_back();
    Imf::RgbaInputFile file(stream, name, 0);
    std::vector<Imf::Rgba> row(std::size_t(data_.max.x - data_.min.x) + 1);
    for (int y = data_.min.y; y <= data_.max.y; ++y) {
      file.setFrameBuffer(row.data() - data_.min.x, 1, 0);
      file.readPixels(y);
      overlap([&](int wanted, int x, int count) {
        if (wanted != y) return;
        float* out = at(target, x, y);
        for (int i = 0; i < count; ++i, out += target.channels) {
          const Imf::Rgba& in = row[std::size_t(x - data_.min.x + i)];
          out[0] = in.r;
          out[1] = in.g;
          out[2] = in.b;
          if (target.channels == 4) out[3] = in.a;
        }
      });
    }
  }

  [[noreturn]] void cut() const { throw damaged(name_, "the EXR is truncated"); }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  MemoryStream stream_;
  Imf::MultiPartInputFile file_;
  Imath::Box2i display_, data_;
  int width_ = 0, height_ = 0;
};

/// The library's message in one line, without its paths and advice.
std::string firstLine(std::string text) {
  text = printablePath(text.substr(0, text.find('\n')));
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text.substr(0, 200);
}

}  // namespace

bool isExr(std::span<const std::byte> bytes) {
  constexpr unsigned char magic[4] = {0x76, 0x2f, 0x31, 0x01};
  return bytes.size() >= 4 && std::memcmp(bytes.data(), magic, 4) == 0;
}

namespace {

/// Runs `read` and converts the library's errors to ours.
template <class Read>
auto guarded(std::span<const std::byte> bytes, const std::string& name, Read read) {
  if (!attributesFit(bytes)) throw damaged(name, "the EXR is truncated");
  static std::once_flag once;
  std::call_once(once, [] {
    Imf::Header::setMaxImageSize(maxSide, maxSide);
    Imf::Header::setMaxTileSize(maxSide, maxSide);
  });
  try {
    return read();
  } catch (const Error& error) {
    if (dynamic_cast<const InputError*>(&error)) throw;
    throw damaged(name, std::string("the EXR is damaged (") + error.what() + ")");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw damaged(name, "the EXR is damaged (" + firstLine(error.what()) + ")");
  }
}

}  // namespace

StoredImage decodeExr(std::span<const std::byte> bytes, const std::string& name,
                      const std::string& layer) {
  return guarded(bytes, name, [&] { return ExrReader(bytes, name).read(layer); });
}

PictureLayers decodeExrLayers(std::span<const std::byte> bytes, const std::string& name,
                              const std::string& wanted) {
  return guarded(bytes, name, [&] { return ExrReader(bytes, name).readAll(wanted); });
}

std::map<std::string, std::string> exrText(std::span<const std::byte> bytes,
                                           const std::string& name) {
  return guarded(bytes, name, [&] { return ExrReader(bytes, name).text(); });
}

}  // namespace glint::detail
