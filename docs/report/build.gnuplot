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
# A stage stands where it stands among those of now; the earlier table has fewer.
names = " "
stats "build.csv" using (strcol("kind") eq "stage" ? strlen(names = names.strcol("name")." ") : NaN) nooutput
cost(k) = strcol("kind") eq "stage" ? column(k) : NaN
place(k) = strcol("kind") eq "stage" ? words(names[1:strstrt(names, " ".strcol(k)." ")]) : NaN
set xrange [-1:words(names)]
plot before using (place("name")):(cost("cpu_seconds")) with points pointtype 4 title "before", \
     "build.csv" using (place("name")):(cost("cpu_seconds")) with points pointtype 7 title "now"
