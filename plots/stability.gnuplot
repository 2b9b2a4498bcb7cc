# Errors on hard maps, one line per map. Called by make-stability.
if (terminal eq 'svg') {
  set terminal svg size 1000,1250 font 'Helvetica,13' background rgb 'white' enhanced
} else {
  set terminal pngcairo size 1000,1250 font 'Helvetica,10' background rgb 'white' enhanced
}
set output picture
set datafile columnheaders
rows(m) = "< awk -F'\t' 'NR == 1 || $3 == \"".m."\"' ".table
array methods[3] = ['rays', 'exact slices', 'horizon walks']
array titles[3] = ['1024 rays', 'exact slices, 128 azimuths', 'horizon walks, planned for 0.002']
set linetype 1 linecolor rgb '#999999' pointtype 7 pointsize 0.9
set linetype 2 linecolor rgb '#0072b2' pointtype 13 pointsize 1.1
set linetype 3 linecolor rgb '#d55e00' pointtype 6 pointsize 1.2 linewidth 2
set datafile separator tab
set logscale x
set xrange [5e-10:1]
set format x '10^{%T}'
set xlabel 'RMSE of the sky view factor (0 is drawn at the left edge)'
set yrange [count + 0.5:0.5]
set ytics nomirror out font ',9'
set xtics nomirror out
set grid xtics ytics linecolor rgb '#e4e4e4' linewidth 0.7 linetype 1
set border 3
set key outside top center horizontal samplen 1
set lmargin 52
set title 'Hard maps: what each way of finding visibility errs by'
plot for [m = 1:3] rows(methods[m]) using (column('rmse') < 1e-9 ? 1e-9 : column('rmse')):'number':yticlabels(2) \
  with points linetype m title titles[m]
