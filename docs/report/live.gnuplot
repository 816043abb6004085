# From a save to the picture, from live.txt in the current folder, which is what `./relief bench --live` prints:
#
#     cd docs/report && gnuplot live.gnuplot
#
# Columns: 4 the median, 5 the worst, 13 an error's median, all in milliseconds. Rows: two of words, then 56 stages.
set terminal svg size 960,420 font "sans,13" background "white"
set output "live.svg"
set grid ytics
set key top left
set xlabel "stages, in the order of the book"
set ylabel "milliseconds from a save"
set xrange [0:57]
set yrange [0:*]
set xtics ("0.01" 1, "1.01" 8, "2.01" 33, "3.01" 39, "4.01" 44) scale 0
plot "live.txt" every ::2::57 using ($0 + 1):4:4:5 with yerrorbars pointtype 7 pointsize 0.6 \
         title "the picture: median and worst", \
     "live.txt" every ::2::57 using ($0 + 1):13 with points pointtype 6 pointsize 0.6 title "an error: median", \
     700 with lines dashtype 2 title "700", 1500 with lines dashtype 3 title "1500"
