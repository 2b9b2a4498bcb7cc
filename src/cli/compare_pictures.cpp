#include "cli/compare_pictures.h"

#include <fmt/core.h>

#include <algorithm>

#include "comparison/sky_comparison.h"
#include "files/image_file.h"
#include "plot/error_pictures.h"
#include "plot/form_plot.h"
#include "plot/pareto_plot.h"
#include "plot/rendered_sheet.h"

namespace heightlight {

std::string error_picture_name(std::size_t number, std::string method) {
  std::replace(method.begin(), method.end(), ' ', '_');
  return fmt::format("error_{:02}_{}.png", number, method);
}

void write_error_pictures(StagedFolder& folder, const std::vector<ErrorMap>& maps) {
  for (std::size_t i = 0; i < maps.size(); ++i) {
    write_png(folder.file(error_picture_name(i + 1, maps[i].title)), difference_picture(maps[i].differences));
  }
}

void draw_comparison(StagedFolder& folder, const ReportInput& input, Plots& plots) {
  const Comparison& comparison = input.comparison;
  const std::vector<ComparedAlbedo>& albedos = input.scene.albedos;
  plots.draw(folder, {"forms.svg", "forms.png"},
             [&](const auto& paths) { plot_forms(paths[0], paths[1], comparison.panels, input.map_name); });
  std::vector<ParetoPanel> panels{{kSkyQuantity, input.reference.sky_rmse}};
  const std::vector<HorizonCheck>& checks = input.reference.total_evidence.total_checks;
  for (std::size_t a = 0; a < albedos.size(); ++a)
    panels.push_back({total_quantity(albedos[a]), a < checks.size() ? checks[a].total_rmse : 0});
  plots.draw(folder, {"pareto.svg", "pareto.png"}, [&](const auto& paths) {
    plot_pareto(paths[0], paths[1], comparison.rows, panels, input.map_name);
  });
  plots.draw(folder, {"errors.png"}, [&](const auto& paths) {
    plot_error_sheet(paths[0], comparison.shown,
                     {.title = input.map_name, .quantity = "sky view factor, method − reference"});
  });
  plots.draw(folder, {"total_errors.png"}, [&](const auto& paths) {
    plot_error_sheet(paths[0], comparison.total_errors,
                     {.title = input.map_name + ": totals by closed forms on exact AO and on methods'",
                      .quantity = "E/π at albedo " + albedos.back().label + ", form − reference",
                      .columns = static_cast<int>(answering_forms(input.scene.forms).size())});
  });
  // No AO, the forms, the truth.
  const std::size_t columns = answering_forms(input.scene.forms).size() + 2;
  plots.draw(folder, {"showtime.png"}, [&](const auto& paths) {
    plot_rendered(
        paths[0], comparison.rendered,
        {.title = input.map_name + " under an even sky: albedo × E/π, all bounces", .columns = columns});
  });
  plots.draw(folder, {"sky_light.png"}, [&](const auto& paths) {
    plot_rendered(paths[0], comparison.sky_light,
                  {.title = fmt::format("{}: direct irradiance of {}, {:g} E/π", input.map_name,
                                        input.reference.sky.label, kSkyExposure),
                   .columns = (comparison.sky_light.size() + 1) / 2});
  });
  plots.draw(folder, {"directions.png"}, [&](const auto& paths) {
    plot_rendered(
        paths[0], comparison.directions,
        {.title = input.map_name + ": A by GTAO of one slice, alone, in squares of 4 × 4, and in six turns",
         .quantity = "A",
         .columns = comparison.directions.size()});
  });
}

}  // namespace heightlight
