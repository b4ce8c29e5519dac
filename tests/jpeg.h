#pragma once

// JPEG files, made by the library that the reader uses.

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <vector>
// jpeglib.h needs FILE declared before it.
#include <jpeglib.h>

namespace glint::test {

/// 20 x 12 pixels of smooth colours.
inline std::vector<std::byte> makeJpeg(int components, bool progressive) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &out, &size);
  info.image_width = 20;
  info.image_height = 12;
  info.input_components = components;
  info.in_color_space = components == 1 ? JCS_GRAYSCALE : components == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&info);
  if (components == 4) jpeg_set_colorspace(&info, JCS_YCCK);
  jpeg_set_quality(&info, 95, TRUE);
  if (progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  for (unsigned y = 0; y < 12; ++y) {
    std::vector<unsigned char> row;
    for (unsigned x = 0; x < 20; ++x) {
      const unsigned char pixel[] = {static_cast<unsigned char>(40 + 8 * x),
                                     static_cast<unsigned char>(200 - 9 * y), 90, 200};
      row.insert(row.end(), pixel, pixel + components);
    }
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&info, &pointer, 1);
  }
  jpeg_finish_compress(&info);
  const auto* begin = reinterpret_cast<const std::byte*>(out);
  std::vector<std::byte> bytes(begin, begin + size);
  jpeg_destroy_compress(&info);
  std::free(out);
  return bytes;
}

}  // namespace glint::test
