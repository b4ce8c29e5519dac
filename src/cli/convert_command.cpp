#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "glint/gltf/file.h"
#include "glint/gltf/patch.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_files.h"
#include "glint/options/add_option.h"
#include "glint/options/help.h"
#include "glint/options/parameters.h"
#include "glint/options/read_options.h"
#include "glint/scene/material_key.h"
#include "stdin_model.h"

namespace glint {
namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  std::string in, out, look;
  std::vector<std::string> materials;
  bool inPlace = false;
};

Look materialsOf(const ConvertOptions& options) {
  Look look, given;
  if (!options.look.empty()) readLookFile(look, options.look);
  const auto parameters = lookParameters();
  const auto material = std::find_if(parameters.begin(), parameters.end(),
                                     [](const Parameter& p) { return p.name == "material"; });
  for (const std::string& text : options.materials) material->read(given, text);
  mergeMaterials(look, given);
  return look;
}

// The materials to edit: those named, or all in the file. The default material is included only if
// a mesh uses it.
std::vector<MaterialPatch> patchesFor(const Scene& scene, const Look& look) {
  const bool all = look.material.contains("");
  std::vector<MaterialPatch> patches;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    const bool last = i + 1 == scene.materials.size();
    const auto keys = materialKeys(material);
    const bool byName = std::any_of(keys.begin() + 1, keys.end(), [&](const std::string& key) {
      return look.material.contains(key);
    });
    const bool shown =
        last && std::any_of(scene.meshes.begin(), scene.meshes.end(),
                            [&](const Mesh& m) { return std::size_t(m.material) == i; });
    if (byName || (all && (!last || shown)))
      patches.push_back(patchOf(i, withEdits(material, look)));
  }
  return patches;
}

void checkKind(const ConvertOptions& options, bool glb) {
  const std::string in = nameOf(options.in);
  if (options.out == "-") return;
  const std::string ending = fs::path(options.out).extension().string();
  if (ending == (glb ? ".glb" : ".gltf")) return;
  throw InputError(options.out + ": " + in + " is a " + (glb ? "GLB" : "JSON") +
                   " file and cannot be converted to the other kind: give a name that ends in " +
                   (glb ? ".glb" : ".gltf"));
}

constexpr std::uint64_t mostCopied = std::uint64_t(8) << 30;

// Passes a file to `use` in parts, until `use` returns false; then returns false.
template <typename Use>
bool forEachPart(const gltf::ByteSource& source, const Use& use) {
  std::vector<std::byte> part(std::size_t(1) << 20);
  for (std::uint64_t at = 0; at < source.size(); at += part.size()) {
    part.resize(std::size_t(std::min<std::uint64_t>(part.size(), source.size() - at)));
    if (!source.read(part.data(), at, part.size()))
      throw InputError("convert: a file next to the model cannot be read: check the disk");
    if (!use(part)) return false;
  }
  return true;
}

bool sameBytes(const fs::path& path, const gltf::ByteSource& source) {
  std::string error;
  const gltf::RegularFile file(path, {}, error);
  if (!error.empty() || file.size() != source.size()) return false;
  std::uint64_t at = 0;
  std::vector<std::byte> there;
  return forEachPart(source, [&](std::span<const std::byte> part) {
    there.resize(part.size());
    const bool read = file.read(there.data(), at, there.size());
    at += part.size();
    return read && std::ranges::equal(there, part);
  });
}

