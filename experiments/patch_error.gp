# Draws the figure of docs/consistency.md:
#   gnuplot -e "folder='FOLDER'" experiments/patch_error.gp
# FOLDER/now.csv, facing.csv, peak.csv are by build/patch_error; FOLDER/now/runs.csv and FOLDER/campaign/runs.csv are of
# campaigns with the NEES of every seed, the default and the two other ways. docs/numbers.toml has the commands.
set terminal svg size 900,340 font "sans,12" background "white"
set output folder.'/patch-error.svg'
set datafile separator ","
set multiplot layout 1,2
set title "Mean product of a patch's error with its own, later"
set xlabel "later by, s"
set ylabel "px^2"
set logscale y
set yrange [0.001:1]
set key top right
plot folder.'/peak.csv' using 1:(abs($2)) skip 1 with linespoints pt 7 ps 0.4 lc rgb "#c0392b" title "centered at the corner measure's peak", \
     folder.'/facing.csv' using 1:(abs($2)) skip 1 with linespoints pt 7 ps 0.4 lc rgb "#e69f00" title "centered where edges meet", \
     folder.'/now.csv' using 1:(abs($2)) skip 1 with linespoints pt 7 ps 0.4 lc rgb "#0072b2" title "and the plane estimated"
set title "NEES of the pose, one mark per seed"
unset logscale y
set yrange [0:*]
set xrange [0:10.5]
set xlabel "seed"
set ylabel "NEES / 6"
campaign = folder.'/campaign/runs.csv'
nees(word) = strstrt(strcol("variant"), word) > 0 ? column("mean_nees") : NaN
plot 1 with lines lc rgb "#999999" notitle, \
     campaign using (column("seed")):(nees("peak")) with points pt 7 ps 0.6 lc rgb "#c0392b" notitle, \
     campaign using (column("seed")):(nees("edges")) with points pt 7 ps 0.6 lc rgb "#e69f00" notitle, \
     folder.'/now/runs.csv' using (column("seed")):(column("mean_nees")) with points pt 7 ps 0.6 lc rgb "#0072b2" notitle
unset multiplot
