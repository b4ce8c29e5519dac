#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "commands.h"
#include "glint/budget/error_budget.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/error.h"
#include "glint/image/picture_format.h"
#include "glint/image/printable.h"
#include "glint/image/texture.h"
#include "glint/options/add_option.h"
#include "glint/options/help.h"
#include "glint/options/outputs.h"
#include "glint/options/read_options.h"
#include "glint/render/decode.h"
#include "glint/render/draw_list.h"
#include "glint/render/left_out.h"
#include "glint/scene/material_parameters.h"
#include "report.h"
#include "stdin_model.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

Json vectorJson(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json imageJson(const EncodedImage& image, bool read) {
  Json json{{"name", image.name}, {"bytes", image.bytes.size()}};
  if (const PictureFormat* format = pictureFormatIn(image.bytes)) json["format"] = format->name;
  try {
    const TextureHeader header = textureHeader(image.bytes, image.name);
    json["width"] = header.width;
    json["height"] = header.height;
  } catch (const InputError&) {
    // A picture that cannot be decoded has no size; decoding it for drawing reports why.
  }
  json["read"] = read;
  return json;
}

Json cameraJson(const FileCamera& c, std::size_t index) {
  if (!c.unusable.empty()) return {{"name", c.name}, {"index", index}, {"unusable", c.unusable}};
  Json json{{"name", c.name},
            {"index", index},
            {"type", c.orthographic ? "orthographic" : "perspective"},
            {"position", vectorJson(glm::dvec3(c.world[3]))},
            {"direction", vectorJson(-glm::dvec3(c.world[2]))}};
  if (c.orthographic)
    json["halfHeight"] = c.halfHeight;
  else
    json["viewAngle"] = c.viewAngle * 180 / std::numbers::pi;
  if (c.aspect > 0) json["aspect"] = c.aspect;
  if (c.near > 0) json["near"] = c.near;
  if (c.far > 0) json["far"] = c.far;
  return json;
}

Json materialJson(const Material& m, const std::set<int>& read) {
  Json json{{"name", m.name}, {"index", m.index}};
  for (const MaterialParameter& p : materialParameters())
    json[std::string(p.name)] = m.shading.*p.value;
  json["color"] = vectorJson(m.shading.color);
  json["alpha"] = m.alpha;
  constexpr const char* modes[] = {"opaque", "mask", "blend"};
  json["alphaMode"] = modes[int(m.alphaMode)];
  json["doubleSided"] = m.doubleSided;
  json["unlit"] = m.unlit;
  json["emission"] = vectorJson(m.emission);
  const auto texture = [&](const char* key, const std::optional<Texture>& t) {
    if (t) json[key] = {{"image", t->image}, {"read", read.contains(t->image)}};
  };
  texture("colorTexture", m.colorTexture);
  texture("emissionTexture", m.emissionTexture);
  texture("normalTexture", m.normalTexture);
  const ParameterTextures& t = m.parameterTextures;
  texture("metallicRoughnessTexture", t.metallicRoughness);
  texture("occlusionTexture", t.occlusion);
  texture("specularTexture", t.specular);
  texture("transmissionTexture", t.transmission);
  for (const MaterialParameter& p : materialParameters())
    if (m.textured & p.textured) json["fromTextures"].push_back(p.name);
  return json;
}

/// The corners of the bounding box of the scene; null if the scene is empty.
Json boxJson(const Scene& scene) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  glm::dvec3 low(inf), high(-inf);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
    for (const std::uint32_t i : mesh.indices) {
      const glm::dvec3 place = glm::dvec3(mesh.positions[i]) + mesh.origin;
      const glm::dvec3 p(instance.world * glm::dvec4(place, 1));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  if (!(low.x <= high.x)) return Json();
  return {{"min", vectorJson(low)}, {"max", vectorJson(high)}};
}

Json infoJson(const Scene& scene, const Look& look) {
  const Bounds bounds = boundsOf(scene);
  const DrawList list = makeDrawList(scene, bounds, look);
  const std::vector<int> images = imagesRead(scene, look);
  const std::set<int> read(images.begin(), images.end());
  Json json{{"model", scene.name},
            {"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"triangles", triangleCount(scene, list)},
            {"center", vectorJson(bounds.center)},
            {"radius", bounds.radius},
            {"box", boxJson(scene)}};
  json["scenes"] = scene.scenes;
  json["materialVariants"] = scene.variants;
  json["materials"] = Json::array();
  std::set<int> used;
  for (const Instance& i : scene.instances) used.insert(scene.meshes[std::size_t(i.mesh)].material);
  for (const int i : used)
    json["materials"].push_back(
        materialJson(editedMaterial(scene.materials[std::size_t(i)], look), read));
  json["images"] = Json::array();
  for (std::size_t i = 0; i < scene.images.size(); ++i)
    json["images"].push_back(imageJson(scene.images[i], read.contains(int(i))));
  json["cameras"] = Json::array();
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    json["cameras"].push_back(cameraJson(scene.cameras[i], i));
  json["objects"] = Json::array();
  for (const FileObject& o : scene.objects)
    json["objects"].push_back({{"node", o.node}, {"mesh", o.mesh}});
  json["lights"] = Json::array();
  constexpr const char* lightTypes[] = {"directional", "point", "spot"};
  for (const FileLight& l : scene.lights)
    json["lights"].push_back({{"name", l.name},
                              {"type", lightTypes[int(l.type)]},
                              {"unit", l.type == FileLight::Type::directional ? "lux" : "candela"},
                              {"intensity", vectorJson(l.intensity)}});
  if (!scene.lights.empty()) json["light-scale"] = look.lightScale.value_or(scene.lightScale);
  json["animations"] = Json::array();
  for (const FileAnimation& a : scene.animations)
    json["animations"].push_back({{"name", a.name}, {"seconds", a.duration}});
  json["skins"] = Json::array();
  for (const FileSkin& s : scene.skins)
    json["skins"].push_back({{"name", s.name}, {"joints", s.joints}});
  json["morphs"] = Json::array();
  for (const FileMorph& m : scene.morphs)
    json["morphs"].push_back({{"mesh", m.name}, {"targets", m.targets}});
  json["extensions"] = Json::array();
  constexpr const char* uses[] = {"read", "approximated", "ignored", "unseen"};
  for (const FileExtension& e : scene.extensions)
    json["extensions"].push_back(
        {{"name", e.name}, {"use", uses[int(e.use)]}, {"note", e.note}, {"required", e.required}});
  json["leftOut"] = Json::array();
  for (const LeftOut& each : leftOut(scene, look))
    json["leftOut"].push_back({{"material", each.material},
                               {"what", each.what},
                               {"reason", each.reason},
                               {"shows", each.shows}});
  json["variants"] = variantsJson(scene, list, look);
  json["warnings"] = scene.warnings;
  return json;
}

std::string oneLine(const Json& value) {
  return printable(value.is_string() ? value.get<std::string>() : value.dump());
}

void printChoice(const Json& choice) {
  std::cout << "\nChoice by error";
  if (choice.contains("max-error"))
    std::cout << ": within " << choice["max-error"] << ", bound " << choice["bound"]
              << "; costs: " << oneLine(choice["costs"]);
  std::cout << "\n  " << oneLine(choice["shading"]);
  if (choice.contains("reason")) std::cout << " (" << oneLine(choice["reason"]) << ")";
  std::cout << "\n";
  for (const Json& m : choice["materials"]) {
    std::cout << "  " << oneLine(m["material"]) << ":";
    for (const char* form : {"highlight", "fresnel"})
      if (m.contains(form)) std::cout << " " << form << "=" << oneLine(m[form]);
    std::cout << ", bound " << m["bound"] << " (lobe " << m["lobe"] << ", reflectance "
              << m["reflectance"] << ", interpolation " << m["interpolation"] << ", rounding "
              << m["rounding"] << ")\n      " << oneLine(m["reason"]) << "\n";
  }
}

/// Prints a skin or a mesh with its number of `things` and the names of those that have one.
void printList(std::size_t index, const std::string& name, const Json& names, const char* thing) {
  std::cout << "  " << index << ": " << (name.empty() ? "(no name)" : printable(name)) << ", "
            << names.size() << " " << thing << (names.size() == 1 ? "" : "s");
  bool first = true;
  for (const Json& n : names) {
    if (n == "") continue;
    std::cout << (first ? ": " : ", ") << oneLine(n);
    first = false;
  }
  std::cout << "\n";
}

void printCamera(std::size_t index, const Json& camera) {
  std::cout << "  " << index << ": " << oneLine(camera["type"]) << " " << oneLine(camera["name"])
            << ", at " << camera["position"].dump();
  if (camera.contains("viewAngle")) std::cout << ", view angle " << camera["viewAngle"];
  if (camera.contains("halfHeight")) std::cout << ", half height " << camera["halfHeight"];
  for (const char* key : {"aspect", "near", "far"})
    if (camera.contains(key)) std::cout << ", " << key << " " << camera[key];
  std::cout << "\n";
}

std::string counted(const Json& number, const char* one, const char* many) {
  return number.dump() + " " + (number == 1 ? one : many);
}

void print(const Json& json) {
  std::cout << oneLine(json["model"]) << ": " << counted(json["triangles"], "triangle", "triangles")
            << ", " << counted(json["meshes"], "mesh", "meshes") << ", "
            << counted(json["instances"], "instance", "instances") << "; radius " << json["radius"]
            << " about " << json["center"].dump() << "\n";
  if (!json["box"].is_null()) {
    std::cout << "box from " << json["box"]["min"].dump() << " to " << json["box"]["max"].dump()
              << "\n";
  }
  for (const auto& [list, words] :
       {std::pair("scenes", "scenes"), std::pair("materialVariants", "material variants")}) {
    if (json[list].empty()) continue;
    std::cout << words << ":";
    for (std::size_t i = 0; i < json[list].size(); ++i)
      std::cout << (i ? ", " : " ") << i << " " << oneLine(json[list][i]);
    std::cout << "\n";
  }
  std::cout << "\nMaterials\n";
  for (const Json& m : json["materials"]) {
    const std::string name = m["name"];
    std::cout << "  " << (name.empty() ? "(no name)" : printable(name)) << "\n   ";
    for (const auto& [key, value] : m.items())
      if (key != "name") std::cout << " " << key << "=" << oneLine(value);
    std::cout << "\n";
  }
  if (!json["images"].empty()) std::cout << "\nImages\n";
  for (const Json& image : json["images"])
    std::cout << "  " << oneLine(image["name"]) << ": "
              << oneLine(image.value("format", "unknown format")) << ", "
              << (image.contains("width")
                      ? image["width"].dump() + " x " + image["height"].dump() + " pixels, "
                      : "")
              << image["bytes"] << " bytes, " << (image["read"] ? "read" : "not read by this look")
              << "\n";
  if (!json["cameras"].empty()) std::cout << "\nCameras\n";
  for (std::size_t i = 0; i < json["cameras"].size(); ++i) printCamera(i, json["cameras"][i]);
  if (!json["lights"].empty())
    std::cout << "\nLights (multiplied by " << json["light-scale"] << ")\n";
  for (const Json& light : json["lights"])
    std::cout << "  " << oneLine(light["type"]) << " " << light["intensity"].dump() << " "
              << oneLine(light["unit"]) << " " << oneLine(light["name"]) << "\n";
  if (!json["animations"].empty()) std::cout << "\nAnimations\n";
  for (std::size_t i = 0; i < json["animations"].size(); ++i)
    std::cout << "  " << i << ": " << json["animations"][i]["seconds"] << " s "
              << oneLine(json["animations"][i]["name"]) << "\n";
  if (!json["skins"].empty()) std::cout << "\nSkins\n";
  for (std::size_t i = 0; i < json["skins"].size(); ++i) {
    const Json& skin = json["skins"][i];
    printList(i, skin["name"], skin["joints"], "joint");
  }
  if (!json["morphs"].empty()) std::cout << "\nMorph targets\n";
  for (std::size_t i = 0; i < json["morphs"].size(); ++i) {
    const Json& morph = json["morphs"][i];
    printList(i, morph["mesh"], morph["targets"], "target");
  }
  if (!json["extensions"].empty()) std::cout << "\nExtensions of glTF\n";
  for (const Json& e : json["extensions"]) {
    std::cout << "  " << oneLine(e["name"]) << ": " << oneLine(e["use"]);
    if (e["required"]) std::cout << ", required by the file";
    if (e["note"] != "") std::cout << " (" << oneLine(e["note"]) << ")";
    std::cout << "\n";
  }
  if (!json["leftOut"].empty()) std::cout << "\nNot used by this picture\n";
  for (const Json& each : json["leftOut"])
    std::cout << "  " << oneLine(each["material"]) << ": " << oneLine(each["what"]) << " ("
              << oneLine(each["reason"]) << ")\n";
  if (json.contains("choice")) printChoice(json["choice"]);
  std::cout << "\nShader variants\n";
  for (const Json& v : json["variants"]) {
    std::cout << "  " << oneLine(v["program"]) << " for";
    for (const Json& m : v["materials"])
      std::cout << " " << (m == "" ? std::string("(no name)") : oneLine(m));
    std::cout << "\n    holds";
    for (const Json& f : v["features"]) std::cout << " " << oneLine(f);
    std::cout << "\n";
    for (const auto& [feature, reason] : v["reasons"].items())
      std::cout << "      " << feature << ": " << oneLine(reason) << "\n";
  }
}

}  // namespace

Command addInfo(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "info", "list what a model contains, the shader variants it needs, and why");
  command->footer(examples({"info helmet.glb", "info helmet.glb --max-error 0.01",
                            "info helmet.glb --shading environment --json -"}));
  auto model = std::make_shared<std::string>(), jsonFile = std::make_shared<std::string>();
  command->add_option("MODEL", *model, "a glTF 2.0 model, .gltf or .glb; - is stdin")->required();
  addOption(*command, "--json", *jsonFile, "FILE", "write the list as JSON; - is stdout");
  addConfineOption(*command);
  addDecodeLimitOption(*command);
  auto makeLook = addLookOptions(*command);
  return [=] {
    *model = localPath(*model);
    checkOutputs({{"--json", *jsonFile}, {"--save-look", makeLook.saveFile()}}, {*model});
    const Look look = makeLook();
    Scene scene = readModelFile(
        *model, [&](const std::string& path) { return loadGltf(path, poseOf(look)); });
    if (isStdin(*model)) scene.name = "stdin";
    checkMaterialNames(scene, look);
    // Whether a material that may blend does so depends on its texels.
    const auto blends = [](const Material& m) { return m.alphaMode == AlphaMode::blend; };
    if (std::ranges::any_of(scene.materials, blends)) decodeImages(scene, look);
    const ResolvedLook resolved = resolveLook(scene, boundsOf(scene), look);
    if (makeLook.savesResolved(look)) makeLook.saveResolved(resolved.look);
    Json json = infoJson(scene, resolved.look);
    if (look.maxError || !resolved.programReason.empty())
      json["choice"] = choiceJson(resolved, look);
    for (const std::string& warning : scene.warnings) printWarning(*model + ": " + warning);
    for (const LeftOut& each : leftOut(scene, resolved.look))
      if (each.shows) printWarning(*model + ": " + leftOutText(each));
    if (*jsonFile != "-" && makeLook.saveFile() != "-") print(json);
    if (!jsonFile->empty())
      writeText(*jsonFile, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    return done;
  };
}

}  // namespace glint
