#include <reports/plan/plan_scripts.h>

namespace swimtwin::gnuplot_scripts
{
  const std::string_view planned_field = R"gp(
set multiplot
left = 0.105; right = 0.965
set xrange [0:1]
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
set offsets 0,0,graph 0.05,graph 0.05
color(k) = k == n_fields - 1 ? head_color : pale_color
top = 0.835; bottom = 0.50
eval(panel)
set format x ''
set ylabel 'b_x (mT)'
plot for [k=0:n_fields-1] data index k using 1:2 with lines lw 2.6 lc rgb color(k) title value(sprintf('name_%d', k))
eval(without_heading)
top = 0.445; bottom = 0.12
eval(panel)
unset key
set format x '%g'
set xlabel 'phase'
set ylabel 'b_y (mT)'
plot for [k=0:n_fields-1] data index k using 1:3 with lines lw 2.6 lc rgb color(k) notitle
unset multiplot
)gp";

  const std::string_view hodograph = R"gp(
left = 0.105; right = 0.875; top = 0.835; bottom = 0.12
eval(panel)
eval(one_scale)
set xlabel 'b_x (mT)'
set ylabel 'b_y (mT)'
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
set yzeroaxis lt 1 lw 0.8 lc rgb pale_color
eval(cyclic_palette)
set cbrange [0:1]
set cblabel 'phase' offset 2.5,0
eval(colorbox_beside)
eval(phase_tics)
set object 1 circle at 0,0 size first largest fs empty border rgb note_color dt (6,6) lw 1.2
last = int(n_fields) - 1
plot for [k=0:last-1] data index k using 2:3 with lines lw 2.2 lc rgb pale_color title value(sprintf('name_%d', k)), \
     data index last using 2:3:1 with lines lw 4 lc palette title value(sprintf('name_%d', last))
)gp";

  const std::string_view head_path = R"gp(
left = 0.105; right = 0.965; top = 0.835; bottom = 0.12
eval(map_panel)
unset colorbox
set cbrange [0:larger(1, n_fields - 1)]
plot for [k=0:n_fields-1] data index k using 1:2 with lines lw 2.2 lc palette cb k title value(sprintf('name_%d', k)), \
     for [k=0:n_fields-1] data index k + n_fields using 1:2 with points pt 7 ps 1.2 lc palette cb k notitle
)gp";

  const std::string_view gains = R"gp(
left = 0.105; right = 0.965; top = 0.835; bottom = 0.16
eval(panel)
unset key
set boxwidth 0.6
set xrange [-0.6:n_bars - 0.4]
set yrange [0:*]
set offsets 0,0,graph 0.1,0
set ylabel 'mean speed (µm/s)'
set xtics () # named below
set for [k=0:n_bars-1] xtics add (value(sprintf('bar_%d', k)) k)
plot data using 1:2:($3 > 0 ? 0xd1662b : 0x1d4e89) with boxes lc rgb variable fs solid 0.75 noborder, \
     data using 1:2:(sprintf('%.0f', $2)) with labels offset 0,0.8 tc rgb text_color
)gp";

  const std::string_view trade_off = R"gp(
set multiplot
left = 0.105; right = 0.965
set offsets graph 0.03,graph 0.03,graph 0.08,graph 0.05
top = 0.835; bottom = 0.46
eval(panel)
set format x ''
set ylabel 'mean speed (µm/s)'
plot data using 1:3 with linespoints lw 2.4 pt 7 ps 1.6 lc rgb head_color title 'optimal field', \
     data using 1:2 with linespoints lw 2.4 pt 5 ps 1.6 lc rgb tail_color title 'tuned sinusoid'
eval(without_heading)
top = 0.39; bottom = 0.12
eval(panel)
set format x '%g'
set xlabel 'largest Floquet multiplier allowed, per period'
set ylabel 'gain'
plot data using 1:4 with linespoints lw 2.4 pt 7 ps 1.6 lc rgb field_color notitle
unset multiplot
)gp";

  const std::string_view search_trace = R"gp(
set multiplot
left = 0.105; right = 0.965
top = 0.835; bottom = 0.46
eval(panel)
set logscale x
set format x ''
set xrange [1:*]
set ylabel 'objective (1: reference)'
unset colorbox
set cbrange [0:larger(1, n_fields - 1)]
plot for [k=0:n_fields-1] data index k using 1:($3 <= 1e-5 ? $2 : NaN) with steps lw 2.4 lc palette cb k title value(sprintf('name_%d', k))
eval(without_heading)
top = 0.39; bottom = 0.12
eval(panel)
unset key
set format x '%g'
set xlabel 'periods integrated'
set ylabel 'limits missed by'
set logscale y
set format y '10^{%T}'
set yrange [1e-7:10]
plot for [k=0:n_fields-1] data index k using 1:($3 > 1e-7 ? $3 : 1e-7) with steps lw 2.4 lc palette cb k notitle
unset multiplot
)gp";

  const std::string_view led_course = R"gp(
set multiplot
left = 0.125; right = 0.965
set xrange [t_min:t_max]
set format x ''
top = 0.835; bottom = 0.60
eval(panel)
set yrange [0:*]
set offsets 0,0,graph 0.05,0
set ylabel (is_relative ? "distance (% of\nbody length)" : 'distance (µm)')
plot data index 0 using 1:(has_deviation ? $6 : NaN) with lines lw 1.6 lc rgb pale_color title (has_deviation ? 'deviation of the position' : ''), \
     data index 0 using 1:2 with lines lw 1.6 lc rgb head_color title (has_deviation ? 'mean position to path, as estimated' : '')
eval(without_heading)
top = 0.55; bottom = 0.36
eval(panel)
set yrange [*:*]
set ylabel 'field (mT)'
plot data index 0 using 1:3 with lines lw 0.8 lc rgb head_color title 'b_x', \
     data index 0 using 1:4 with lines lw 0.8 lc rgb tail_color title 'b_y'
set format x '%g'
top = 0.31; bottom = 0.115
eval(panel)
unset key
set yrange [0:*]
set xlabel 'time (s)'
set ylabel "time of a\ndecision (ms)"
plot data index 0 using 1:5 with points pt 7 ps 0.3 lc rgb field_color notitle
unset multiplot
)gp";
} // namespace swimtwin::gnuplot_scripts
