#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace glint {

namespace detail {
class RowWindow;
}

/// A picture as stored in its file, so that a large pair of 8-bit pictures needs no floats.
///
/// 8- and 16-bit codes are sRGB with straight alpha; floats are linear light, premultiplied by
/// alpha. Rows from the top, channels interleaved.
struct StoredImage {
  int width = 0;
  int height = 0;
  int channels = 4;  ///< 3 (opaque) or 4; 1 for opaque grey floats
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> values;
  std::map<std::string, std::string> text = {};  ///< text in the file about the picture (UTF-8)
  /// Colour and orientation metadata, by name, that are not applied: colours are taken as sRGB,
  /// rows as stored. Metadata that say just that are not listed.
  std::map<std::string, std::string> unfollowed = {};
  /// Set for a large picture that is read by rows; `values` is then empty; see
  /// decodePictureLayers(). The functions below may then find that the file is damaged and throw
  /// InputError.
  std::shared_ptr<detail::RowWindow> window = {};

  bool isEncoded() const { return values.index() < 2; }  ///< sRGB codes, not linear light
  bool hasAlpha() const { return channels == 4; }

  /// `count` rows from row `first` on, in linear light, RGBA premultiplied: 4 * width * count
  /// floats. Codes are decoded to the nearest float.
  void linearRows(int first, int count, float* rgba) const;

  /// The same rows as sRGB values with straight alpha: codes divided by the largest code; linear
  /// light through the sRGB curve, whose formula is continued beyond [0, 1] and is odd about 0.
  /// Where alpha is 0 or less the colour is 0.
  void encodedRows(int first, int count, float* rgba) const;

  /// The same rows in the file's own space, sRGB or linear light: colours as stored, whatever alpha
  /// is (straight with codes, premultiplied with floats).
  void storedRows(int first, int count, float* rgba) const;

  /// Rows as held: codes or floats, `channels` per pixel. For a picture that is read by rows they
  /// are copied to `copy` first.
  template <class Value>
  const Value* heldRows(int first, int count, std::vector<Value>& copy) const {
    const std::size_t row = std::size_t(channels) * width;
    if (!window) return std::get<std::vector<Value>>(values).data() + row * first;
    copy.resize(row * count);
    readWindow(first, count, copy.data());
    return copy.data();
  }

 private:
  void readWindow(int first, int count, void* out) const;
  void codeRows(int first, int count, bool stored, float* rgba) const;
};

/// The sRGB curve, its formula continued beyond [0, 1] and odd about 0.
float encodedValue(float linear);
/// Its inverse.
float decodedValue(float encoded);

/// Reads a picture; see readImage() for the formats and the errors.
StoredImage readStoredImage(const std::string& path, const std::string& layer = "");
StoredImage decodeStoredImage(std::span<const std::byte> bytes, const std::string& name,
                              const std::string& layer = "");

}  // namespace glint
