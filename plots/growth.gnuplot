# Time, memory and error against the map's size. Called by make-speed-plots.
if (terminal eq 'svg') {
  set terminal svg size 1100,800 font 'Helvetica,14' background rgb 'white' enhanced
} else {
  set terminal pngcairo size 1100,800 font 'Helvetica,11' background rgb 'white' enhanced
}
set output picture
set datafile separator comma
set datafile columnheaders

# The tables, one after the other, with one line of names.
table = "< grep -hv '^#' ".tables." | awk 'NR == 1 || !/^map,/'"
array maps[2] = ['brick', 'fbm']
array names[2] = ['brick wall', 'fractal terrain']
set linetype 1 linecolor rgb '#d55e00' pointtype 7 linewidth 2 pointsize 0.9
set linetype 2 linecolor rgb '#0072b2' pointtype 5 linewidth 2 pointsize 0.9
only(m, x) = strcol('map') eq maps[m] ? column(x) : NaN

set logscale x 2
set xrange [200:20000]
set xtics ('256²' 256, '512²' 512, '1024²' 1024, '2048²' 2048, '4096²' 4096, '8192²' 8192, '16384²' 16384)
set grid xtics ytics linecolor rgb '#dddddd' linewidth 0.7 linetype 1
set border 3
set tics nomirror out
set key top left reverse Left samplen 2
set xlabel 'texels'

set multiplot layout 2,2 margins 0.08, 0.98, 0.08, 0.9 spacing 0.1, 0.15 \
  title 'How time, memory and error grow with the map (relief a tenth of its width)'

set title 'Sky by a fixed walk: 32 azimuths, 16 samples per octave'
set ylabel 'core-ns per texel and azimuth'
set yrange [0:18]
set key bottom left
plot for [m = 1:2] table using (only(m, 'size')):(column('fixed_walk_core_ns')) with linespoints linetype m \
  title names[m]

set title 'Sky and total of all bounces, planned for an error of 0.002'
set ylabel 'core-seconds'
set logscale y
set yrange [0.05:2000]
set format y '%g'
set key top left
plot 2e-6 * x**2 with lines linecolor rgb '#777777' dashtype 3 title 'in proportion to the texels', for [m = 1:2] table using (only(m, 'size')):(column('core_s')) with linespoints linetype m title names[m]

set title 'Memory of the same'
set ylabel 'bytes per texel, at the peak'
unset logscale y
set yrange [0:1800]
set key top right
plot for [m = 1:2] table using (only(m, 'size')):(column('bytes_per_texel')) with linespoints linetype m \
  title names[m]

set title 'Error, checked by exact walks from some hundred receivers'
set ylabel 'RMSE'
set yrange [0:0.006]
set key top left
plot 0.002 with lines linecolor rgb '#777777' dashtype 3 title 'wanted', \
  for [m = 1:2] table using (only(m, 'size')):(column('rmse_total')) with linespoints linetype m \
  title names[m].', total', \
  for [m = 1:2] table using (only(m, 'size')):(column('rmse_sky')) with linespoints linetype m dashtype 2 \
  title names[m].', A'
unset multiplot
