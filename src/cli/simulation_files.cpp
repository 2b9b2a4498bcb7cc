#include "cli/simulation_files.h"

#include "files/image_file.h"
#include "files/saved_run.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

/// One map, Y, or three, R, G, B.
void write_channels(const MapFolder& output, const std::string& name, const std::vector<const Map*>& maps,
                    const std::string& meaning) {
  static constexpr const char* kColour[] = {"R", "G", "B"};
  std::vector<std::pair<std::string, const Map*>> channels;
  TextureLayout layout{.width = maps[0]->width,
                       .height = maps[0]->height,
                       .type = SampleType::real,
                       .attributes = {{"ImageDescription", meaning}}};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    channels.push_back({maps.size() == 1 ? "Y" : kColour[i], maps[i]});
    layout.channels.push_back(channels.back().first);
    layout.bands.push_back({.description = meaning});
  }
  write_float_image(output.folder.file(name + ".exr"), channels, layout.attributes);
  if (!output.place) return;
  layout.place = &*output.place;
  write_texture(output.folder.file(name + ".tif"), layout, [&](int first, int count, float* samples) {
    const std::size_t begin = maps[0]->index(first, 0);
    for (std::size_t i = begin; i < maps[0]->index(first + count, 0); ++i) {
      for (const Map* map : maps) *samples++ = map->values[i];
    }
  });
}

std::vector<const Map*> pointers_to(const std::vector<Map>& maps) {
  std::vector<const Map*> pointers;
  for (const Map& map : maps) pointers.push_back(&map);
  return pointers;
}

}  // namespace

std::vector<std::string> simulation_file_names(int bounces) {
  std::vector<std::string> names{"ambient_occlusion.exr",
                                 "sky_view_factor.exr",
                                 "irradiance_total.exr",
                                 "irradiance_direct.exr",
                                 "links.npz",
                                 "obscurance.exr",
                                 "ambient_transfer.exr",
                                 "ambient_occlusion.tif",
                                 "sky_view_factor.tif",
                                 "irradiance_total.tif",
                                 "irradiance_direct.tif",
                                 "obscurance.tif",
                                 "ambient_transfer.tif",
                                 "curves.csv",
                                 "curves.svg",
                                 "curves.png",
                                 "summary.json",
                                 "report.html",
                                 "height.png",
                                 "ambient_occlusion.png",
                                 "sky_view_factor.png",
                                 "irradiance_total.png",
                                 "irradiance_direct.png",
                                 "bounces.png"};
  for (int b = 0; b <= bounces; ++b) {
    names.push_back(bounce_file(b));
    names.push_back(std::filesystem::path(bounce_file(b)).replace_extension(".tif").string());
  }
  return names;
}

void write_map(const MapFolder& output, const std::string& name, const Map& map, const std::string& meaning) {
  write_channels(output, name, {&map}, meaning);
}

void write_totals(const MapFolder& output, const std::vector<Map>& totals) {
  write_channels(output, "irradiance_total", pointers_to(totals),
                 "E / pi of all bounces, at the albedo given");
}

void write_direct(const MapFolder& output, const std::vector<Map>& direct) {
  write_png(output.folder.file("irradiance_direct.png"), colour_picture(direct));
  write_channels(output, "irradiance_direct", pointers_to(direct),
                 "E / pi of the first light, before any bounce");
}

void write_transfer(const MapFolder& output, const AmbientTransfer& found) {
  write_map(output, "obscurance", found.obscurance, "obscurance: O = A + sum of F mu (Umenhoffer et al.)");
  write_channels(output, "ambient_transfer", pointers_to(found.transfer),
                 "ambient transfer: W = O/(1 - sum of F (1 - mu) albedo) (Umenhoffer et al., eq. 6)");
}

void write_occlusion(const MapFolder& output, const Results& results) {
  write_map(output, "ambient_occlusion", results.ambient_occlusion,
            "ambient occlusion: share of the hemisphere's solid angle that sees the sky");
  write_map(output, "sky_view_factor", results.sky_view_factor,
            "sky view factor: cosine-weighted share of the hemisphere that sees the sky");
}

void write_pictures(StagedFolder& folder, const Surface& surface, const Results& results,
                    const std::vector<Image<Rgb8>>& first_bounces, const std::vector<Map>& totals) {
  write_png(folder.file("height.png"), height_picture(surface));
  write_png(folder.file("ambient_occlusion.png"), grey_picture(results.ambient_occlusion));
  write_png(folder.file("sky_view_factor.png"), grey_picture(results.sky_view_factor));
  write_png(folder.file("irradiance_total.png"), colour_picture(totals));
  write_png(folder.file("bounces.png"), picture_strip(first_bounces));
}

}  // namespace heightlight
