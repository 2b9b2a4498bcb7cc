# Correlation and strength of baked and shipped AO by octave, from make-shipped-ao's table.
if (terminal eq 'svg') {
  set terminal svg size 1100,430 font 'Helvetica,14' background rgb 'white' enhanced
} else {
  set terminal pngcairo size 1100,430 font 'Helvetica,11' background rgb 'white' enhanced
}
set output picture
set datafile separator comma
set logscale x 2
set xrange [0.8:80]
set xtics (1, 2, 4, 8, 16, 32, 64)
set xlabel "size of the detail, texels (squares, beyond squares twice as wide)"
set grid
materials = "DiamondPlate008C Bricks102 Ground054"
rows(name) = sprintf("< grep '^%s,' %s", name, table)
set multiplot layout 1, 2
set title "do they have the same detail?"
set ylabel "correlation of the two maps' detail"
set yrange [0:1]
set key bottom right
plot for [i = 1:3] rows(word(materials, i)) using 2:3 with linespoints lw 2 pt 7 title word(materials, i)
set title "how much of it?"
set ylabel "RMS of the detail, of white"
set logscale y
set yrange [*:*]
set key bottom right
plot for [i = 1:3] rows(word(materials, i)) using 2:5 with linespoints lw 2 pt 7 lc i title word(materials, i)." shipped", \
     for [i = 1:3] rows(word(materials, i)) using 2:4 with linespoints lw 2 pt 6 dt 2 lc i title "baked"
unset multiplot
