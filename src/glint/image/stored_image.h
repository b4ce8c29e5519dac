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

/// A picture as its file holds it, so that a large pair of 8-bit pictures needs no floats.
///
/// 8- and 16-bit codes are sRGB with straight alpha; floats are linear light, premultiplied by
/// alpha. Rows from the top, channels interleaved.
struct StoredImage {
  int width = 0;
  int height = 0;
  int channels = 4;  ///< 3 (opaque) or 4; 1 for floats that are grey, opaque
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> values;
  std::map<std::string, std::string> text = {};  ///< what the file says of the picture (UTF-8)
  /// What the file says of its colours or its orientation, by name, and is not followed: colours
  /// are taken as sRGB's, rows as they are stored. What says just that is not here.
  std::map<std::string, std::string> unfollowed = {};
  /// Of a large picture that is read by rows, `values` being empty; see decodePictureLayers(). The
  /// functions below may then find that the file is damaged and throw InputError.
  std::shared_ptr<detail::RowWindow> window = {};

  bool isEncoded() const { return values.index() < 2; }  ///< sRGB codes, not linear light
  bool hasAlpha() const { return channels == 4; }

  /// `count` rows from row `first` on, in linear light, RGBA premultiplied: 4 * width * count
  /// floats. Codes are decoded to the nearest float.
  void linearRows(int first, int count, float* rgba) const;

  /// The same rows as sRGB values with straight alpha: codes divided by the largest one; linear
  /// light through the sRGB curve, which is continued beyond [0, 1] by its own formula, odd about
  /// 0. Where alpha is 0 or less the colour is 0.
  void encodedRows(int first, int count, float* rgba) const;

  /// The same rows as numbers of the file, sRGB or linear light: colours as they are stored,
  /// whatever alpha is (straight with codes, premultiplied with floats).
  void storedRows(int first, int count, float* rgba) const;

  /// Rows as they are held: codes or floats, `channels` for a pixel. Of a picture that is read by
  /// rows they are copied to `copy` first.
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

/// The sRGB curve, continued beyond [0, 1] by its own formula, odd about 0.
float encodedValue(float linear);
/// Its inverse.
float decodedValue(float encoded);

/// Reads a picture; see readImage() for the formats and the errors.
StoredImage readStoredImage(const std::string& path, const std::string& layer = "");
StoredImage decodeStoredImage(std::span<const std::byte> bytes, const std::string& name,
                              const std::string& layer = "");

}  // namespace glint
