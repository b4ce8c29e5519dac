#include "glint/options/picture_text.h"

#include "glint/gltf/model_hash.h"
#include "glint/options/parameters.h"

namespace glint {
namespace {

constexpr const char* program = "glint " GLINT_VERSION;

}  // namespace

std::string pictureKey(const Look& look, const PictureOrigin& origin) {
  Hash hash;
  for (const std::string& part :
       {std::string(program), saveLook(look), origin.modelHash, std::to_string(origin.bitDepth),
        origin.variation, std::string(origin.gl ? "gl" : "reference")})
    hash.add(part);
  for (const std::string& file : {look.hdriFile, look.costTable})
    if (!file.empty()) hash.add(fileHash(file));
  return hash.text();
}

std::vector<std::pair<std::string, std::string>> pictureText(const Look& look, const Look& keyed,
                                                             const PictureOrigin& origin) {
  std::vector<std::pair<std::string, std::string>> text{{"Software", program}};
  if (origin.gl) {
    text.emplace_back("GL_VENDOR", origin.gl->vendor);
    text.emplace_back("GL_RENDERER", origin.gl->renderer);
    text.emplace_back("GL_VERSION", origin.gl->version);
  } else {
    text.emplace_back("glint-backend", "reference");
  }
  text.emplace_back("glint-look", saveLook(look));
  text.emplace_back("glint-model", origin.modelHash);
  if (!origin.variation.empty()) text.emplace_back("glint-variation", origin.variation);
  text.emplace_back("glint-key", pictureKey(keyed, origin));
  return text;
}

}  // namespace glint
