#pragma once

// Pictures for textures, with known codes.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

namespace glint::test {

/// An 8-bit RGBA PNG with these codes, stored without compression; at most 65,535 bytes of them.
inline std::vector<std::byte> png(int width, int height,
                                  const std::function<glm::ivec4(int x, int y)>& code) {
  std::vector<std::uint8_t> file;
  const auto word = [](std::vector<std::uint8_t>& to, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(std::uint8_t(value >> shift));
  };
  const auto chunk = [&](std::string_view name, const std::vector<std::uint8_t>& data) {
    word(file, std::uint32_t(data.size()));
    const std::size_t from = file.size();
    file.insert(file.end(), name.begin(), name.end());
    file.insert(file.end(), data.begin(), data.end());
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t i = from; i < file.size(); ++i) {
      crc ^= file[i];
      for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xedb88320u : 0);
    }
    word(file, ~crc);
  };
  for (const int each : {137, 80, 78, 71, 13, 10, 26, 10}) file.push_back(std::uint8_t(each));
  std::vector<std::uint8_t> head;
  word(head, std::uint32_t(width));
  word(head, std::uint32_t(height));
  for (const int each : {8, 6, 0, 0, 0}) head.push_back(std::uint8_t(each));
  chunk("IHDR", head);
  std::vector<std::uint8_t> rows;
  for (int y = 0; y < height; ++y) {
    rows.push_back(0);
    for (int x = 0; x < width; ++x)
      for (int k = 0; k < 4; ++k) rows.push_back(std::uint8_t(code(x, y)[k]));
  }
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t each : rows) a = (a + each) % 65521, b = (b + a) % 65521;
  const auto size = std::uint16_t(rows.size());
  std::vector<std::uint8_t> data{0x78,
                                 0x01,
                                 1,
                                 std::uint8_t(size),
                                 std::uint8_t(size >> 8),
                                 std::uint8_t(~size),
                                 std::uint8_t(std::uint16_t(~size) >> 8)};
  data.insert(data.end(), rows.begin(), rows.end());
  word(data, b << 16 | a);
  chunk("IDAT", data);
  chunk("IEND", {});
  std::vector<std::byte> bytes(file.size());
  for (std::size_t i = 0; i < file.size(); ++i) bytes[i] = std::byte(file[i]);
  return bytes;
}

}  // namespace glint::test
