#include <cstdio>
// jpeglib.h needs FILE declared before it, jerror.h needs jpeglib.h.
#include <jpeglib.h>

#include <jerror.h>

#include <algorithm>
#include <csetjmp>
#include <optional>

#include "glint/image/decoders.h"
#include "glint/image/row_reducer.h"

// libjpeg reports errors through a function that must not return. It longjmps back into one of the
// small functions below, which hold no object with a destructor, so the jump skips none.

namespace glint::detail {
namespace {

// Enough for the coefficients of a progressive 4:2:0 picture of the largest size.
constexpr long memoryLimit = 1L << 30;
// A malicious progressive file can repeat empty scans, each of which visits the whole picture; real
// files have about ten.
constexpr int scanLimit = 100;
constexpr int rowsAtOnce = 64;

struct JpegReader {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  bool endless = false;  ///< the end-of-image marker is missing
  std::jmp_buf failed{};
  char message[JMSG_LENGTH_MAX] = "";

  JpegReader() = default;
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() { jpeg_destroy_decompress(&info); }
};

JpegReader& readerOf(j_common_ptr info) { return *static_cast<JpegReader*>(info->client_data); }

[[noreturn]] void onError(j_common_ptr info) {
  info->err->format_message(info, readerOf(info).message);
  std::longjmp(readerOf(info).failed, 1);
}

/// libjpeg continues after damage and fills in grey; here damaged pixels are an error. A file that
/// only lacks its end-of-image marker (JWRN_JPEG_EOF without JWRN_HIT_MARKER) has all its pixels.
void onMessage(j_common_ptr info, int level) {
  if (level >= 0) return;
  switch (info->err->msg_code) {
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_MUST_RESYNC:
    case JWRN_ARITH_BAD_CODE:
      onError(info);
    case JWRN_JPEG_EOF:
      readerOf(info).endless = true;
      return;
    default:
      return;
  }
}

/// For a file without an end-of-image marker: whether every coefficient has arrived in full. A
/// progressive file may lack whole scans, others the scans of whole components.
bool isComplete(const jpeg_decompress_struct& info) {
  if (!info.progressive_mode) return info.comps_in_scan == info.num_components;
  for (int component = 0; component < info.num_components; ++component) {
    for (int k = 0; k < DCTSIZE2; ++k) {
      if (info.coef_bits[component][k] != 0) return false;
    }
  }
  return true;
}

void onOutput(j_common_ptr) {}

void onProgress(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > scanLimit) {
    std::snprintf(readerOf(info).message, JMSG_LENGTH_MAX, "more than %d scans", scanLimit);
    std::longjmp(readerOf(info).failed, 1);
  }
}

/// Returns false and sets the message on an error; likewise below.
bool readHeader(JpegReader& reader, const unsigned char* bytes, unsigned long size) {
  if (setjmp(reader.failed) != 0) return false;
  reader.info.err = jpeg_std_error(&reader.errors);
  reader.errors.error_exit = onError;
  reader.errors.emit_message = onMessage;
  reader.errors.output_message = onOutput;
  reader.info.client_data = &reader;
  jpeg_create_decompress(&reader.info);
  reader.info.mem->max_memory_to_use = memoryLimit;
  reader.progress.progress_monitor = onProgress;
  reader.info.progress = &reader.progress;
  jpeg_mem_src(&reader.info, bytes, size);
  jpeg_read_header(&reader.info, TRUE);
  return true;
}

bool startDecoding(JpegReader& reader) {
  if (setjmp(reader.failed) != 0) return false;
  const bool cmyk = reader.info.num_components == 4;
  reader.info.out_color_space = cmyk ? JCS_CMYK : JCS_EXT_RGBA;
  jpeg_start_decompress(&reader.info);
  return true;
}

/// Reads `count` rows of 4 bytes a pixel.
bool readRows(JpegReader& reader, unsigned char* rows, int count) {
  if (setjmp(reader.failed) != 0) return false;
  const JDIMENSION end = reader.info.output_scanline + static_cast<JDIMENSION>(count);
  const JDIMENSION begin = reader.info.output_scanline;
  while (reader.info.output_scanline < end) {
    JSAMPROW row =
        rows + std::size_t(4) * reader.info.output_width * (reader.info.output_scanline - begin);
    jpeg_read_scanlines(&reader.info, &row, 1);
  }
  return true;
}

unsigned char product(unsigned a, unsigned b) {
  return static_cast<unsigned char>((a * b + 127) / 255);
}

/// Without a profile CMYK says little about colour; this is the conversion of most viewers. Adobe's
/// files, which nearly all CMYK files are, store the complements.
void convertCmyk(std::span<unsigned char> pixels, bool complements) {
  const unsigned flip = complements ? 0 : 255;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const unsigned black = pixels[i + 3] ^ flip;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      pixels[i + channel] = product(pixels[i + channel] ^ flip, black);
    }
    pixels[i + 3] = 255;
  }
}

}  // namespace

