#include "glint/gltf/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstring>

#include "glint/image/read_files.h"

namespace glint::gltf {
namespace {

/// A larger JSON would not fit into memory once parsed.
constexpr std::uint64_t maxJsonBytes = std::uint64_t(256) << 20;

std::atomic<bool> isConfined = false;

/// Whether an open file is inside the folder or its subfolders. Checking the open file rather than
/// the path prevents it from being swapped in between.
bool isInside(int descriptor, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path file =
      std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), error);
  if (error) return false;
  const std::filesystem::path real = std::filesystem::canonical(folder, error);
  if (error) return false;
  const auto [end, in] = std::mismatch(real.begin(), real.end(), file.begin(), file.end());
  return end == real.end() && in != file.end();
}

std::uint32_t littleEndian(const unsigned char* bytes) {
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

Container readGlb(const RegularFile& file, const std::filesystem::path& path,
                  const Messages& messages) {
  constexpr std::uint32_t jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942;
  const char* const cutOff = "copy or download the file again";
  std::array<unsigned char, 12> header;
  if (!file.read(header.data(), 0, header.size())) messages.fail("ends in its GLB header", cutOff);
  if (const std::uint32_t version = littleEndian(&header[4]); version != 2) {
    messages.fail("is GLB version " + std::to_string(version) + ", only 2 is supported",
                  "export it as glTF 2.0");
  }
  const std::uint64_t length = littleEndian(&header[8]);
  if (length > file.size()) {
    messages.fail("is truncated, its header declares " + std::to_string(length) +
                      " bytes but it has " + std::to_string(file.size()),
                  cutOff);
  }

  Container container;
  std::uint64_t offset = header.size();
  for (int chunk = 0; offset + 8 <= length; ++chunk) {
    std::array<unsigned char, 8> head;
    if (!file.read(head.data(), offset, head.size())) messages.fail("cannot be read", cutOff);
    offset += head.size();
    const std::uint64_t size = littleEndian(head.data());
    const std::uint32_t type = littleEndian(&head[4]);
    if (size > length - offset) {
      messages.fail("GLB chunk " + std::to_string(chunk) + " of " + std::to_string(size) +
                        " bytes extends past the end of the file",
                    cutOff);
    }
    if (chunk == 0 && type != jsonChunk) messages.fail("its first GLB chunk is not JSON");
    if (chunk == 0) {
      if (size > maxJsonBytes) messages.fail("its JSON is larger than 256 MiB", "split the model");
      container.json.resize(size);
      if (!file.read(container.json.data(), offset, size)) messages.fail("cannot be read", cutOff);
    } else if (type == binaryChunk && !container.binary) {
      container.binary.emplace(path, confinementOfItself(path), offset, size);
    }
    offset += size;
  }
  if (container.json.empty()) messages.fail("has no JSON chunk", cutOff);
  return container;
}

/// RFC 4648; false for a character outside its alphabet. White space is skipped.
bool decodeBase64(std::string_view text, std::vector<unsigned char>& bytes) {
  static const auto values = [] {
    std::array<int, 256> table;
    table.fill(-1);
    const std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
      table[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
    }
    return table;
  }();
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    if (c == '\n' || c == '\r' || c == ' ' || c == '\t') continue;
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) return false;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<unsigned char>(bits >> count & 0xff));
    }
  }
  return true;
}

// Whether the part of a data URI before its comma ends with ";base64", in any case and with spaces
// about the word (WHATWG fetch standard, "data: URLs").
bool saysBase64(std::string_view type) {
  const auto trim = [&] { type = type.substr(0, type.find_last_not_of(' ') + 1); };
  constexpr std::string_view word = "base64";
  trim();
  const std::string_view end = type.substr(type.size() - std::min(type.size(), word.size()));
  if (!std::ranges::equal(end, word, {}, [](unsigned char c) { return std::tolower(c); }))
    return false;
  type.remove_suffix(word.size());
  trim();
  return type.ends_with(';');
}

std::vector<unsigned char> readDataUri(const std::string& uri, std::string& error) {
  std::vector<unsigned char> bytes;
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos) {
    error = "is a data URI without data";
    return bytes;
  }
  std::string_view payload = std::string_view(uri).substr(comma + 1);
  std::string decoded;
  if (payload.find('%') != payload.npos) payload = decoded = percentDecoded(payload);
  if (saysBase64(std::string_view(uri).substr(0, comma))) {
    if (!decodeBase64(payload, bytes)) error = "is a data URI whose base64 is damaged";
  } else {
    bytes.assign(payload.begin(), payload.end());
  }
  return bytes;
}

/// "http" of "http://host/file"; empty for a relative reference. One letter is a Windows drive.
std::string_view schemeOf(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == uri.npos || colon < 2) return {};
  for (const char c : uri.substr(0, colon)) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') return {};
  }
  return uri.substr(0, colon);
}

}  // namespace

