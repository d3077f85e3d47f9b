#include <reports/fit/calibration_scripts.h>

namespace swimtwin::calibration_scripts
{
  // Blocks of set k: 3k the curve with its bands, 3k+1 the data, 3k+2 the residuals.
  const std::string_view fit = R"gp(
array set_color[6] = [head_color, tail_color, elastic_color, external_color, dissipation_color, field_color]
array set_mark[6] = [7, 5, 9, 11, 13, 15]
color(k) = set_color[int(k) % 6 + 1]
mark(k) = set_mark[int(k) % 6 + 1]
set multiplot
left = 0.105; right = 0.965
set xrange [f_min:f_max]

top = 0.825; bottom = 0.395
eval(panel)
eval(upper_tics)
set offsets 0,0,graph 0.06,graph 0.06
set ylabel 'displacement per period (mm)'
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
plot for [k=0:n_sets-1] data index 3*int(k) using 1:5:6 with filledcurves lc rgb color(k) fs transparent solid 0.09 noborder notitle, \
     for [k=0:n_sets-1] data index 3*int(k) using 1:3:4 with filledcurves lc rgb color(k) fs transparent solid 0.25 noborder notitle, \
     for [k=0:n_sets-1] data index 3*int(k) using 1:2 with lines lw 2.0 lc rgb color(k) notitle, \
     for [k=0:n_sets-1] data index 3*int(k)+1 using 1:2:3 with yerrorbars pt mark(k) ps 1.4 lw 1.4 lc rgb color(k) title value(sprintf('name_%d', k)), \
     for [k=0:n_sets-1] data index 3*int(k)+1 using ($4 < 0.5 ? $1 : NaN):2 with points pt 6 ps 3.2 lw 1.6 lc rgb dissipation_color title (k == 0 && has_outliers ? 'weight below ½' : '')
eval(without_heading)

top = 0.355; bottom = 0.12
eval(panel)
unset key
eval(lower_tics)
set offsets 0,0,0,0
set yrange [-r_max:r_max]
set xlabel 'frequency (Hz)'
set ylabel 'residual (σ)'
set ytics r_step
set object 1 rectangle from graph 0, first -1 to graph 1, first 1 fc rgb pale_color fs transparent solid 0.25 noborder behind
plot for [k=0:n_sets-1] data index 3*int(k)+2 using 1:2 with impulses lw 1.2 lc rgb color(k) notitle, \
     for [k=0:n_sets-1] data index 3*int(k)+2 using 1:2 with points pt mark(k) ps 1.4 lc rgb color(k) notitle, \
     for [k=0:n_sets-1] data index 3*int(k)+2 using ($3 < 0.5 ? $1 : NaN):2 with points pt 6 ps 3.2 lw 1.6 lc rgb dissipation_color notitle
unset multiplot
)gp";

  // Blocks of profile k: 4k the profile, 4k+1 the parabola of the curvature, 4k+2 the interval's ends, 4k+3 the
  // estimate.
  const std::string_view profiles = R"gp(
set multiplot
n_columns = n_profiles < 3 ? n_profiles : (n_profiles == 4 ? 2 : 3)
n_lines = ceil(n_profiles / n_columns)
gap_x = 0.075; gap_y = 0.13
wide = (0.86 - gap_x*(n_columns - 1)) / n_columns
tall = (0.705 - gap_y*(n_lines - 1)) / n_lines
do for [k=0:int(n_profiles)-1] {
  column = k % int(n_columns); line = k / int(n_columns)
  left = 0.105 + column*(wide + gap_x); right = left + wide
  top = 0.825 - line*(tall + gap_y); bottom = top - tall
  eval(panel)
  threshold = value(sprintf('threshold_%d', k))
  set xrange [value(sprintf('low_%d', k)):value(sprintf('high_%d', k))]
  if (value(sprintf('logarithmic_%d', k))) { set logscale x; set xtics autofreq } else { unset logscale x; set xtics value(sprintf('step_%d', k)) }
  set yrange [0:2.6*threshold]
  set xlabel value(sprintf('name_%d', k))
  set ylabel (column == 0 ? '2 × misfit increase' : '')
  unset key
  set arrow 1 from graph 0, first threshold to graph 1, first threshold nohead dt (6,5) lw 1.2 lc rgb note_color
  set label 3 level at graph 0.985, first threshold right offset 0,0.55 font ',15' tc rgb note_color
  plot data index 4*k+1 using 1:2 with lines lw 1.4 dt (3,4) lc rgb note_color notitle, \
       data index 4*k using 1:2 with linespoints pt 7 ps 0.8 lw 2.2 lc rgb head_color notitle, \
       data index 4*k+2 using 1:2 with impulses lw 1.4 lc rgb tail_color notitle, \
       data index 4*k+3 using 1:2 with points pt 13 ps 1.9 lc rgb tail_color notitle
  unset label 1; unset label 2
}
left = 0.105; right = 0.965; top = 0.825; bottom = 0.12
eval(panel)
set key width 0 maxrows 1
unset border; unset tics; unset xlabel; unset ylabel; unset arrow 1; unset label 3
set xrange [0:1]; set yrange [0:1]
plot NaN with lines lw 1.4 dt (3,4) lc rgb note_color title 'curvature', \
     NaN with linespoints pt 7 ps 0.8 lw 2.2 lc rgb head_color title 'profile', \
     NaN with lines lw 1.4 lc rgb tail_color title 'interval', \
     NaN with points pt 13 ps 1.9 lc rgb tail_color title 'estimate'
