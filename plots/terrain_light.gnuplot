# Four maps of one landscape, as grids of numbers (make-terrain-light).
set terminal pngcairo size 1300,1380 font 'Helvetica,13' background rgb 'white' enhanced
set output picture
set yrange [*:*] reverse
set size ratio -1
unset xtics
unset ytics
set palette gray
set format cb '%.2f'
set multiplot layout 2, 2 margins 0.02, 0.92, 0.02, 0.96 spacing 0.11, 0.05
array titles[4] = ["sky view factor A", "sun at 135° from north, 30° high: E_0/π", \
                   "the same with all bounces on snow, albedo 0.9: E/π", "what the bounces add"]
array files[4] = ["ao", "direct", "multibounce", "added"]
array highest[4] = [1, 1, 1, 0.12]
array lowest[4] = [0.75, 0, 0, 0]
do for [i = 1:4] {
  set title titles[i]
  set cbrange [lowest[i]:highest[i]]
  plot folder . "/" . files[i] matrix with image notitle
}
unset multiplot