bool isJpeg(std::span<const std::byte> bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte(0xff) && bytes[1] == std::byte(0xd8) &&
         bytes[2] == std::byte(0xff);
}

namespace {

/// Reads the header and checks the size.
void openJpeg(JpegReader& reader, std::span<const std::byte> bytes, const std::string& name) {
  if (!readHeader(reader, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()))
    throw damaged(name, std::string("the JPEG is damaged (") + reader.message + ")");
  checkSides(name, reader.info.image_width, reader.info.image_height);
}

}  // namespace

TextureHeader jpegHeader(std::span<const std::byte> bytes, const std::string& name) {
  JpegReader reader;
  openJpeg(reader, bytes, name);
  TextureHeader header{int(reader.info.image_width), int(reader.info.image_height), 0, 0};
  // For a picture in several scans the library holds all coefficients, two bytes each.
  if (jpeg_has_multiple_scans(&reader.info)) {
    for (int i = 0; i < reader.info.num_components; ++i) {
      const jpeg_component_info& component = reader.info.comp_info[i];
      header.work +=
          std::uint64_t(2) * DCTSIZE2 * component.width_in_blocks * component.height_in_blocks;
    }
  }
  header.reducedWork = header.work;
  return header;
}

ByteImage decodeJpeg(std::span<const std::byte> bytes, const std::string& name, int halvings,
                     bool isData) {
  JpegReader reader;
  openJpeg(reader, bytes, name);
  const auto check = [&](bool good) {
    if (!good) throw damaged(name, std::string("the JPEG is damaged (") + reader.message + ")");
  };
  check(startDecoding(reader));
  ByteImage image;
  image.width = static_cast<int>(reader.info.output_width);
  image.height = static_cast<int>(reader.info.output_height);
  const std::size_t rowBytes = std::size_t(4) * image.width;
  std::optional<RowReducer> reducer;
  if (halvings > 0) {
    reducer.emplace(image.width, image.height, halvings, isData);
    image.values.resize(rowBytes * rowsAtOnce);
  } else {
    image.values.reserve(withRoomForLevels(rowBytes * image.height));
  }
  // Grown as rows arrive, so that a small file that claims to be huge uses little memory.
  for (int y = 0; y < image.height; y += rowsAtOnce) {
    const int count = std::min(rowsAtOnce, image.height - y);
    if (!reducer) image.values.resize(rowBytes * (y + count));
    const std::span<unsigned char> rows(image.values.data() + (reducer ? 0 : rowBytes * y),
                                        rowBytes * count);
    check(readRows(reader, rows.data(), count));
    if (reader.info.out_color_space == JCS_CMYK)
      convertCmyk(rows, reader.info.saw_Adobe_marker != 0);
    for (int row = 0; reducer && row < count; ++row) reducer->add(rows.data() + rowBytes * row);
  }
  if (reader.endless && !isComplete(reader.info))
    throw damaged(name, "the JPEG is damaged (its last scans are missing)");
  return reducer ? reducer->take() : std::move(image);
}

}  // namespace glint::detail
