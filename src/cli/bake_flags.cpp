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
  app.add_flag("--dither", options.dither, "dither with blue noise instead of rounding; only for --depth 8");
}

void add_map_content_options(CLI::App& app, BakeCommand& command) {
  BakeOptions& options = command.options;
  app.add_option("--maps", command.maps,
                 "maps to bake, separated by commas; the list is below (default ao,normal,bent-normal)")
      ->type_name("MAP,…");
  app.add_option_function<std::string>(
         "--ao", [&options](const std::string& text) { options.uniform_ao = text == "uniform"; },
         "weight of directions in ao; cosine: by the cosine to the normal, as light falls on the surface "
         "(default); uniform: equal per solid angle")
      ->check(CLI::IsMember({"cosine", "uniform"}));
  app.add_option("--albedo", command.albedo,
                 "albedo for multibounce: a number or R,G,B (linear), '#RRGGBB' (sRGB), or an image of the "
                 "size of the map (default 0.5)")
      ->type_name("R|R,G,B|#RRGGBB|FILE");
  add_light_options(app, command.light);
  app.add_option("--max-distance", command.max_distance,
                 "maximum distance at which occluders count, in world units or percent of the width "
                 "(default: no limit); multibounce and ao-n have no limit")
      ->type_name("D|P%");
  app.add_option("--falloff", command.falloff,
                 "how much an occluder at distance d counts within --max-distance D: fully (none, default), "
                 "1 - d/D (linear), 1 - sqrt(d/D) (sqrt), or exp(-4 d/D) shifted to end at D (exponential)")
      ->check(CLI::IsMember(falloff_names()));
  app.add_option("--roughness", command.roughness,
                 "roughness for specular-occlusion: alpha of GGX, above 0 and at most 1 (default 0.13)")
      ->type_name("R");
  app.add_option("--view", command.view,
                 "direction from which specular-occlusion is seen: azimuth clockwise from north (the top of "
                 "the map) and elevation above the horizontal, in degrees (default 0,90)")
      ->type_name("AZIMUTH,ELEVATION");
  app.add_option("--normal-strength", options.normal_strength,
                 "factor by which the slopes of the normal map are multiplied; 1 keeps the slopes of the "
                 "heights (default 1)");
  app.add_option("--detail-scale", command.detail_scale,
                 "standard deviation of the Gaussian that smooths the heights for curvature and cavity, in "
                 "world units or percent of the width (default 0.25%); 0 takes the samples as they are")
      ->type_name("D|P%");
  app.add_option(
      "--midlevel", options.midlevel,
      "height at which displacement is 0, from 0 (lowest place) to 1 (highest place), default 0.5");
  app.add_option_function<std::string>(
         "--displacement-unit",
         [&options](const std::string& text) {
           options.displacement_unit = text == "cm" ? DisplacementUnit::centimetre : DisplacementUnit::metre;
         },
         "unit of displacement, with world units taken as metres: m for Blender, Godot, glTF and Unity "
         "(default), cm for Unreal")
      ->check(CLI::IsMember({"m", "cm"}));
  app.add_flag("--bent-length", options.bent_length, "store the length of the bent normals in alpha");
  app.add_option("--horizon-azimuths", options.horizon_azimuths,
                 "number of azimuths of the horizon map, 1 to 360 (default 4)");
  app.add_option_function<std::string>(
         "--azimuth-convention",
         [&options](const std::string& text) { options.azimuth_convention = azimuth_convention_named(text); },
         "how azimuths of the horizon map count; north: clockwise from north (default of open maps); math: "
         "from x toward y")
      ->check(CLI::IsMember({"north", "math"}));
  app.add_option_function<std::string>(
         "--below-horizontal",
         [&options](const std::string& text) { options.below = below_horizontal_named(text); },
         "what lies below the horizontal where there is no surface: sky (default), or ground, which sends no "
         "light, so that A of a plane tilted by S is (1 + cos S)/2; ground is not for ao-n and "
         "specular-occlusion")
      ->check(CLI::IsMember({"sky", "ground"}));
}

