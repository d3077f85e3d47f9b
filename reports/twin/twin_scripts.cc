#include <reports/twin/twin_scripts.h>

namespace swimtwin::gnuplot_scripts
{
  const std::string_view twin_parameters = R"gp(
set multiplot
left = 0.125; right = 0.965
set xrange [t_min:t_max]
do for [t in alarm_times] {
  set arrow from first t+0, graph 0 to first t+0, graph 1 nohead lc rgb dissipation_color lw 0.8 dt (4,4) back
}
step = (0.835 - 0.115) / n_panels
gap = 0.045
do for [k=0:n_panels-1] {
  top = 0.835 - k * step
  bottom = top - step + (k == n_panels - 1 ? 0 : gap)
  eval(panel)
  if (k > 0) { unset label 1; unset label 2; unset key }
  set format x (k == n_panels - 1 ? '%g' : '')
  if (k == n_panels - 1) { set xlabel 'time (s)' }
  set ylabel value(sprintf('name_%d', k))
  set yrange [value(sprintf('low_%d', k)):value(sprintf('high_%d', k))]
  plot data index k using 1:3:4 with filledcurves lc rgb head_color fs transparent solid 0.22 noborder \
         title (k == 0 ? '95 % band' : ''), \
       data index k using 1:2 with lines lw 2 lc rgb head_color title (k == 0 ? 'estimate' : '')
}
unset multiplot
)gp";

  const std::string_view twin_innovations = R"gp(
set multiplot
left = 0.125; right = 0.965
set xrange [t_min:t_max]
do for [t in alarm_times] {
  set arrow from first t+0, graph 0 to first t+0, graph 1 nohead lc rgb dissipation_color lw 0.8 dt (4,4) back
}
set format x ''
top = 0.835; bottom = 0.62
eval(panel)
set yrange [-5:5]
set ytics 2
set ylabel "position\n(deviations)"
set object 1 rectangle from graph 0, first -1.96 to graph 1, first 1.96 fc rgb pale_color fs solid 0.25 noborder behind
plot data index 0 using 1:2 with points pt 7 ps 0.3 lc rgb head_color title 'x', \
     data index 0 using 1:3 with points pt 7 ps 0.3 lc rgb tail_color title 'y', \
     NaN with filledcurves lc rgb pale_color fs solid 0.25 noborder title '95 % belong here'
eval(without_heading)
unset key
top = 0.58; bottom = 0.37
eval(panel)
unset key
set ylabel "angle\n(deviations)"
plot data index 0 using 1:4 with points pt 7 ps 0.3 lc rgb field_color notitle
unset object 1
top = 0.33; bottom = 0.115
eval(panel)
unset key
set format x '%g'
set xlabel 'time (s)'
set yrange [0:1.05]
set ytics 0.5
set ylabel 'trust'
plot data index 0 using 1:5 with filledcurves y1=0 lc rgb elastic_color fs transparent solid 0.25 noborder notitle, \
     data index 0 using 1:5 with lines lw 2 lc rgb elastic_color notitle
unset multiplot
)gp";

  const std::string_view twin_swim = R"gp(
left = 0.105; right = 0.875; top = 0.835; bottom = 0.115
eval(map_panel)
eval(colorbox_beside)
set format cb '%g'
set cblabel 'time (s)' offset 2.5,0
set cbrange [t_min:t_max]
plot data index 0 using 2:3:1 with lines lw 1.4 lc palette title 'head', \
     data index 1 using 1:2 with lines lw 7 lc rgb '#ffffff' notitle, \
     data index 1 using 1:2 with lines lw 3 lc rgb field_color title (has_path ? 'path' : ''), \
     data index 2 using 1:2 with points pt 6 ps 1.8 lw 2 lc rgb dissipation_color title (has_alarms ? 'alarm' : '')
)gp";
} // namespace swimtwin::gnuplot_scripts
