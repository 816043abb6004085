# The variants of an experiment: error against time, from ID.csv in the current folder. `relief report error` runs it,
# with id, unit, item, names ("'one, 8 bits' 'another, 8 bits'"), groups ("'one' 'another'"), front ("0 2": the
# undominated rows by error) and joined (1: by a line) set. What is exact has no place on a logarithmic axis: it stands a decade left of the smallest error.
set datafile separator ","
set terminal svg size 960,540 font "sans,13" background "white"
table = id.".csv"
stats table using (column("err_rms") > 1e-12) nooutput
smallest = 1e-3
if (STATS_sum > 0) {
    stats table using (column("err_rms") > 1e-12 ? log10(column("err_rms")) : 1/0) nooutput
    smallest = 10 ** (floor(STATS_min) - 1)
} else {
    set xrange [smallest / 10 : smallest * 10]
}
shown(error) = error > 1e-12 ? error : smallest
array X[words(names)]
array Y[words(names)]
do for [r = 1:words(names)] {
    stats table using (shown(column("err_rms"))):(column("ns_min")) every ::(r-1)::(r-1) nooutput
    X[r] = STATS_max_x
    Y[r] = STATS_max_y
}
do for [k = 2:(joined ? words(front) : 1)] {
    from = int(word(front, k - 1)) + 1
    to = int(word(front, k)) + 1
    set arrow from X[from], Y[from] to X[to], Y[to] nohead linecolor "gray40" linewidth 2
}
set linetype 5 linecolor rgb "#8a6d00"  # the default is too pale on white
set logscale xy
set format x "10^{%T}"
set grid
set key outside right top font ",11"
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
set xlabel "RMS error in ".unit." (".gprintf("10^{%T}", smallest)." stands for exact)"
set ylabel "ns per ".item
# Many variants are told apart by their names alone, not by their parameters, and those that are not on the front are
# small.
of(group, front) = strcol("variant") eq group && column("on_front") == front ? shown(column("err_rms")) : NaN
if (words(names) > 24) {
    plot for [g = 1:words(groups)] table using (of(word(groups, g), 0)):(column("ns_min")) \
             with points linecolor g pointtype 7 pointsize 0.4 notitle, \
         for [g = 1:words(groups)] table using (of(word(groups, g), 1)):(column("ns_min")) \
             with points linecolor g pointtype (4 + g % 10) pointsize 1.1 linewidth 2 title word(groups, g)
} else {
    plot for [r = 1:words(names)] table using (X[r]):(Y[r]) every ::0::0 \
             with points linecolor r pointtype (4 + r % 10) pointsize 1.3 linewidth 2 title word(names, r)
}
