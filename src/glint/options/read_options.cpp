#include "glint/options/read_options.h"

#include <CLI/CLI.hpp>
#include <cstdint>

#include "glint/gltf/file.h"
#include "glint/options/add_option.h"
#include "glint/render/decode.h"

namespace glint {

void addConfineOption(CLI::App& command) {
  command.add_flag_function(
      "--confine", [](std::int64_t count) { count > 0 ? gltf::confineModels() : void(); },
      "read no file outside the model's folder, wherever names and links in it lead; for "
      "untrusted models");
}

void addDecodeLimitOption(CLI::App& command) {
  command
      .add_option_function<double>(
          "--decode-limit",
          [](double mebibytes) { limitDecoding(std::uint64_t(mebibytes * 0x1p20)); },
          "limit on the memory of a model's decoded textures, in MiB, 1 to 1048576; beyond it, "
          "textures larger than the picture can show are halved, and a model that still exceeds "
          "it is refused, as is an environment picture of more than three times that [default: "
          "256, or 128 times their size in the file if that is more]")
      ->type_name("MIB")
      ->check(numberIn(1.0, 1048576.0))
      ->take_last();
}

}  // namespace glint
