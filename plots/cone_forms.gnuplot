# Figure 10 of Jimenez 2016, from data/cone_forms.csv: what directional GTAO's cone errs by, and how that compares with
# the product of cone and cosine in nine harmonics.
set terminal pngcairo size 1100,470 font 'sans,10' background 'white'
set output 'cone_forms.png'
set encoding utf8
set datafile separator ','
set multiplot layout 1,2
set xlabel 'half-angle of the cone α_v, degrees'
set ylabel 'between bent normal and normal θ_v, degrees'
set xrange [0:90]
set yrange [0:90]
set xtics 15
set ytics 15
set size ratio 1
set key off
set palette defined (0 '#f7fbff', 0.5 '#6baed6', 1 '#08306b')
set cbrange [0:1]
set title 'relative error of the coefficients, cosine about the bent normal'
plot 'data/cone_forms.csv' using 1:2:3 skip 1 with image
set palette defined (0 '#2166ac', 1 '#f7f7f7', 2 '#b2182b')
set cbrange [0:2]
set title "its error over the triple product's: below 1 (blue) the cone errs less"
plot 'data/cone_forms.csv' using 1:2:($3/$4) skip 1 with image
unset multiplot
