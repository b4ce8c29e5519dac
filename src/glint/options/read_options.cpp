#include "glint/options/read_options.h"

#include <CLI/CLI.hpp>
#include <cstdint>

#include "glint/gltf/file.h"
#include "glint/options/ranges.h"
#include "glint/render/decode.h"

namespace glint {

void addConfineOption(CLI::App& command) {
  command.add_flag_function(
      "--confine", [](std::int64_t count) { count > 0 ? gltf::confineModels() : void(); },
      "read nothing that lies outside of the model's folder, wherever its names and links lead; "
      "for models that strangers have sent");
}

void addDecodeLimitOption(CLI::App& command) {
  command
      .add_option_function<double>(
          "--decode-limit",
          [](double mebibytes) { limitDecoding(std::uint64_t(mebibytes * 0x1p20)); },
          "the most that a model's textures may take decoded, in MiB, 1 to 1048576; beyond it "
          "textures larger than the picture can show are halved, and what is still too much is "
          "refused, as is an environment's picture of three times that "
          "[default: 256, or 128 times their size in the file]")
      ->type_name("MIB")
      ->check(numberIn(1.0, 1048576.0))
      ->take_last();
}

}  // namespace glint
