# What putting back costs, from leave-out-instructions.csv in the current folder. `relief report leave-out` runs it, with
# stages ("0.03 0.04") and names ("constants alpha all") set: a group of bars for each name, a bar for each stage.
set datafile separator ","
set terminal svg size 960,540 font "sans,13" background "white"
table = "leave-out-instructions.csv"
array base[words(stages)]
do for [s = 1:words(stages)] {
    stats table using (strcol("stage") eq word(stages, s) && strcol("put_back") eq "nothing" ? column("instructions") : NaN) nooutput
    base[s] = STATS_max
}
place(name) = sum [n = 1:words(names)] (name eq word(names, n) ? n : 0)
set style fill solid 0.8 border -1
pitch = 0.84 / words(stages)
set boxwidth 0.95 * pitch
set grid y
set key outside right top title "stage"
set linetype 5 linecolor rgb "#8a6d00"  # the default is too pale on white
set linetype 9 linecolor rgb "#a0a0a0"  # there are eight by default
set linetype 10 linecolor rgb "#e377c2"
set ylabel "instructions per fragment, % more"
set xtics ("" 0) rotate by -30
do for [n = 1:words(names)] { set xtics add (word(names, n) n) }
set xrange [0.4:words(names) + 0.6]
plot for [s = 1:words(stages)] table \
     using (strcol("stage") eq word(stages, s) && place(strcol("put_back")) > 0 ? place(strcol("put_back")) + (s - (words(stages) + 1) / 2.0) * pitch : NaN):(100 * (column("instructions") / base[s] - 1)) \
     with boxes title word(stages, s)
