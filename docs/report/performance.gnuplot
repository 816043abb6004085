# Time and memory of a frame against what grows, from performance.csv in the current folder: `relief report performance`
# runs it. Points are medians, bars are quartiles.
set datafile separator ","
set terminal svg size 960, 1500 font "sans,13" background "white"
set linetype 1 linecolor rgb "#1b6ca8"
set linetype 2 linecolor rgb "#b4451f"
set linetype 3 linecolor rgb "#3b7d3b"
set linetype 4 linecolor rgb "#7b4fa3"
set linetype 5 linecolor rgb "#8a6d00"
set linetype 6 linecolor rgb "#222222"
set grid
set logscale xy
set key left top
set format x "10^{%L}"
set format y "%g"

is(scaling, curve) = strcol("scaling") eq scaling && strcol("curve") eq curve
part(scaling, curve, y) = is(scaling, curve) ? column(y) : NaN
of_curve(c, y) = part(scaling, word(curves(scaling), c), y)
of_scene(c, y) = part("threads", word(scenes, c), y)

scalings = "pixels triangles lights texture"
xlabels = "'pixels' 'triangles' 'lights' 'texels of a side'"
curves(scaling) = scaling eq "pixels" ? "'stage 1.25'" : scaling eq "triangles" ? "'height field'" : \
    scaling eq "lights" ? "'a pass for each light' 'a loop in one pass' 'a loop that skips'" : \
    "'mip levels' 'finest level alone'"

scenes = "clear flat_quad trilinear_plane anisotropic_plane layers_32 million_triangles small_triangles stage_1.09 stage_1.25 stage_2.06 stage_4.07"

set multiplot layout 5, 2
do for [n = 1:4] {
    scaling = word(scalings, n)
    set xlabel word(xlabels, n)
    if (scaling eq "lights") { set format x "%g"; set xtics (1, 4, 16, 64, 256); set xrange [0.8:320] }
    if (scaling eq "texture") { set logscale x 2; set xtics (64, 256, 1024, 4096, 16384); set xrange [48:22000] }
    set ylabel "ms a frame"
    plot for [c = 1:words(curves(scaling))] "performance.csv" \
        using (of_curve(c, "x")):(of_curve(c, "median_ms")):(of_curve(c, "lower_ms")):(of_curve(c, "upper_ms")) \
        with yerrorbars linetype c pointtype 7 pointsize 0.5 title word(curves(scaling), c), \
        for [c = 1:words(curves(scaling))] "performance.csv" \
        using (of_curve(c, "x")):(of_curve(c, "median_ms")) with lines linetype c notitle
    set ylabel "memory, MiB"
    plot for [c = 1:words(curves(scaling))] "performance.csv" \
        using (of_curve(c, "x")):(of_curve(c, "memory_MiB")) \
        with linespoints linetype c pointtype 7 pointsize 0.5 title word(curves(scaling), c)
}
unset logscale
unset format
set xtics 1
set autoscale xfix
set xrange [*:*]
set yrange [0:]
set xlabel "threads"
set key outside right top font ",10"
set ylabel "times as fast as one thread"
plot for [c = 1:words(scenes)] "performance.csv" using (of_scene(c, "x")):(of_scene(c, "times_as_fast")) \
    with linespoints linetype 1 + (c - 1) % 6 pointtype c pointsize 0.5 title word(scenes, c) noenhanced
set ylabel "memory, MiB"
plot for [c = 1:words(scenes)] "performance.csv" using (of_scene(c, "x")):(of_scene(c, "memory_MiB")) \
    with linespoints linetype 1 + (c - 1) % 6 pointtype c pointsize 0.5 title word(scenes, c) noenhanced
unset multiplot