bool isDataUri(std::string_view uri) {
  const std::string_view scheme = "data:";
  return uri.size() >= scheme.size() &&
         std::equal(scheme.begin(), scheme.end(), uri.begin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

std::string oddityOf(const std::string& uri) {
  if (isDataUri(uri)) return uri.starts_with("data:") ? "" : "is a data URI in capital letters";
  return percentDecoded(uri).find('\\') != uri.npos ? "has a backslash in its name" : "";
}

void confineModels() { isConfined = true; }

std::filesystem::path confinementOf(const std::filesystem::path& model) {
  if (!isConfined) return {};
  return model.has_parent_path() ? model.parent_path() : std::filesystem::path(".");
}

std::filesystem::path confinementOfItself(const std::filesystem::path& model) {
  return model.parent_path() == "/proc/self/fd" ? std::filesystem::path() : confinementOf(model);
}

RegularFile::RegularFile(const std::filesystem::path& path, const std::filesystem::path& folder,
                         std::string& error) {
  // Without O_NONBLOCK, opening a FIFO blocks until there is a writer.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  struct stat status = {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    error = errno == ENOENT || errno == ENOTDIR ? "does not exist"
            : errno == EACCES                   ? "cannot be read by this user"
                                                : "cannot be opened";
  } else if (S_ISDIR(status.st_mode)) {
    error = "is a folder, not a file";
  } else if (!S_ISREG(status.st_mode)) {
    error = "is not a regular file";
  } else if (!folder.empty() && !isInside(descriptor_, folder)) {
    error = liesOutside;
  } else {
    size_ = static_cast<std::uint64_t>(status.st_size);
    noteReadFile(descriptor_, path.string());
  }
}

RegularFile::~RegularFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool RegularFile::read(void* to, std::uint64_t offset, std::size_t count) const {
  char* cursor = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = ::pread(descriptor_, cursor, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    cursor += got;
    offset += static_cast<std::uint64_t>(got);
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

ByteSource::ByteSource(std::vector<unsigned char> bytes)
    : size_(bytes.size()), bytes_(std::move(bytes)) {}

ByteSource::ByteSource(std::filesystem::path path, std::filesystem::path folder,
                       std::uint64_t start, std::uint64_t size)
    : path_(std::move(path)), folder_(std::move(folder)), start_(start), size_(size) {}

bool ByteSource::read(void* to, std::uint64_t offset, std::size_t count) const {
  if (offset > size_ || count > size_ - offset) return false;
  if (count == 0) return true;
  if (path_.empty()) {
    std::memcpy(to, bytes_.data() + offset, count);
    return true;
  }
  std::string error;
  const RegularFile file(path_, folder_, error);
  return error.empty() && file.read(to, start_ + offset, count);
}

Container readContainer(const std::filesystem::path& path, const Messages& messages) {
  std::string error;
  const RegularFile file(path, confinementOfItself(path), error);
  if (!error.empty()) messages.fail(error, "give a .gltf or .glb file");
  if (file.size() == 0) messages.fail("is empty", "give a .gltf or .glb file");
  std::array<char, 64> start{};
  const std::size_t known = std::min<std::uint64_t>(start.size(), file.size());
  if (!file.read(start.data(), 0, known)) messages.fail("cannot be read", "check the disk");
  std::string_view front(start.data(), known);
  if (front.starts_with("glTF")) return readGlb(file, path, messages);

  if (front.starts_with("\xef\xbb\xbf")) front.remove_prefix(3);
  const std::size_t first = front.find_first_not_of(" \t\r\n");
  if (first != front.npos && front[first] != '{') {
    messages.fail("is neither GLB nor JSON", "give a glTF 2.0 file, .gltf or .glb");
  }
  if (file.size() > maxJsonBytes) {
    messages.fail("its JSON is larger than 256 MiB", "export it as .glb");
  }
  Container container;
  container.json.resize(file.size());
  if (!file.read(container.json.data(), 0, file.size())) {
    messages.fail("cannot be read", "check the disk");
  }
  return container;
}

std::string percentDecoded(std::string_view text) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const int lower = std::tolower(static_cast<unsigned char>(c));
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
  };
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 &&
        digit(text[i + 2]) >= 0) {
      decoded += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

ByteSource openUri(const std::string& uri, const std::filesystem::path& model, std::string& error) {
  if (isDataUri(uri)) return ByteSource(readDataUri(uri, error));
  if (!schemeOf(uri).empty()) {
    error = "is not a file next to the model";
    return {};
  }
  const std::string name = percentDecoded(uri);
  if (name.empty() || name.find('\0') != name.npos || uri.find('\0') != uri.npos) {
    error = "is not a file name";
    return {};
  }
  const std::filesystem::path folder = model.parent_path(), confinement = confinementOf(model);
  const auto open = [&](const std::string& as, std::string& why) {
    const RegularFile file(folder / as, confinement, why);
    return why.empty() ? ByteSource(folder / as, confinement, 0, file.size()) : ByteSource();
  };
  ByteSource source = open(name, error);
  if (error.empty()) return source;
  // Some exporters write names with a percent sign unescaped; Windows exporters write backslashes
  // as separators, plain or as %5C.
  std::string slashed = name;
  std::ranges::replace(slashed, '\\', '/');
  for (const std::string& other : {uri, slashed}) {
    if (other == name) continue;
    std::string second;
    source = open(other, second);
    if (second == liesOutside) error = second;
    if (!second.empty()) continue;
    error.clear();
    return source;
  }
  return {};
}

std::string printableUri(std::string_view uri) {
  if (isDataUri(uri)) return printable(uri.substr(0, uri.find_first_of(";,")), 60);
  return printable(uri, 120);
}

}  // namespace glint::gltf
