# Figure 12 of Jimenez 2016, from data/directional_MAP.csv: mean relative squared error by method and sky, with exact
# openness.
set terminal pngcairo size 1500,430 font 'sans,10' background 'white'
set output 'directional_mrse.png'
set encoding utf8
set datafile separator ','
methods = '"AO, probe" "bent normal, probe" "AO, SH9" "bent normal, SH9" "triple product, SH9" "directional GTAO, SH9" "cone of the spread, SH9" "sh map, SH9"'
maps = 'brick ground054 metalwalkway006 lakes'
skies = 'overcast low-sun binary'
set multiplot layout 1,3
set logscale y
set yrange [1e-5:100]
set format y '10^{%L}'
set style data histograms
set style histogram clustered gap 1
set style fill solid 0.85 noborder
set grid y
set key top left font ',8' samplen 1 maxrows 4
set xtics font ',8'
set ylabel 'mean relative squared error'
mrse(map, sky, method) = real(system(sprintf("awk -F'\"' '{split($1,a,\",\"); split($3,b,\",\"); if (a[1]==\"%s\" && a[2]==\"function\" && a[3]==\"exact\" && $2==\"%s\") print (b[2] < 1e-5 ? 1e-5 : b[2])}' data/directional_%s.csv", sky, method, map)))
do for [sky in skies] {
  set title 'sky: '.sky
  set print $bars
  do for [map in maps] {
    line = map eq 'metalwalkway006' ? 'walkway006' : map
    do for [i = 1:words(methods)] { line = sprintf('%s,%g', line, mrse(map, sky, word(methods, i))) }
    print line
  }
  unset print
  plot for [i = 1:words(methods)] $bars using i + 1:xtic(1) title word(methods, i)
  set key off
  unset ylabel
}
unset multiplot
