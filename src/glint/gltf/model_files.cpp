#include "glint/gltf/model_files.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "glint/gltf/file.h"
#include "glint/image/error.h"
#include "glint/image/json_text.h"
#include "glint/image/read_files.h"

namespace glint {
namespace {

using Json = nlohmann::json;

/// Collects all values of "uri" members, anywhere, without keeping anything else.
class UriReader : public nlohmann::json_sax<Json> {
 public:
  std::vector<std::string> uris;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& text) override {
    if (isUri_ && !text.starts_with("data:")) uris.push_back(std::move(text));
    return true;
  }
  bool start_object(std::size_t) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool key(string_t& name) override {
    isUri_ = name == "uri";
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;
  }

 private:
  bool isUri_ = false;
};

}  // namespace

void noteModelFiles(const std::string& path) {
  noteReadFile(path);
  try {
    const gltf::Container container = gltf::readContainer(path, gltf::Messages(path));
    if (container.json.find("uri") == std::string::npos &&
        container.json.find("\\u") == std::string::npos)
      return;
    UriReader reader;
    if (jsonRefusal(container.json).empty()) Json::sax_parse(container.json, &reader);
    const auto folder = std::filesystem::path(path).parent_path();
    for (const std::string& uri : reader.uris) {
      for (const std::string& name : {gltf::percentDecoded(uri), uri})
        if (name.find('\0') == std::string::npos) noteReadFile((folder / name).string());
    }
  } catch (const InputError&) {
  }
}

}  // namespace glint
