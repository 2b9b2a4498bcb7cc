#include "plot/curve_plots.h"

#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>

#include "files/output_file.h"
#include "heightlight/forms.h"
#include "plot/curve_tables.h"
#include "plot/gnuplot_run.h"
#include "plot/tau_panels.h"

namespace heightlight {
namespace {

// Every axis has a fixed range, so that gnuplot never has to find one among no points. Bounces are coloured
// by a viridis without its palest end; other lines by Okabe and Ito's colours for the colour-blind.
constexpr const char* kCurveStyle = R"(
set samples 201
set palette defined (0 '#440154', 1 '#46327e', 2 '#365c8d', 3 '#277f8e', 4 '#1fa187', 5 '#4ac16d', 6 '#a0da39', 7 '#d5e21a')
set cbrange [0:K > 0 ? K : 1]
set cbtics scale 0.4
set key samplen 2.2 spacing 1.15
)";

constexpr const char* kBouncePanel = R"(
set title '{/:Bold Irradiance of each bounce, ρ = 1}'
set xlabel 'ambient occlusion α (bin mean)'
set ylabel 'E_b / π (bin mean)'
set logscale y
set yrange [1e-5:40]
set format y '10^{%T}'
set colorbox horizontal user origin 0.19,0.946 size 0.16,0.006
set cblabel 'bounce b' offset 0,1.1
set cbtics offset 0,0.5
plot for [b=0:K] $bounces using 1:(column(7+b)) with lines lw 1.6 lc palette cb b notitle
unset logscale y
set format y '%g'
unset colorbox
)";

// Seen from the late bounces, whose low ground hides nothing.
constexpr const char* kSurfacePanel = R"(
set title '{/:Bold Bounce × ambient occlusion × irradiance}' offset 0,0.4
set xlabel 'α' offset 0,-0.3
set ylabel 'bounce b' offset 0,-0.3
set zlabel 'E_b / π' norotate offset 3,9
set yrange [K > 1 ? K : 2:1]
set zrange [0:tallest]
set cbrange [0:tallest]
set view 58,38,1.15,1.15
set xyplane 0
bounce_step = K > 12 ? 5 : 1
set ytics bounce_step
set pm3d depthorder border lc rgb '#444444' lw 0.2
if (surface) splot $surface using 1:2:3 with pm3d notitle
if (!surface) splot NaN notitle
unset pm3d
set ytics autofreq
set cbrange [0:K > 0 ? K : 1]
set title offset 0,0
)";

constexpr const char* kSumPanel = R"(
set title '{/:Bold Sum of the bounces, ρ = 1}'
set xlabel 'ambient occlusion α (bin mean)' offset 0,0
set ylabel 'Σ E_b / π' offset 0,0
set yrange [0:1.19]
set key top left horizontal
plot for [b=K:0:-1] $sums using 1:(column(2+b)):(b > 0 ? column(1+b) : 0) with filledcurves lc palette cb b notitle, \
     for [b=0:K] $sums using 1:(column(2+b)) with lines lw 0.4 lc rgb 'white' notitle, \
     $sums using 1:(column(2+K)) with lines lw 2 lc rgb '#D55E00' title sprintf('E_0 + … + E_{%d}', K), \
     $sums using 1:(column(3+K)) with lines lw 2 lc rgb 'black' title 'with the tail'
)";

constexpr const char* kDirectPanel = R"(
set title '{/:Bold Direct irradiance beside its simplifications}'
set ylabel 'E_0 / π'
set yrange [0:1.05]
set key bottom right vertical
plot $bounces using 1:5:6 with filledcurves fc rgb '#f6cdb8' title '5 % to 95 % of the texels', \
     $bounces using 1:7 with lines lw 2 lc rgb '#D55E00' title 'E_0 / π (bin mean)', \
     $notes using 1:2 with lines lw 1.6 dt 4 lc rgb 'black' title 'F_0(α), notes eq. 7', \
     x with lines lw 1.6 dt 2 lc rgb '#0072B2' title 'α alone, notes eq. 4'
)";

constexpr const char* kCountPanel = R"(
set title '{/:Bold Where the data is}'
set xlabel 'α or A (bin centre)'
set ylabel 'texels per bin'
set logscale y
set yrange [0.7:most*4]
set format y '10^{%T}'
set key top left
plot $bounces using 2:4:3 with boxes fs solid 1 noborder fc rgb '#8fbbdc' title 'ambient occlusion α', \
     $sky using 2:4 with lines lw 1.4 lc rgb '#D55E00' title 'sky view factor A'
unset logscale y
set format y '%g'
)";

constexpr const char* kReliefPanel = R"(
set title '{/:Bold First bounce by height amplitude}'
set xlabel 'ambient occlusion α (bin mean)'
set ylabel 'E_1 / π (bin mean)'
set yrange [0:0.5]
set key top right title 'relief / width'
)";

