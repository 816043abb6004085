# The doctor: on how many maps each fault was named, and how long an examination takes, from doctor.csv and
# doctor-times.csv in the current folder: `relief report doctor` runs it.
set datafile separator ","
set terminal svg size 960, 900 font "sans,12" background "white"
set multiplot
set origin 0, 0.34
set size 1, 0.66
set title "maps on which a fault was named, of 7"
set style fill solid 0.8
set boxwidth 0.7
set xtics rotate by -40 scale 0 font ",9"
set yrange [0:7.5]
set ytics 1
set grid ytics
set bmargin 13
set rmargin 26
plot "doctor.csv" every ::2 using 0:3:xtic(1) with boxes linecolor rgb "#1b6ca8" notitle
reset
set datafile separator ","
set origin 0, 0
set size 1, 0.34
set title "an examination, heights included"
set xlabel "texels a side"
set ylabel "ms"
set logscale xy
set xtics (128, 256, 512, 1024, 2048)
set xrange [110:2400]
set grid
plot "doctor-times.csv" every ::1 using 1:2 with linespoints pointtype 7 linecolor rgb "#b4451f" notitle
