# RMSE of irradiance under two skies, by method, for each map of a directional table (make-directional).
if (terminal eq 'svg') {
  set terminal svg size 1100,500 font 'Helvetica,14' background rgb 'white' enhanced
} else {
  set terminal pngcairo size 1100,500 font 'Helvetica,11' background rgb 'white' enhanced
}
set output picture
set datafile separator comma
set style data histogram
set style histogram clustered gap 1
set style fill solid border -1
set logscale y
set yrange [0.02:40]
set ylabel "RMSE of the irradiance, % of its mean"
set xtics rotate by -25
set grid ytics
set key top left
set multiplot layout 1, 2
maps = "brick fbm ground054"
do for [sky in "'order 2' gradient"] {
  set title sprintf("sky: %s", sky)
  plot for [i = 1:words(maps)] \
    sprintf("< grep '^%s,%s,' %s", word(maps, i), sky, table) using 4:xtic(3) title word(maps, i)
}
unset multiplot