unset multiplot
)gp";

  const std::string_view waterfall = R"gp(
left = 0.105; right = 0.965; top = 0.825; bottom = 0.12
eval(panel)
set xrange [0.4:n_starts + 0.6]
set xlabel 'start, by the misfit it reached'
set ylabel 'misfit'
set xtics tick_step
set yrange [m_min:m_max]
if (logarithmic) { set logscale y; set format y '%g' }
plot data index 0 using 1:2:(0):($3-$2) with vectors nohead lw 0.8 lc rgb pale_color notitle, \
     data index 0 using 1:2 with points pt 6 ps 1.0 lw 1.2 lc rgb note_color title 'at the start', \
     data index 0 using 1:($4 > 0 ? $3 : NaN) with points pt 7 ps 1.6 lc rgb head_color title 'converged', \
     data index 0 using 1:($4 > 0 ? NaN : $3) with points pt 5 ps 1.4 lc rgb tail_color title (all_converged ? '' : 'did not converge')
)gp";

  // Block 0 the samples, one column per parameter; 1 + k the histogram of k; then one ellipse for each pair a < b.
  const std::string_view pairs = R"gp(
set multiplot
n = int(n_parameters)
small = n > 4 ? ',13' : (n > 2 ? ',16' : ',19')
tic_font = n > 3 ? ',15' : ',19'
gap = n > 3 ? 0.014 : 0.022
wide = (0.875 - gap*(n - 1)) / n
tall = (0.735 - gap*(n - 1)) / n
pair_of(a, b) = 1 + n + b*(b - 1)/2 + a
do for [b=0:n-1] { do for [a=0:b] {
  left = 0.095 + a*(wide + gap); right = left + wide
  top = 0.855 - b*(tall + gap); bottom = top - tall
  eval(panel)
  unset key
  set xrange [value(sprintf('low_%d', a)):value(sprintf('high_%d', a))]
  set xtics value(sprintf('step_%d', a)) font tic_font
  set format x (b == n-1 ? '%g' : '')
  set xlabel (b == n-1 ? value(sprintf('short_%d', a)) : '') font small
  x_0 = value(sprintf('estimate_%d', a))
  if (a == b) {
    set yrange [0:*]
    unset ytics
    set label 3 (b == 0 ? 'count' : '') at screen 0.022, 0.5*(top + bottom) center rotate by 90 font small tc rgb text_color
    set offsets 0,0,graph 0.08,0
    set arrow 1 from first x_0, graph 0 to first x_0, graph 1 nohead lw 1.4 lc rgb tail_color
    plot data index 1 + a using 1:2 with boxes lc rgb head_color fs transparent solid 0.35 noborder
  } else {
    y_0 = value(sprintf('estimate_%d', b))
    set offsets 0,0,0,0
    set yrange [value(sprintf('low_%d', b)):value(sprintf('high_%d', b))]
    set ytics value(sprintf('step_%d', b)) out nomirror scale 0.5 textcolor rgb text_color font tic_font
    set format y (a == 0 ? '%g' : '')
    set label 3 (a == 0 ? value(sprintf('short_%d', b)) : '') at screen 0.022, 0.5*(top + bottom) center rotate by 90 font small tc rgb text_color
    set arrow 1 from first x_0, graph 0 to first x_0, graph 1 nohead lw 0.8 lc rgb tail_color
    set arrow 2 from graph 0, first y_0 to graph 1, first y_0 nohead lw 0.8 lc rgb tail_color
    plot data index 0 using (column(a+1)):(column(b+1)) with points pt 7 ps 0.55 lc rgb '#991d4e89', \
         data index pair_of(a, b) using 1:2 with lines lw 1.8 lc rgb tail_color
    unset arrow 2
  }
  unset arrow 1; unset label 1; unset label 2; unset label 3
} }
unset multiplot
)gp";

  const std::string_view next_experiment = R"gp(
set multiplot
left = 0.105; right = 0.965
set xrange [f_min:f_max]
top = 0.825; bottom = 0.49
eval(panel)
eval(upper_tics)
set offsets 0,0,graph 0.1,graph 0.1
set ylabel interval_label
plot data index 0 using 1:2 with lines lw 2.4 lc rgb head_color notitle, \
     data index 1 using 1:2 with points pt 7 ps 1.9 lc rgb tail_color title 'best', \
     data index 3 using 1:(100) with points pt 9 ps 1.5 lc rgb note_color title 'frequencies observed so far'
eval(without_heading)
top = 0.43; bottom = 0.12
eval(panel)
unset key
eval(lower_tics)
set xlabel 'frequency of one more observation (Hz)'
set ylabel 'gain of information'
plot data index 0 using 1:3 with lines lw 2.4 lc rgb head_color notitle, \
     data index 2 using 1:2 with points pt 7 ps 1.9 lc rgb tail_color notitle
unset multiplot
)gp";
} // namespace swimtwin::calibration_scripts
