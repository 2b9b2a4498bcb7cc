#include "cli/simulate_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/light_options.h"
#include "cli/noted_command.h"
#include "cli/report_facts.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/saved_run.h"
#include "report/page.h"

namespace heightlight {
namespace {

constexpr std::size_t kMostCurves = 21;
constexpr std::size_t kMostPoints = 200;

std::vector<std::string> channel_names(const std::vector<Map>& maps) {
  return maps.size() == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
}

PagePicture light_picture(const std::string& name, const std::string& about, const std::string& file,
                          const std::vector<Map>& maps) {
  return {.name = name,
          .about = about,
          .file = file,
          .channels = channel_names(maps),
          .preview = preview_of_channels(maps)};
}

PictureGroup picture_group(const SimulateOptions& options, const ReportedSimulation& found) {
  PictureGroup group{.title = "Maps",
                     .about =
                         "All maps stand at the same place: flip between them. 1 is what an open, level "
                         "place has; as light, brightness is encoded as screens show it."};
  const auto add = [&](PagePicture picture) { group.pictures.push_back(std::move(picture)); };
  add({.name = "sky view factor A",
       .about = "The share of the sky that is seen, weighted by the cosine: what an even sky sends.",
       .file = "sky_view_factor.exr",
       .preview = make_preview({&found.results.sky_view_factor})});
  add({.name = "ambient occlusion α",
       .about = "The plain share of the hemisphere's solid angle that sees the sky.",
       .file = "ambient_occlusion.exr",
       .preview = make_preview({&found.results.ambient_occlusion})});
  add(light_picture("total of all bounces",
                    fmt::format("E/π after all bounces, at albedo {}.", printable(options.albedo)),
                    "irradiance_total.exr", found.totals));
  if (!found.direct.empty())
    add(light_picture("direct irradiance", "E₀/π, before any bounce.", "irradiance_direct.exr",
                      found.direct));
  for (std::size_t b = 0; b < found.bounces.size(); ++b) {
    add({.name = b == 0 ? "bounce 0: the sky" : fmt::format("bounce {}", b),
         .about = fmt::format("E/π that bounce {} brings at albedo 1, under an even sky.", b),
         .file = options.save_bounces ? bounce_file(static_cast<int>(b)) : "",
         .preview = found.bounces[b]});
  }
  add({.name = "height",
       .about = "The heights as they were read.",
       .file = "",
       .unit = "world units",
       .kind = PictureKind::plain,
       .preview = make_preview({&found.surface.map.height})});
  return group;
}

/// At most kMostPoints bins: their mean AO, and what value() says of each.
template <class Value>
PageCurve curve_over_bins(const BounceCurves& curves, std::string name, const Value& value) {
  PageCurve curve{.name = std::move(name), .points = {}};
  const std::size_t step = curves.filled.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < curves.filled.size(); i += step)
    curve.points.push_back({curves.filled[i].ao_mean, value(curves.filled[i])});
  return curve;
}

std::string ao_name(AoKind kind) {
  return kind == AoKind::ambient_occlusion ? "ambient occlusion α" : "sky view factor A";
}

PageChart bounce_chart(const BounceCurves& curves) {
  PageChart chart{.title = "Bounces over " + ao_name(curves.kind),
                  .about =
                      "The mean of what each bounce brings (E/π, albedo 1) to places that are so open; "
                      "curves.csv has the spread, too.",
                  .x = ao_name(curves.kind),
                  .y = "E/π",
                  .curves = {},
                  .ordered = true};
  if (curves.filled.empty()) return chart;
  const std::size_t count = std::min(kMostCurves, curves.filled.front().bounces.size());
  for (std::size_t b = 0; b < count; ++b) {
    chart.curves.push_back(curve_over_bins(curves, b == 0 ? "0: the sky" : std::to_string(b),
                                           [b](const CurveBin& bin) { return bin.bounces[b].mean; }));
    chart.curves.back().shown = b < kReportedBounces;
  }
  return chart;
}

PageChart count_chart(const std::vector<BounceCurves>& kinds) {
  PageChart chart{.title = "How open the map is",
                  .about = "The share of all texels in each bin of the curves.",
                  .x = "α, A",
                  .y = "% of the texels",
                  .curves = {}};
  for (const BounceCurves& curves : kinds) {
    double all = 0;
    for (const CurveBin& bin : curves.filled) all += static_cast<double>(bin.count);
    chart.curves.push_back(curve_over_bins(curves, ao_name(curves.kind), [all](const CurveBin& bin) {
      return 100 * static_cast<double>(bin.count) / all;
    }));
  }
  return chart;
}

/// Least, mean and greatest value of a picture's channels, at its preview's cells.
PageTable value_table(const PictureGroup& group) {
  PageTable table{
      .title = "The maps in numbers",
      .about = "Of the pixels shown above: where pictures are shrunk, extremes are those of means.",
      .columns = {{"map"}, {"least"}, {"mean"}, {"greatest"}, {"missing, %"}},
      .rows = {}};
  for (const PagePicture& picture : group.pictures) {
    for (std::size_t c = 0; c < picture.channels.size(); ++c) {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      double sum = 0;
      std::size_t count = 0;
      const Map& map = picture.preview.channels[c];
      for (const float value : map.values) {
        if (std::isnan(value)) continue;
        low = std::min(low, static_cast<double>(value));
        high = std::max(high, static_cast<double>(value));
        sum += static_cast<double>(value);
        ++count;
      }
      if (count == 0) continue;
      const double all = static_cast<double>(map.size());
      table.rows.push_back(
          {{picture.channels.size() > 1 ? picture.name + ", " + picture.channels[c] : picture.name},
           number_cell(low),
           number_cell(sum / static_cast<double>(count)),
           number_cell(high),
           number_cell(100 * (1 - static_cast<double>(count) / all))});
    }
  }
  return table;
}

/// What each bounce brings to the whole map.
PageTable bounce_table(const Simulation& simulation, const BounceCurves& curves) {
  PageTable table{.title = "The bounces in numbers",
                  .about = "At albedo 1, over all texels. At albedo ρ, bounce b counts ρ to the power of b.",
                  .columns = {{"bounce"}, {"mean E/π"}, {"RMSE found"}},
                  .rows = {}};
  if (curves.filled.empty()) return table;
  const std::vector<double>& errors = simulation.evidence.bounce_rmse;
  for (std::size_t b = 0; b < curves.filled.front().bounces.size(); ++b) {
    double sum = 0;
    double count = 0;
    for (const CurveBin& bin : curves.filled) {
      sum += static_cast<double>(bin.count) * bin.bounces[b].mean;
      count += static_cast<double>(bin.count);
    }
    table.rows.push_back({number_cell(static_cast<double>(b)), number_cell(sum / count),
                          b < errors.size() ? number_cell(errors[b], 2) : PageCell{}});
  }
  return table;
}

std::vector<PageFact> asked_facts(const SimulateOptions& options, const Simulation& simulation,
                                  const Surface& surface) {
  std::vector<PageFact> facts = map_facts(surface.map, relief(surface.map), count_missing(surface.map));
  append(facts, method_facts(simulation.evidence));
  facts.push_back({.name = "Albedo of the total", .value = printable(options.albedo)});
  facts.push_back(
      {.name = "Light of the total",
       .value = simulation.light.empty() ? "an even sky of radiance 1" : printable(simulation.light)});
  facts.push_back({.name = "Bounces kept apart", .value = std::to_string(options.bounces)});
  return facts;
}

}  // namespace

