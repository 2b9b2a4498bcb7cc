#include <memory>
#include <string>

#include "cli/bake_command.h"
#include "cli/commands.h"
#include "cli/json_line.h"
#include "cli/preset.h"
#include "cli/reach_options.h"

namespace heightlight {
namespace {

void add_texture_options(CLI::App& app, BakeCommand& command) {
  BakeOptions& options = command.options;
  add_pack_options(app, command.pack);
  app.add_flag("--dither", options.dither, "blue noise instead of rounding, for --depth 8");
}

void add_map_content_options(CLI::App& app, BakeCommand& command) {
  BakeOptions& options = command.options;
  app.add_option("--maps", command.maps, "what to bake, separated by commas (ao,normal,bent-normal)")
      ->type_name("MAP,…");
  app.add_option_function<std::string>(
         "--ao", [&options](const std::string& text) { options.uniform_ao = text == "uniform"; },
         "cosine: as light falls on the surface (default); uniform: plain share of solid angle")
      ->check(CLI::IsMember({"cosine", "uniform"}));
  app.add_option(
         "--albedo", command.albedo,
         "of multibounce: a number or R,G,B (linear), '#RRGGBB' (sRGB), or an image of the map's size "
         "(0.5)")
      ->type_name("R|R,G,B|#RRGGBB|FILE");
  add_light_options(app, command.light);
  app.add_option("--max-distance", command.max_distance,
                 "how far occluders count, in world units or percent of the width; not for multibounce, ao-n "
                 "(everywhere)")
      ->type_name("D|P%");
  app.add_option(
         "--falloff", command.falloff,
         "what is nearer than --max-distance occludes: wholly (none, default), or by 1 - d/D (linear), "
         "1 - sqrt(d/D) (sqrt), or by exp(-4 d/D), shifted to end at D (exponential)")
      ->check(CLI::IsMember(falloff_names()));
  app.add_option("--roughness", command.roughness,
                 "of specular-occlusion: GGX's alpha, above 0 and at most 1 (0.13)")
      ->type_name("R");
  app.add_option("--view", command.view,
                 "of specular-occlusion: whence it is seen, in degrees clockwise from north, which is up the "
                 "map, and above the horizontal (0,90)")
      ->type_name("AZIMUTH,ELEVATION");
  app.add_option("--normal-strength", options.normal_strength,
                 "slopes of the normal map times this: 1, the heights' own, or what looks better (1)");
  app.add_option("--detail-scale", command.detail_scale,
                 "of curvature and cavity: standard deviation of the Gaussian mean of the heights, in world "
                 "units or percent of the width (0.25%)")
      ->type_name("D|P%");
  app.add_option("--midlevel", options.midlevel,
                 "of displacement: where in the relief it is none, from 0, the lowest place, to 1 (0.5)");
  app.add_option_function<std::string>(
         "--displacement-unit",
         [&options](const std::string& text) {
           options.displacement_unit = text == "cm" ? DisplacementUnit::centimetre : DisplacementUnit::metre;
         },
         "m: Blender, Godot, glTF, Unity (default); cm: Unreal. World units are taken as metres")
      ->check(CLI::IsMember({"m", "cm"}));
  app.add_flag("--bent-length", options.bent_length, "keep the length of bent normals in alpha");
  app.add_option("--horizon-azimuths", options.horizon_azimuths, "azimuths of the horizon map, 1 to 360 (4)");
  app.add_option_function<std::string>(
         "--azimuth-convention",
         [&options](const std::string& text) { options.azimuth_convention = azimuth_convention_named(text); },
         "of the horizon map: north, clockwise from it (default of open maps), or math, from x toward y")
      ->check(CLI::IsMember({"north", "math"}));
  app.add_option_function<std::string>(
         "--below-horizontal",
         [&options](const std::string& text) { options.below = below_horizontal_named(text); },
         "what lies there where no surface is: sky (default), or ground, which does not shine; then A of a "
         "plane tilted by S is (1 + cos S)/2. Not for ao-n")
      ->check(CLI::IsMember({"sky", "ground"}));
}

std::string describe_maps() {
  std::string text = "Maps:\n";
  for (const MaterialMapName& entry : material_maps()) {
    const std::string name = entry.name;
    text += "  " + name + std::string(21 - name.size(), ' ') + entry.description + "\n";
  }
  return text + "h is the elevation of the horizon, V visibility of the sky; means are over azimuths.\n";
}

}  // namespace

void add_bake_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("bake", "Make material maps: ambient occlusion, bent normals, bounces, …");
  auto options = std::make_shared<BakeCommand>();
  command->add_option("MAP", options->inputs, "heightmaps, or folders of them")->required();
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  add_map_content_options(*command, *options);
  add_texture_options(*command, *options);
  add_load_options(*command, options->load);
  command
      ->add_option(
          "--reliefs", options->reliefs,
          "reliefs of maps by their names, in place of --relief: a file with lines of a name, a relief "
          "and perhaps a width (brick,5cm,1m)")
      ->type_name("FILE|NAME=H,…");
  auto* match = command
                    ->add_option("--match", options->match,
                                 "a normal or AO map that the material came with: the relief is the one at "
                                 "which the heights fit it best")
                    ->type_name("FILE");
  for (const char* other : {"--relief", "--height", "--reliefs"}) match->excludes(command->get_option(other));
  command->add_option("--error", options->options.error,
                      "RMSE wanted of the sky view factor, of the total, and of specular-occlusion (0.002)");
  command->add_option("--azimuths", options->options.azimuths,
                      "azimuths of the sky, an even number (chosen for --error)");
  command
      ->add_option_function<int>(
          "--out-of-core", [options](int side) { options->windows = side; },
          "window by window, of SIDE texels each (as many as memory holds), through files beside the "
          "results; "
          "what was stopped goes on where it was. By itself where memory does not hold a TIFF")
      ->expected(0, 1)
      ->default_val(0)
      ->type_name("SIDE");
  command->add_flag(
      "--sheet", options->sheet,
      "one more file, NAME_sheet.png: heights, ao, bent normals, bounces and a lit sphere, labelled");
  command
      ->add_option(
          "--window", options->window,
          "a part of the map alone, in texels from its upper left corner; what is around it is looked "
          "at all the same")
      ->type_name("COLUMN,ROW,WIDTH,HEIGHT");
  command->add_flag("--skip-existing", options->skip_existing,
                    "leave out maps that were baked as is asked for now, with all files still there");
  command
      ->add_option("--pattern", options->pattern,
                   "of folders, bake the files with such names (*_height.png), whatever they are called")
      ->type_name("GLOB");
  command->add_flag(
      "--report", options->report,
      "also write NAME_report.html of each map: one file for any browser, with pictures that zoom and "
      "flip, and the evidence");
  add_run_options(*command, options->run);
  add_json_option(*command, options->json);
  command->footer(
      describe_maps() + describe_presets() +
      "multibounce holds all bounces: albedo * multibounce is the colour under an even sky. Never give\n"
      "it to an engine that brightens AO again (multi-bounce or coloured AO), nor multiply it by\n"
      "ao: such an engine wants ao. docs/colour-and-bounces.md tells more.\n"
      "Each goes into NAME_map.png; NAME_bake.json says what they hold and what they err by.\n"
      "Examples:\n"
      "  heightlight bake brick.png -o maps --relief 0.05\n"
      "  heightlight bake rock.exr -o maps --maps ao,bent-normal,multibounce --albedo '#a0522d'\n"
      "  heightlight bake heights/ -o maps --maps ao --max-distance 5% --falloff linear "
      "--skip-existing\n"
      "  heightlight bake brick.png -o maps --pack R=ao,G=height --depth 8 --normal-y directx\n"
      "  heightlight bake rock.png -o maps --preset unreal --input roughness=rock_rough.png");
  command->callback([options] { bake(*options); });
}

}  // namespace heightlight