std::string describe_maps() {
  std::string text = "Maps:\n";
  for (const MaterialMapName& entry : material_maps()) {
    const std::string name = entry.name;
    text += "  " + name + std::string(21 - name.size(), ' ') + entry.description + "\n";
  }
  return text + "h is the elevation of the horizon, V the visibility of the sky; means are over azimuths.\n";
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
      ->add_option("--reliefs", options->reliefs,
                   "reliefs of single maps by name; the other maps take --relief. A file has one line per "
                   "map: name, relief and optionally width, such as brick,5cm,1m")
      ->type_name("FILE|NAME=H,…");
  auto* match = command
                    ->add_option("--match", options->match,
                                 "normal or AO map that the material came with; the relief is chosen so that "
                                 "the heights fit this map best")
                    ->type_name("FILE");
  for (const char* other : {"--relief", "--height", "--reliefs"}) match->excludes(command->get_option(other));
  command->add_option("--error", options->options.error,
                      "wanted RMSE of the sky view factor, of the total irradiance and of "
                      "specular-occlusion, above 0 and at most 1 (default 0.002)");
  command->add_option("--azimuths", options->options.azimuths,
                      "number of azimuths of the sky, even, 2 to 65536 (default: as many as --error needs)");
  command
      ->add_option_function<int>(
          "--out-of-core", [options](int side) { options->windows = side; },
          "bake in windows of SIDE × SIDE texels (default: as large as memory allows), with temporary files "
          "beside the results; a stopped bake resumes where it was. Used automatically for a TIFF that does "
          "not fit in memory")
      ->expected(0, 1)
      ->default_val(0)
      ->type_name("SIDE");
  command->add_flag("--sheet", options->sheet,
                    "also write NAME_sheet.png, a labelled overview of heights, ao, bent normals, bounces "
                    "and a lit sphere");
  command
      ->add_option("--window", options->window,
                   "bake only this part of the map, in texels from its upper left corner; its surroundings "
                   "are still taken into account")
      ->type_name("COLUMN,ROW,WIDTH,HEIGHT");
  command->add_flag("--skip-existing", options->skip_existing,
                    "skip maps that were already baked from the same inputs with the same options and whose "
                    "files are all still there");
  command
      ->add_option("--pattern", options->pattern,
                   "in folders, bake all files whose names match this pattern, such as *_height.png, even if "
                   "they are named like other maps")
      ->type_name("GLOB");
  command->add_flag("--report", options->report,
                    "also write NAME_report.html for each map: one file for any browser, with pictures to "
                    "zoom and to flip between, and the evidence for the accuracy");
  add_run_options(*command, options->run);
  add_json_option(*command, options->json);
  command->footer(
      describe_maps() + describe_presets() +
      "multibounce includes all bounces: albedo * multibounce is the colour under a uniform sky. Do not\n"
      "multiply it by ao. An engine that brightens AO itself (multi-bounce or coloured AO) must get ao, "
      "never\n"
      "multibounce. docs/colour-and-bounces.md tells more.\n"
      "Each map is written to NAME_map.png; NAME_bake.json says what the files hold and how large their "
      "errors are.\n"
      "Examples:\n"
      "  heightlight bake brick.png -o maps --relief 0.05\n"
      "  heightlight bake rock.exr -o maps --maps ao,bent-normal,multibounce --albedo '#a0522d'\n"
      "  heightlight bake heights/ -o maps --maps ao --max-distance 5% --falloff linear --skip-existing\n"
      "  heightlight bake brick.png -o maps --pack R=ao,G=height --depth 8 --normal-y directx\n"
      "  heightlight bake rock.png -o maps --preset unreal --input roughness=rock_rough.png");
  command->callback([options] { bake(*options); });
}

}  // namespace heightlight
