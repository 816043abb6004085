# Each method's error against what it costs, from triplanar.csv in the current folder. `relief report triplanar` runs it,
# with counted=1 where instructions were counted.
set datafile separator ","
set terminal svg size 960, (counted ? 900 : 480) font "sans,14" background "white"
methods = "swizzle UDN whiteout 'GPU Gems 3' RNM 'cotangent frame' 'cross products'"
truths = "G1 G2 G3"
set key outside right top
set grid
set linetype 5 linecolor rgb "#8a6d00"  # the default is too pale on white
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
set ylabel "error in degrees (RMS)"

chosen(method) = strcol("table") eq "methods" && strcol("name") eq method && column("tilt") == 45 && column("slope") == 0.5
cost_of(method, x) = chosen(method) ? column(x) : NaN

set multiplot layout (counted ? 2 : 1), 1 title "Tilt 45 degrees, bumps of slope 0.5"
do for [cost in (counted ? "ns instructions" : "ns")] {
    set xlabel cost." per fragment"
    plot for [m = 1:words(methods)] for [t = 1:words(truths)] "triplanar.csv" \
             using (cost_of(word(methods, m), cost)):(column("rms_".word(truths, t))) \
             with points linecolor m pointtype (4 + 2 * t - 1) pointsize 1.2 \
             title (t == 1 ? word(methods, m) : ""), \
         for [t = 1:words(truths)] NaN with points linecolor "black" pointtype (4 + 2 * t - 1) title "to ".word(truths, t)
}
unset multiplot
