#include <cmath>
#include <memory>
#include <numbers>

#include "commands.h"
#include "glint/image/error.h"
#include "glint/image/picture_writer.h"
#include "glint/options/add_option.h"
#include "glint/options/help.h"
#include "glint/shading/environment_map.h"

namespace glint {
namespace {

struct EnvironmentOptions {
  std::string name, output;
  int height = 512;
};

BuiltinEnvironment environmentNamed(const std::string& name) {
  if (name == "studio") return BuiltinEnvironment::studio;
  if (name == "sky") return BuiltinEnvironment::sky;
  if (name == "white") return BuiltinEnvironment::white;
  throw InputError("environment: '" + name + "' is not one of studio, sky, white");
}

int writeEnvironment(const EnvironmentOptions& options) {
  const BuiltinEnvironment environment = environmentNamed(options.name);
  if (options.height < 1 || options.height > 8192)
    throw InputError("--height: '" + std::to_string(options.height) +
                     "' is not a whole number from 1 to 8192");
  const int width = 2 * options.height;
  const auto writer = openPictureWriter(options.output, width, options.height);
  Image row{width, 1, {}};
  row.values.resize(std::size_t(4) * width);
  for (int y = 0; y < options.height; ++y) {
    const double theta = std::numbers::pi * (y + 0.5) / options.height;
    for (int x = 0; x < width; ++x) {
      const double phi = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5);
      const glm::dvec3 e = environmentRadiance(
          environment,
          {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
      float* pixel = row.values.data() + std::size_t(4) * x;
      for (int c = 0; c < 3; ++c) pixel[c] = float(e[c]);
      pixel[3] = 1;
    }
    writer->write(row);
  }
  writer->finish();
  return done;
}

}  // namespace

Command addEnvironment(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "environment", "write a built-in environment as a picture that --hdri-file reads");
  command->footer(examples({"environment sky -o sky.exr", "environment studio -o studio.png"}));
  auto options = std::make_shared<EnvironmentOptions>();
  command->add_option("NAME", options->name, "studio, sky or white")->required();
  addOption(*command, "-o,--output", options->output, "OUT",
            "the picture: .exr or .pfm (linear float), .png, .jpg or .webp (8 bit sRGB)")
      ->required()
      ->take_last();
  addOption(*command, "--height", options->height, "PIXELS",
            "height in pixels; the picture is twice as wide [default: 512]");
  return [options] { return writeEnvironment(*options); };
}

}  // namespace glint