std::uint64_t simulation_report_bytes(int width, int height, const Albedo& albedo, bool has_own_light) {
  constexpr std::uint64_t kAlways = 3 + kReportedBounces;  // α, A, heights, and the bounces
  return page_bytes(width, height, kAlways + albedo.channels() + (has_own_light ? 3 : 0));
}

void write_simulation_report(const std::filesystem::path& path, const SimulateOptions& options,
                             const Simulation& simulation, const ReportedSimulation& found) {
  const std::string name = printable(options.map.path.filename());
  Page page{.title = name + ": ambient occlusion and bounces",
            .what = "How diffuse light settles in the relief of " + name +
                    ": how open every texel is to the sky, what reaches it directly, and what comes back "
                    "through bounces from the rest of the surface.",
            .asked = asked_facts(options, simulation, found.surface),
            .reached = reached_facts(simulation.evidence),
            .cost = cost_facts(simulation.seconds.total, simulation.evidence.threads),
            .command = noted_command(),
            .inputs = {input_fact(options.map.path, simulation.facts.sha256)},
            .warnings = warning_lines(simulation.warnings)};
  std::vector<std::filesystem::path> others = light_files(options.light);
  others.insert(others.begin(), options.albedo);
  append(page.inputs, input_facts(others));
  page.groups.push_back(picture_group(options, found));
  for (const BounceCurves& curves : found.curves) page.charts.push_back(bounce_chart(curves));
  page.charts.push_back(count_chart(found.curves));
  page.tables.push_back(value_table(page.groups.front()));
  page.tables.push_back(bounce_table(simulation, found.curves.front()));
  write_bytes(path, page_html(page));
}

}  // namespace heightlight