// Copies the files that IN refers to if OUT is in another folder. Everything is checked before
// anything is written.
void copyReferred(const ConvertOptions& options, const std::string& in,
                  std::span<const std::byte> bytes) {
  const fs::path from = fs::path(in).parent_path(), to = fs::path(options.out).parent_path();
  const auto folder = [](const fs::path& p) { return fs::weakly_canonical(p.empty() ? "." : p); };
  if (options.out == "-" || folder(from) == folder(to)) return;
  std::vector<std::pair<std::string, gltf::ByteSource>> copies;
  for (const std::string& uri : referredFiles(bytes, in)) {
    const fs::path name = fs::path(gltf::percentDecoded(uri)).lexically_normal();
    if (name.is_absolute() || name.empty() || *name.begin() == "..")
      throw InputError(in + ": refers to " + gltf::printableUri(uri) +
                       ", outside its folder: write " + options.out + " next to it");
    std::string error;
    gltf::ByteSource content = gltf::openUri(uri, in, error);
    if (!error.empty())
      throw InputError(in + ": " + gltf::printableUri(uri) + ", which it refers to, " + error +
                       ": write " + options.out + " next to it");
    const fs::path target = to / name;
    if (fs::weakly_canonical(target) == fs::weakly_canonical(options.out))
      throw InputError(options.out + ": " + in +
                       " refers to a file of this name: " + "give another name");
    const bool there = fs::exists(target);
    if (there && !sameBytes(target, content))
      throw InputError(target.string() + ": already exists and differs from that of " + in +
                       ": write to another folder");
    if (content.size() > mostCopied)
      throw InputError(target.string() + ": is larger than 8 GiB: write " + options.out +
                       " next to " + in);
    if (!there) copies.emplace_back(target.string(), std::move(content));
  }
  for (const auto& [target, content] : copies) {
    OutputFile file(target);
    forEachPart(content, [&](std::span<const std::byte> part) {
      file.write(part);
      return true;
    });
    file.commit();
  }
}

int convert(const ConvertOptions& options, const std::string& in) {
  std::error_code ignored;
  if (!options.inPlace && fs::equivalent(in, options.out, ignored))
    throw InputError("convert: " + options.out +
                     " is the model itself: give --in-place to edit it");
  const Look look = materialsOf(options);
  Scene scene = loadGltf(in);
  if (isStdin(options.in)) scene.name = "stdin";
  for (const std::string& warning : scene.warnings)
    printWarning(nameOf(options.in) + ": " + warning);
  checkMaterialNames(scene, look);
  const std::vector<std::byte> bytes = readFile(in);
  checkKind(options, isGlb(bytes));
  const auto patches = patchesFor(scene, look);
  if (look.material.empty())
    printWarning(
        "convert: neither --material nor the look edits a material: the file is copied unchanged");
  else if (patches.empty())
    printWarning(
        "convert: " + nameOf(options.in) +
        ": has no material that --material or the look edits: the file is copied unchanged");
  if (std::ranges::any_of(look.material, [](const auto& each) {
        return each.second.highlight || each.second.fresnel;
      }))
    printWarning(
        "convert: highlight and fresnel are not parameters of a file's material: draw with them "
        "(--material, or --save-look and --look)");
  const auto patched = patchGltf(bytes, patches, in);
  if (options.inPlace) forgetReadFile(in);
  OutputFile file(options.out);
  copyReferred(options, in, bytes);
  file.write(patched);
  file.commit();
  return done;
}

}  // namespace

Command addConvert(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("convert", "write edited material parameters into a glTF file");
  command->footer(examples({"convert helmet.glb red.glb --material color=#c04020",
                            "convert helmet.glb shiny.glb --material exponent=500,metalness=1",
                            "convert helmet.glb edited.glb --look a.json"}));
  auto options = std::make_shared<ConvertOptions>();
  command->add_option("IN", options->in, "a glTF 2.0 model; - is stdin")->required();
  command
      ->add_option(
          "OUT", options->out,
          "the model to write, .gltf or .glb like IN: its materials get the parameters in "
          "extras.glint and the nearest values that other viewers read; everything else is kept "
          "byte for byte. Files that it refers to are copied next to it. - is stdout")
      ->required();
  addList(*command, "--material", options->materials, "[NAME:|NAME#N:|#N:]key=value,...",
          "set parameters as in glint render: of every material, of those called NAME, "
          "of the N-th of these, or of the file's N-th; repeatable");
  addOption(*command, "--look", options->look, "FILE",
            "take the material parameters of this look (JSON), or of a picture that glint "
            "has drawn");
  addConfineOption(*command);
  command->add_flag("--in-place", options->inPlace, "allow OUT to be the same file as IN");
  return [options] {
    options->in = localPath(options->in);
    return readModelFile(options->in,
                         [&](const std::string& path) { return convert(*options, path); });
  };
}

}  // namespace glint
