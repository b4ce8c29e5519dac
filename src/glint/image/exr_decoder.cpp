#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <optional>

#include "glint/image/decoders.h"

namespace glint::detail {
namespace {

/// The file in memory, as the library reads it.
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

/// One layer: where its channels are.
struct Layer {
  int part = 0;
  std::string prefix;  ///< of the channel names, with the dot
  /// Names of the channels of R, G, B and A; empty is none. Grey has one name three times.
  std::array<std::string, 4> channels;
  bool chroma = false;  ///< Y, RY, BY
};

using Channels = std::vector<std::pair<std::string, Imf::Channel>>;

/// The channels whose names are `prefix` and one more word.
Channels channelsOf(const Imf::Header& header, const std::string& prefix) {
  Channels found;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    const std::string name = i.name();
    if (name.starts_with(prefix) && name.find('.', prefix.size()) == std::string::npos)
      found.emplace_back(name.substr(prefix.size()), i.channel());
  }
  return found;
}

/// Which of the channels make the colour; nothing if they make none.
std::optional<Layer> colourOf(const Channels& channels, const std::string& prefix) {
  const auto has = [&](const char* name) {
    return std::any_of(channels.begin(), channels.end(),
                       [&](const auto& channel) { return channel.first == name; });
  };
  Layer layer;
  layer.prefix = prefix;
  layer.chroma = has("Y") && has("RY") && has("BY");
  if (has("R") || has("G") || has("B")) {
    for (const int c : {0, 1, 2}) {
      const char* const name = c == 0 ? "R" : c == 1 ? "G" : "B";
      if (has(name)) layer.channels[std::size_t(c)] = prefix + name;
    }
  } else {
    std::string grey;
    int others = 0;
    for (const auto& [name, channel] : channels) {
      if (name == "A" || name == "RY" || name == "BY") continue;
      grey = name;
      ++others;
    }
    if (has("Y")) grey = "Y";
    if (grey.empty() || (others > 1 && grey != "Y")) return std::nullopt;
    std::fill_n(layer.channels.begin(), 3, prefix + grey);
  }
  if (has("A")) layer.channels[3] = prefix + "A";
  return layer;
}

/// Layers by name: parts, prefixes of channels, and prefixes within a named part ("part.prefix").
std::map<std::string, Layer> layersOf(const Imf::MultiPartInputFile& file) {
  std::map<std::string, Layer> layers;
  const auto add = [&](const std::string& name, const Imf::Header& header, int part,
                       const std::string& prefix) {
    if (auto layer = colourOf(channelsOf(header, prefix), prefix)) {
      layer->part = part;
      layers.emplace(name, *layer);
    }
  };
  for (int part = 0; part < file.parts(); ++part) {
    const Imf::Header& header = file.header(part);
    const std::string partName = header.hasName() ? header.name() : "";
    if (part == 0) add("", header, part, "");
    if (!partName.empty()) add(partName, header, part, "");
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
      const std::string name = i.name();
      const auto dot = name.rfind('.');
      if (dot == std::string::npos) continue;
      const std::string prefix = name.substr(0, dot);
      add(prefix, header, part, prefix + ".");
      if (!partName.empty()) add(partName + "." + prefix, header, part, prefix + ".");
    }
  }
  return layers;
}

/// How many bytes one of the file can become, at most.
std::uint64_t largestExpansion(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
      return 1;
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION:
      return 1032 * 64;  // one deflated coefficient for a block of 8 x 8
    default:
      return 1032;  // deflate's; the others make less
  }
}

std::map<std::string, std::string> textOf(const Imf::Header& header) {
  std::map<std::string, std::string> all;
  for (auto i = header.begin(); i != header.end(); ++i) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
    if (text && std::strcmp(i.name(), "name") != 0 && std::strcmp(i.name(), "type") != 0)
      all[i.name()] = text->value();
  }
  return all;
}

class ExrReader {
 public:
  ExrReader(std::span<const std::byte> bytes, const std::string& name)
      : bytes_(bytes), name_(name), stream_(bytes), file_(stream_, 0) {}

  std::map<std::string, std::string> text() const { return textOf(file_.header(0)); }

  StoredImage read(const std::string& wanted) {
    const Layer layer = find(wanted);
    const Imf::Header& header = file_.header(layer.part);
    if (header.hasType() && Imf::isDeepData(header.type())) {
      throw InputError(printablePath(name_) + ": deep pixels: flatten the picture first");
    }
    setSizes(header);
    image_.text = textOf(header);
    image_.channels = layer.channels[3].empty() && data_ == display_ ? 3 : 4;
    values_.resize(std::size_t(image_.channels) * image_.width * image_.height);
    if (layer.chroma) {
      readChroma(layer);
    } else {
      readChannels(layer, header);
    }
    image_.values = std::move(values_);
    return std::move(image_);
  }

 private:
  Layer find(const std::string& wanted) const {
    const auto layers = layersOf(file_);
    if (const auto found = layers.find(wanted); found != layers.end()) return found->second;
    if (wanted.empty() && layers.size() == 1) return layers.begin()->second;
    std::string names;
    for (const auto& [name, layer] : layers) {
      if (!name.empty()) names += (names.empty() ? "" : ", ") + printablePath(name);
      if (names.size() > 300) break;
    }
    const std::string what = wanted.empty() ? "no main picture in the EXR"
                                            : "no layer '" + printablePath(wanted) + "' in the EXR";
    throw InputError(printablePath(name_) + ": " + what + ": " +
                     (names.empty() ? "it has no colours under a name either"
                                    : "name one of its layers: " + names));
  }

