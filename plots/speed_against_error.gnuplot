# RMSE of the sky view factor against processor time, one panel per map. Called by make-speed-plots.
if (terminal eq 'svg') {
  set terminal svg size 1200,500 font 'Helvetica,14' background rgb 'white' enhanced
} else {
  set terminal pngcairo size 1200,500 font 'Helvetica,11' background rgb 'white' enhanced
}
set output picture
set datafile separator comma
set datafile columnheaders

# gnuplot splits quoted fields at commas: they go.
rows = "< sed 's/, / /g' '".table."'"
array methods[6] = ['Embree cosine density', 'horizon walk fineness 8', 'our rays', 'horizon walk fineness 16', \
                    'horizon walk planned', 'horizon walk fineness 16 sparse']
array titles[6] = ['Embree 3, its best mode', 'horizon walk, fineness 8', 'own rays', \
                   'horizon walk, fineness 16', 'horizon walk, planned for an error', \
                   'horizon walk, fineness 16, sparse']
# Okabe and Ito's colours, which the colour-blind tell apart.
set linetype 1 linecolor rgb '#000000' pointtype 5 linewidth 1.5 pointsize 0.7
set linetype 2 linecolor rgb '#56b4e9' pointtype 9 linewidth 1.5 pointsize 0.8
set linetype 3 linecolor rgb '#999999' pointtype 7 linewidth 1.5 pointsize 0.7
set linetype 4 linecolor rgb '#0072b2' pointtype 13 linewidth 1.5 pointsize 0.8
set linetype 5 linecolor rgb '#d55e00' pointtype 6 linewidth 2.5 pointsize 1.0
set linetype 6 linecolor rgb '#009e73' pointtype 11 linewidth 1.5 pointsize 0.8

set logscale xy
set xrange [0.03:600]
set yrange [0.0003:0.06]
set format x '10^{%T}'
set format y '10^{%T}'
set grid xtics ytics linecolor rgb '#dddddd' linewidth 0.7 linetype 1
set border 3
set tics nomirror out
set key at screen 0.5, 0.06 center center maxrows 2 Left reverse samplen 2 width 1

set multiplot title "Error of the sky view factor against the time that it takes, 1024 × 1024 texels, set-up included"
array maps[3] = ['brick', 'fbm', 'ground054']
array names[3] = ['brick wall', 'fractal terrain', 'scanned ground (Ground054)']
do for [m = 1:3] {
  set lmargin at screen 0.07 + 0.315 * (m - 1)
  set rmargin at screen 0.07 + 0.315 * (m - 1) + 0.285
  set bmargin at screen 0.25
  set tmargin at screen 0.84
  set title names[m] offset 0, -0.5
  set xlabel 'core-seconds per megatexel'
  if (m == 1) { set ylabel 'RMSE of A (1 = open sky)' } else { unset ylabel; unset key }
  plot for [i = 1:6] rows \
    using (strcol('quantity') eq 'sky view factor' && column('size') == 1024 && strcol('map') eq maps[m] && \
           strcol('method') eq methods[i] ? column('core_s_per_megatexel') : NaN):(column('rmse')) \
    with linespoints linetype i title titles[i]
}
unset multiplot
