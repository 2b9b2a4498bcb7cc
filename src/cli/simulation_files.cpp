#include "cli/simulation_files.h"

#include "files/image_file.h"
#include "files/saved_run.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// One map, Y, or three, R, G, B.
void write_channels(StagedFolder& folder, const std::string& name, const std::vector<Map>& maps,
                    const std::string& meaning) {
  static constexpr const char* kColour[] = {"R", "G", "B"};
  std::vector<std::pair<std::string, const Map*>> channels;
  for (std::size_t i = 0; i < maps.size(); ++i)
    channels.push_back({maps.size() == 1 ? "Y" : kColour[i], &maps[i]});
  write_float_image(folder.file(name), channels, Attributes{{"ImageDescription", meaning}});
}

}  // namespace

std::vector<std::string> simulation_file_names(int bounces) {
  std::vector<std::string> names{"ambient_occlusion.exr",
                                 "sky_view_factor.exr",
                                 "irradiance_total.exr",
                                 "links.npz",
                                 "obscurance.exr",
                                 "ambient_transfer.exr",
                                 "curves.csv",
                                 "curves.svg",
                                 "curves.png",
                                 "summary.json",
                                 "height.png",
                                 "ambient_occlusion.png",
                                 "sky_view_factor.png",
                                 "irradiance_total.png",
                                 "bounces.png"};
  for (int b = 0; b <= bounces; ++b) names.push_back(bounce_file(b));
  return names;
}

void write_map(StagedFolder& folder, const std::string& name, const Map& map, const std::string& meaning) {
  write_float_image(folder.file(name), {{"Y", &map}}, Attributes{{"ImageDescription", meaning}});
}

void write_totals(StagedFolder& folder, const std::vector<Map>& totals) {
  write_channels(folder, "irradiance_total.exr", totals, "E / pi of all bounces, at the albedo given");
}

void write_transfer(StagedFolder& folder, const AmbientTransfer& found) {
  write_map(folder, "obscurance.exr", found.obscurance,
            "obscurance: O = A + sum of F mu (Umenhoffer et al.)");
  write_channels(folder, "ambient_transfer.exr", found.transfer,
                 "ambient transfer: W = O/(1 - sum of F (1 - mu) albedo) (Umenhoffer et al., eq. 6)");
}

void write_occlusion(StagedFolder& folder, const Results& results) {
  write_map(folder, "ambient_occlusion.exr", results.ambient_occlusion,
            "ambient occlusion: share of the hemisphere's solid angle that sees the sky");
  write_map(folder, "sky_view_factor.exr", results.sky_view_factor,
            "sky view factor: cosine-weighted share of the hemisphere that sees the sky");
}

void write_pictures(StagedFolder& folder, const Surface& surface, const Results& results,
                    const std::vector<Map>& first_bounces, const std::vector<Map>& totals) {
  write_png(folder.file("height.png"), height_picture(surface));
  write_png(folder.file("ambient_occlusion.png"), grey_picture(results.ambient_occlusion));
  write_png(folder.file("sky_view_factor.png"), grey_picture(results.sky_view_factor));
  write_png(folder.file("irradiance_total.png"), colour_picture(totals));
  write_png(folder.file("bounces.png"), bounce_strip(first_bounces));
}

}  // namespace heightlight
