# Bounce curves against relief. Called by make-height-study.
if (terminal eq 'svg') {
  set terminal svg size 1200,1150 font 'Helvetica,14' background rgb 'white' enhanced
} else {
  set terminal pngcairo size 1200,1150 font 'Helvetica,11' background rgb 'white' enhanced
}
set output picture
set encoding utf8
set datafile separator comma
set datafile missing ''

# Lines of one bounce of one map and relief: α or A (bin mean), texels, mean of E_b / π; bins of fewer than 20 texels
# tell little. Columns: 1 run, 2 map, 3 relief_share, 6 ao_kind, 10 ao_mean, 11 count, 12 bounce, 13 mean.
curve(map, share, bounce) = sprintf("< awk -F, '$2 == \"%s\" && $3 == %s && $6 == \"ambient_occlusion\" && $12 == %d && $11 >= 20 { print $10 \",\" $13 }' %s", map, share, bounce, table)
# Per relief, over the map: mean α, its 5 % and 95 % bins, means of E_0, of E_1 and of E_2 … E_20, and what they leave to 1.
means(map) = sprintf("< awk -F, '$2 == \"%s\" && $6 == \"ambient_occlusion\" { e[$3 + 0, $12] += $11 * $13; if ($12 == 0) { n[$3 + 0] += $11; a[$3 + 0] += $11 * $10 } } END { for (s in n) { late = 0; for (b = 2; b <= 20; b++) late += e[s, b]; print s \",\" a[s] / n[s] \",\" e[s, 0] / n[s] \",\" e[s, 1] / n[s] \",\" late / n[s] \",\" 1 - (e[s, 0] + e[s, 1] + late) / n[s] } }' %s | sort -g", map, table)

array shares[9] = ['0.001', '0.003', '0.01', '0.03', '0.1', '0.3', '1', '3', '10']
array colours[9] = ['#fde725', '#fdc527', '#f89540', '#e66c5c', '#cc4778', '#a21d9a', '#7e03a8', '#4b03a1', '#0d0887']
array maps[3] = ['brick_256_1', 'cobbles_256_1', 'fbm_256_1']
array names[3] = ['brick wall', 'cobblestones', 'fractal terrain']
F1(x) = 27.576937094210385*x*(1 - x)**1.5*exp(-3.3364392003423804*x**0.25)

set grid xtics ytics linecolor rgb '#dddddd' linewidth 0.7 linetype 1
set border 3
set tics nomirror out
set samples 201
set multiplot layout 3,2 margins 0.07, 0.98, 0.06, 0.93 spacing 0.09, 0.09 \
  title 'Effect of the relief, from 1/1000 to 10 times the width, at albedo 1'

set xrange [0:1]
set xlabel 'ambient occlusion α (bin mean)' offset 0,0.5
do for [m = 1:3] {
  set title names[m].': first bounce'
  set ylabel 'E_1 / π (bin mean)'
  set yrange [0:0.5]
  if (m == 1) { set key top right maxrows 5 title 'relief / width' samplen 1.5 } else { unset key }
  plot for [s = 1:9] curve(maps[m], shares[s], 1) using 1:2 with lines linewidth 2 linecolor rgb colours[s] title shares[s], \
    F1(x) with lines linewidth 1.4 dashtype 4 linecolor rgb '#777777' title 'F_1, eq. 11'
  if (m == 1) {
    set key top right maxrows 5 title 'relief / width' samplen 1.5
    set title names[m].': second to sixth bounce at relief 0.01, 0.1 and 1'
    set ylabel 'E_2 … E_6 / π'
    set logscale y
    set yrange [1e-4:1]
    set format y '10^{%T}'
    plot for [k = 1:3] for [b = 2:6] curve(maps[m], shares[2*k+1], b) using 1:2 with lines linewidth 1.6 - 0.2*(b-2) \
      linecolor rgb colours[2*k+1] title b == 2 ? shares[2*k+1] : ''
    unset logscale y
    set format y '%g'
  }
}
set key default
set key inside left bottom opaque notitle samplen 2
set title 'brick wall: where the sky'."'".'s irradiance ends, mean over the map'
set xlabel 'relief / width'
set ylabel 'share of all bounces'
set logscale x
set xrange [0.001:10]
set yrange [0:1]
plot means(maps[1]) using 1:($3+$4+$5+$6) with filledcurves x1 linecolor rgb '#440154' title 'later', \
  means(maps[1]) using 1:($3+$4+$5) with filledcurves x1 linecolor rgb '#365c8d' title 'E_2 … E_{20}', \
  means(maps[1]) using 1:($3+$4) with filledcurves x1 linecolor rgb '#1fa187' title 'E_1', \
  means(maps[1]) using 1:3 with filledcurves x1 linecolor rgb '#d5e21a' title 'E_0'
set title 'mean over the map of α (dashed) and of the first bounce'
set ylabel 'α,  E_1 / π'
set key inside top right
plot for [m = 1:3] means(maps[m]) using 1:4 with linespoints linewidth 2 pointtype 7 pointsize 0.6 linecolor m title names[m], \
  for [m = 1:3] means(maps[m]) using 1:2 with lines linewidth 1.5 dashtype 2 linecolor m notitle
unset multiplot
