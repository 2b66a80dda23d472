# Draws the figure of docs/consistency.md:
#   gnuplot -e "now='now.csv'; facing='facing.csv'; peak='peak.csv'; nees='nees.txt'; out='patch-error.svg'" \
#     experiments/patch_error.gp
# The first three come from build/patch_error; nees has a row per seed with the NEES of the three ways.
set terminal svg size 900,340 font "sans,12" background "white"
set output out
set datafile separator ","
set multiplot layout 1,2
set title "Mean product of a patch's error with its own, later"
set xlabel "later by, s"
set ylabel "px^2"
set logscale y
set yrange [0.001:1]
set key top right
plot peak using 1:(abs($2)) skip 1 with linespoints pt 7 ps 0.4 lc rgb "#c0392b" title "centred at the corner measure's peak", \
     facing using 1:(abs($2)) skip 1 with linespoints pt 7 ps 0.4 lc rgb "#e69f00" title "centred where edges meet", \
     now using 1:(abs($2)) skip 1 with linespoints pt 7 ps 0.4 lc rgb "#0072b2" title "and the plane learnt"
set title "NEES of the pose, one mark per seed"
unset logscale y
set yrange [0:3.5]
set xrange [0:21]
set xlabel "seed"
set ylabel "NEES / 6"
set datafile separator whitespace
plot 1 with lines lc rgb "#999999" notitle, \
     nees using 1:2 with points pt 7 ps 0.6 lc rgb "#c0392b" notitle, \
     nees using 1:3 with points pt 7 ps 0.6 lc rgb "#e69f00" notitle, \
     nees using 1:4 with points pt 7 ps 0.6 lc rgb "#0072b2" notitle
unset multiplot