using gnuplotio::Gnuplot;

/// Smallest range that shows the surface, at least a little of it.
double tallest_bounce(const BounceCurves& curves) {
  double tallest = 0.01;
  for (const CurveBin& bin : curves.filled) {
    if (bin.bounces.size() > 1) tallest = std::max(tallest, bin.bounces[1].mean);
  }
  return tallest;
}

std::size_t fullest_bin(const BounceCurves& curves) {
  std::size_t most = 1;
  for (const CurveBin& bin : curves.filled) most = std::max(most, bin.count);
  return most;
}

/// α, and the notes' F₀ and F₁ there.
PlotTable notes_table() {
  constexpr int kPoints = 200;
  PlotTable table;
  for (int i = 0; i <= kPoints; ++i) {
    const AmbientOcclusion alpha(static_cast<double>(i) / kPoints);
    table.push_back({alpha.value, notes_direct(alpha), notes_first_bounce(alpha)});
  }
  return table;
}

void send_data(Gnuplot& script, const CurvePlotInput& input) {
  const BounceCurves& curves = input.ambient_occlusion;
  const std::vector<PlotTable> surface = surface_table(curves);
  script << std::setprecision(7);
  send_table(script, "bounces", bounce_table(curves));
  send_table(script, "sums", sum_table(curves));
  send_table(script, "sky", bounce_table(input.sky_view_factor));
  send_table(script, "notes", notes_table());
  for (std::size_t i = 0; i < input.reliefs.size(); ++i) {
    send_table(script, "relief" + std::to_string(i), bounce_table(well_filled(input.reliefs[i].curves)));
  }
  send_tau_tables(script, curves);
  script << "$surface << e\n";
  script.send2d(surface);
  // A surface takes two scans of two points.
  const bool has_surface = surface.size() > 1 && surface.front().size() > 1;
  script << "K = " << last_bounce(curves) << "\nsurface = " << (has_surface ? 1 : 0)
         << "\ntallest = " << tallest_bounce(curves)
         << "\nmost = " << std::max(fullest_bin(curves), fullest_bin(input.sky_view_factor)) << '\n';
}

/// From low to high relief: a plasma without its palest end.
const char* relief_colour(std::size_t i, std::size_t count) {
  static constexpr std::array<const char*, 7> kPlasma{"#fdc527", "#f89540", "#e66c5c", "#cc4778",
                                                      "#a21d9a", "#6a00a8", "#0d0887"};
  return kPlasma[count > 1 ? i * (kPlasma.size() - 1) / (count - 1) : 0];
}

/// E₁ of all reliefs, and at least the notes' F₁.
double tallest_relief(const CurvePlotInput& input) {
  double tallest = 0.45;
  for (const ReliefCurves& relief : input.reliefs)
    tallest = std::max(tallest, 1.05 * tallest_bounce(well_filled(relief.curves)));
  return tallest;
}

void send_relief_panel(Gnuplot& script, const CurvePlotInput& input) {
  const std::size_t count = input.reliefs.size();
  script << kReliefPanel << "set yrange [0:" << tallest_relief(input) << "]\n";
  if (count > 0)
    script << "set title '{/:Bold First bounce by height amplitude} (copies of " << input.reliefs[0].width
           << " × " << input.reliefs[0].height << ")'\n";
  script << "plot ";
  for (std::size_t i = 0; i < count; ++i) {
    if (last_bounce(well_filled(input.reliefs[i].curves)) < 1) continue;
    script << "$relief" << i << " using 1:8 with lines lw 1.6 lc rgb '" << relief_colour(i, count)
           << "' title sprintf('%g', " << input.reliefs[i].relief_share << "), ";
  }
  script << "$notes using 1:3 with lines lw 1.4 dt 4 lc rgb '#777777' title 'F_1(α), notes eq. 11'\n";
}

}  // namespace

GnuplotResult draw_curves(const std::string& terminal, const CurvePlotInput& input) {
  return run_gnuplot([&](Gnuplot& script) {
    script << "set terminal " << terminal << '\n';
    send_data(script, input);
    script << kShareAxisStyle << kCurveStyle << "set multiplot layout 4,2 title "
           << gnuplot_quoted(input.title) << " font ':Bold,19' noenhanced\n";
    for (const char* panel : {kBouncePanel, kSurfacePanel, kSumPanel, kDirectPanel, kCountPanel})
      script << panel;
    send_relief_panel(script, input);
    send_ratio_panel(script, input.ambient_occlusion);
    send_saturation_panel(script, input.ambient_occlusion);
    script << "unset multiplot\n";
  });
}

void plot_curves(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const CurvePlotInput& input) {
  write_bytes(svg, draw_curves("svg size 1400,2250 font 'sans-serif,17' background 'white'", input).output);
  write_bytes(png, draw_curves("pngcairo size 1400,2250 font 'sans,13' background 'white'", input).output);
}

}  // namespace heightlight
