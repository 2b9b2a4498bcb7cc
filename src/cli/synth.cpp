#include "heightlight/synth.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/map_options.h"
#include "files/image_file.h"
#include "files/staged_output.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

struct SynthOptions {
  std::string shape;
  std::filesystem::path file;
  int size = 512;
  std::uint64_t seed = 1;
};

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Image<std::uint16_t> to_levels(const Image<float>& heights) {
  Image<std::uint16_t> levels(heights.width, heights.height);
  std::transform(heights.values.begin(), heights.values.end(), levels.values.begin(),
                 [](float height) { return static_cast<std::uint16_t>(std::lround(65535 * height)); });
  return levels;
}

/// A TIFF in tiles. Of fbm no more than some rows are held at once.
void write_tiled(const std::filesystem::path& path, const SynthOptions& options) {
  FillRows fill;
  if (options.shape == "fbm") {
    const FbmRows fbm(options.size, options.seed);
    fill = [fbm](int first, int count, float* samples) {
      std::ranges::copy(fbm.rows(first, count).values, samples);
    };
  } else {
    fill = [heights = synthesize(options.shape, options.size, options.seed)](int first, int count,
                                                                             float* samples) {
      std::copy_n(&heights(first, 0), std::ptrdiff_t{count} * heights.width, samples);
    };
  }
  write_texture(path,
                {.width = options.size, .height = options.size, .channels = {"Y"}, .type = SampleType::real},
                fill);
}

void run_synth(const SynthOptions& options) {
  const std::string extension = lower_case_extension(options.file);
  if (extension != ".png" && extension != ".exr" && extension != ".tif") {
    throw UsageError(options.file.string() +
                     ": the output must be a .png (16 bits), an .exr or a .tif (float)");
  }
  StagedFile file(options.file);
  if (extension == ".tif") {
    write_tiled(file.path(), options);
    return file.commit();
  }
  const Image<float> heights = synthesize(options.shape, options.size, options.seed);
  if (extension == ".png") {
    write_png16(file.path(), to_levels(heights));
  } else {
    write_float_image(file.path(), {{"Y", &heights}});
  }
  file.commit();
}

std::string describe_shapes() {
  std::string text = "Shapes:\n";
  for (const SynthShape& shape : synth_shapes()) {
    text += "  " + shape.name + std::string(9 - shape.name.size(), ' ') + shape.description +
            (shape.tiles ? "" : " (does not tile)") + "\n";
  }
  return text;
}

}  // namespace

void add_synth_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("synth", "Make a heightmap");
  auto options = std::make_shared<SynthOptions>();
  command->add_option("SHAPE", options->shape, "what to make; the list is below")->required();
  command->add_option("-o,--output", options->file, "file to write: .png (16 bits), .exr or .tif (float)")
      ->required()
      ->type_name("FILE");
  command->add_option("--size", options->size, "number of texels on each side (default 512)");
  command->add_option("--seed", options->seed, "seed of fbm, cobbles, brick and concrete (default 1)")
      ->check(whole_number());
  command->footer(describe_shapes() +
                  "Heights run from 0 to 1. Other commands stretch the heights of a .png to the relief, but "
                  "take those of an\n"
                  ".exr or a .tif as they are, so that --width 4 makes the bowl a true spherical cap. A .tif "
                  "is written in\n"
                  "tiles, and fbm is written into it row by row, so that it need not fit in memory.\n"
                  "Examples:\n"
                  "  heightlight synth brick -o wall.png --size 1024 --seed 7\n"
                  "  heightlight synth bowl -o bowl.exr --size 256");
  command->callback([options] { run_synth(*options); });
}

}  // namespace heightlight