  void setSizes(const Imf::Header& header) {
    display_ = header.displayWindow();
    data_ = header.dataWindow();
    const auto side = [](int low, int high) { return std::uint64_t(std::int64_t(high) - low + 1); };
    for (const Imath::Box2i& box : {display_, data_})
      checkSize(name_, side(box.min.x, box.max.x), side(box.min.y, box.max.y));
    image_.width = display_.max.x - display_.min.x + 1;
    image_.height = display_.max.y - display_.min.y + 1;
    const auto pixels = side(data_.min.x, data_.max.x) * side(data_.min.y, data_.max.y);
    // A chunk's head (20 bytes with its place in the table) for at most 256 rows at the very least,
    // and two bytes a value. Refused before memory is spent on it.
    if (pixels * 2 / 16 > bytes_.size() * largestExpansion(header.compression())) cut();
  }

  /// Calls use(y, x, count): the columns of a data row that lie in the display window.
  template <class Use>
  void overlap(Use use) const {
    const int left = std::max(display_.min.x, data_.min.x);
    const int right = std::min(display_.max.x, data_.max.x);
    if (left > right) return;
    for (int y = std::max(display_.min.y, data_.min.y); y <= std::min(display_.max.y, data_.max.y);
         ++y)
      use(y, left, right - left + 1);
  }

  float* at(int x, int y) {
    return values_.data() +
           std::size_t(image_.channels) *
               (std::size_t(y - display_.min.y) * image_.width + std::size_t(x - display_.min.x));
  }

  /// All rows of the data window, in pieces of a few.
  void readChannels(const Layer& layer, const Imf::Header& header) {
    const Imf::Channel* kinds[4] = {};
    for (std::size_t c = 0; c < 4; ++c) {
      if (layer.channels[c].empty()) continue;
      kinds[c] = header.channels().findChannel(layer.channels[c]);
      if (kinds[c]->xSampling != 1 || kinds[c]->ySampling != 1) {
        throw InputError(printablePath(name_) + ": the channel " +
                         printablePath(layer.channels[c]) +
                         " has fewer samples than pixels: save it with all");
      }
    }
    Imf::InputPart part(file_, layer.part);
    const std::size_t width = std::size_t(data_.max.x) - data_.min.x + 1;
    constexpr int pieceRows = 64;
    std::vector<float> rows(4 * width * pieceRows);
    for (int first = data_.min.y; first <= data_.max.y; first += pieceRows) {
      const int last = std::min(data_.max.y, first + pieceRows - 1);
      Imf::FrameBuffer frame;
      for (std::size_t c = 0; c < 4; ++c) {
        if (!kinds[c]) continue;
        // Grey is read once: the library refuses a channel twice.
        if (c > 0 && c < 3 && layer.channels[c] == layer.channels[0]) continue;
        frame.insert(layer.channels[c],
                     Imf::Slice::Make(Imf::FLOAT, &rows[c],
                                      Imath::Box2i({data_.min.x, first}, {data_.max.x, last}),
                                      4 * sizeof(float), 4 * sizeof(float) * width));
      }
      part.setFrameBuffer(frame);
      part.readPixels(first, last);
      const bool grey = layer.channels[1] == layer.channels[0];
      overlap([&](int y, int x, int count) {
        if (y < first || y > last) return;
        const float* in =
            &rows[4 * (width * std::size_t(y - first) + std::size_t(x - data_.min.x))];
        float* out = at(x, y);
        for (int i = 0; i < count; ++i, in += 4, out += image_.channels) {
          out[0] = kinds[0] ? in[0] : 0;
          out[1] = grey ? out[0] : kinds[1] ? in[1] : 0;
          out[2] = grey ? out[0] : kinds[2] ? in[2] : 0;
          if (image_.channels == 4) out[3] = kinds[3] ? in[3] : 1;
        }
      });
    }
  }

  /// Luminance and chroma, which the library turns into RGB of half floats.
  void readChroma(const Layer& layer) {
    if (layer.part != 0) {
      throw InputError(printablePath(name_) +
                       ": luminance and chroma in a part that is not the first: save it as RGB");
    }
    MemoryStream stream(bytes_);
    std::string name = layer.prefix;
    if (!name.empty()) name.pop_back();
    Imf::RgbaInputFile file(stream, name, 0);
    std::vector<Imf::Rgba> row(std::size_t(data_.max.x - data_.min.x) + 1);
    for (int y = data_.min.y; y <= data_.max.y; ++y) {
      file.setFrameBuffer(row.data() - data_.min.x, 1, 0);
      file.readPixels(y);
      overlap([&](int wanted, int x, int count) {
        if (wanted != y) return;
        float* out = at(x, y);
        for (int i = 0; i < count; ++i, out += image_.channels) {
          const Imf::Rgba& in = row[std::size_t(x - data_.min.x + i)];
          out[0] = in.r;
          out[1] = in.g;
          out[2] = in.b;
          if (image_.channels == 4) out[3] = in.a;
        }
      });
    }
  }

  [[noreturn]] void cut() const { throw damaged(name_, "the EXR is cut short"); }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  MemoryStream stream_;
  Imf::MultiPartInputFile file_;
  Imath::Box2i display_, data_;
  StoredImage image_;
  std::vector<float> values_;
};

/// The library's message in one line of its own words, without its paths and advice.
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

/// Runs `read`, whose errors of the library become ours.
template <class Read>
auto guarded(const std::string& name, Read read) {
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
  return guarded(name, [&] { return ExrReader(bytes, name).read(layer); });
}

std::map<std::string, std::string> exrText(std::span<const std::byte> bytes,
                                           const std::string& name) {
  return guarded(name, [&] { return ExrReader(bytes, name).text(); });
}

}  // namespace glint::detail
