# What compiling each stage costs, from build.csv in the current folder and from an earlier table. `relief report build`
# runs it, with before ("…/build-before.csv") set.
set datafile separator ","
set terminal svg size 960,480 font "sans,13" background "white"
set grid ytics
set key top left
set xlabel "stages, in the order of the alphabet"
set ylabel "CPU seconds to compile"
set yrange [0:*]
unset xtics
stage(k) = strcol("kind") eq "stage" ? column(k) : NaN
stats "build.csv" using (stage("cpu_seconds")) nooutput
set xrange [-1:STATS_records]
plot before using (stage("cpu_seconds")) with points pointtype 4 title "before", \
     "build.csv" using (stage("cpu_seconds")) with points pointtype 7 title "now"
