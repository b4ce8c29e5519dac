#include "render_options.h"

#include "glint/image/error.h"
#include "glint/image/picture_writer.h"
#include "glint/options/add_option.h"
#include "glint/options/read_options.h"

namespace glint {

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  command.add_option("MODEL", options.models, "glTF 2.0 models, .gltf or .glb; - is stdin");
  addOption(command, "-o,--output", options.output, "OUT",
            "the picture: .png (8 or 16 bits, sRGB), .jpg or .webp (8 bits, sRGB), .exr or "
            ".pfm (linear float), - (PNG to stdout); another ending gives a PNG; {model} "
            "is replaced by the model's name, {folder} by that of its folder, {n} by the "
            "model's number, {frame} by the picture's number in a turntable or animation")
      ->required()
      ->take_last();
  addOption(command, "--bit-depth", options.bitDepth, "BITS",
            "bits per channel of a PNG, 8 or 16 [default: 8]");
  addNumber(command, "--quality", options.quality, "Q", 1, 100,
            "quality of a JPEG or WebP, 1 to 100; from 90 on a JPEG has full-resolution "
            "colour, at 100 a WebP is lossless [default: 90]");
  addOption(command, "--output-format", options.formatName, "png|jpg|webp|exr|pfm|raw",
            "format of the pictures, whatever their names; raw is for programs, also for "
            "several pictures on stdout: little-endian 32-bit words GLNT, width, height, "
            "channels (3, or 4 with --no-background), then linear floats, rows from the top")
      ->take_last();
  addOption(command, "--rendering-backend", options.backend,
            "auto|egl|egl-software|osmesa|reference",
            "how to draw; auto tries egl, then osmesa; reference draws in double precision "
            "on the CPU, without OpenGL [default: auto]")
      ->take_last();
  addOption(command, "--json", options.json, "FILE", "write a report of the run; - is stdout");
  addOption(command, "--glsl", options.glsl, "DIR",
            "use the shader files in this folder instead of the built-in ones");
  addNumber(command, "--turntable", options.turntable, "N", 1, 100000,
            "draw N pictures (1 to 100000) while the camera goes once around the model, to the "
            "right");
  addNumber(command, "--frames", options.frames, "N", 1, 100000,
            "draw N pictures (1 to 100000) spread evenly over the animation; the last is one "
            "step before its end, so that the sequence can loop");
  addList(command, "--sweep", options.sweeps, "KEY=FROM:TO:STEPS",
          "draw a labelled contact sheet over a numeric parameter of the look or of a material "
          "([NAME:]exponent, exposure, camera-azimuth-angle, ...); given twice, the second runs "
          "down; STEPS:log or STEPS:linear chooses the spacing");
  command.add_flag(
      "--terms", options.terms,
      "also write the terms whose sum is the picture (ambient, diffuse and specular of each "
      "light, reflection, refraction, emission, background), and normal, depth and ids: as "
      "layers of an EXR, or as one file each (OUT.ambient.png)");
  addConfineOption(command);
  addDecodeLimitOption(command);
  const char* batch = "Batches";
  addOption(command, "--from-list", options.list, "FILE",
            "draw the models of this list, one per line; - reads stdin and draws each as soon "
            "as its line arrives; every picture is reported as one line of JSON on stdout")
      ->group(batch);
  addNumber(command, "--jobs", options.jobs, "N", 1, 1024,
            "number of models read and decoded at the same time, 1 to 1024 [default: the "
            "number of processors, at most 8]")
      ->group(batch);
  command
      .add_flag("--resume", options.resume,
                "skip pictures that already exist and were made from the same model and look")
      ->group(batch);
  addOption(command, "--shard", options.shard, "K/N",
            "draw only every N-th model, starting with the K-th (K from 1 to N), or every "
            "N-th picture of a single model; files of very different sizes are divided by "
            "their sizes")
      ->group(batch);
  addOption(command, "--reference", options.reference, "FILE",
            "compare each picture with this one: exit status 1 if they differ, 4 if the file "
            "does not exist; may contain {model}, {n} and {frame}, as -o may")
      ->group(batch);
  addNumber(command, "--reference-threshold", options.referenceThreshold, "T", 0.0, 1e30,
            "the largest mean FLIP that counts as the same; without it pictures must be "
            "identical")
      ->group(batch);
}

PictureOptions pictureOptions(const RenderOptions& options, const std::string& output) {
  PictureOptions file;
  file.bitDepth = options.bitDepth;
  if (options.quality) file.quality = *options.quality;
  if (!options.formatName.empty())
    file.format = pictureFormatNamed(options.formatName);
  else if (output != "-")
    file.format = pictureFormatOf(output);
  if (!file.format) file.format = &pictureFormat(PictureFormat::Id::png);
  return file;
}

void checkRenderOptions(const RenderOptions& options) {
  if (options.output.empty()) throw InputError("-o: '' is empty: give the name of a picture");
  using Id = PictureFormat::Id;
  const PictureFormat* const named = pictureFormatNamed(options.formatName);
  if (!options.formatName.empty() && (!named || !named->isWritten))
    throw InputError("--output-format: '" + options.formatName +
                     "' is not an output format: give png, jpg, webp, exr, pfm or raw");
  const PictureFormat& format = *pictureOptions(options, options.output).format;
  if (options.models.empty() && !options.hasList())
    throw InputError("render: no MODEL: give models, or a list of them with --from-list");
  if (!options.models.empty() && options.hasList())
    throw InputError("render: MODEL and --from-list: give one of them");
  if (options.output == "-" && options.hasList())
    throw InputError("-o - and --from-list: the list's report goes to stdout: give -o a file name");
  if (options.output == "-" && !options.reference.empty())
    throw InputError("-o - and --reference: only files can be compared: give -o a name");
  if (options.output == "-" && options.terms)
    throw InputError("-o - and --terms: there are several pictures: give -o a name");
  if (options.output == "-" && format.needsFile)
    throw InputError("-o - and --output-format " + options.formatName +
                     ": this format needs a regular file: give -o a name, or the format raw");
  if (format.id == Id::raw && !options.reference.empty())
    throw InputError(
        "--output-format raw and --reference: raw pictures are not read: give another format");
  if (options.turntable > 0 && options.frames > 0 && options.turntable != options.frames)
    throw InputError("--turntable and --frames: give the same number for both");
  if (options.sweeps.size() > 2) throw InputError("--sweep: more than two: give one or two");
  const auto key = [&](std::size_t i) {
    return options.sweeps[i].substr(0, options.sweeps[i].find('='));
  };
  if (options.sweeps.size() == 2 && key(0) == key(1))
    throw InputError("--sweep: twice over " + key(0) + ": give one sweep, or two numbers");
  if (options.bitDepth == 16 && format.id != Id::png)
    throw InputError("--bit-depth: only for PNG, and " + options.output + " is " +
                     std::string(format.name) + ": leave it out");
  if (options.quality && format.id != Id::jpeg && format.id != Id::webp)
    throw InputError("--quality: only for JPEG and WebP, and " + options.output + " is " +
                     std::string(format.name) + ": leave it out");
  if (!options.sweeps.empty() && options.terms)
    throw InputError("--sweep and --terms: give one of them");
  if (options.referenceThreshold && options.reference.empty())
    throw InputError("--reference-threshold: needs --reference FILE");
  if (options.resume && !format.holdsText)
    throw InputError("--resume: " + options.output +
                     " cannot record what a picture was made from: use .png or .exr");
}

}  // namespace glint
