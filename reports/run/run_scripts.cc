#include <reports/run/run_scripts.h>

namespace swimtwin::gnuplot_scripts
{
  const std::string_view trajectory = R"gp(
set multiplot
tall = y_max - y_min > 0.5 * (x_max - x_min) # then the path stands beside the displacement, else above it

# the path, with one scale on both axes
left = 0.105; right = tall ? 0.39 : 0.875; top = 0.835; bottom = tall ? 0.12 : 0.48
eval(map_panel)
set cblabel time_label offset 0.3,0
set cbrange [t_min:t_max]
eval(colorbox_beside)
x_arrow = left + 0.013; y_arrow = top + 0.025 # in the direction of the head, above the panel
set arrow 1 from screen x_arrow - 0.0125*cos(head_first), screen y_arrow - 0.02*sin(head_first) \
  rto screen 0.025*cos(head_first), screen 0.04*sin(head_first) lw 1.6 lc rgb note_color head filled size screen 0.009,22
set label 3 'head first' at screen x_arrow + 0.02, screen y_arrow left font ',17' tc rgb note_color
plot data index 0 using 2:3:1 with lines lw 2.2 lc palette notitle, \
     data index 1 using 2:3:1 with points pt 7 ps 1.7 lc palette notitle, \
     data index 1 using 2:3 with points pt 6 ps 1.7 lw 1.2 lc rgb text_color notitle
unset label 1; unset label 2; unset label 3; unset arrow 1; unset colorbox

# the displacement, with the same marks
if (tall) { left = 0.63; right = 0.965 } else { top = 0.365; bottom = 0.115 }
eval(panel)
set xrange [t_min:t_max]
set yrange [*:*]
set offsets 0,0,graph 0.05,graph 0.05
set xlabel time_label
set ylabel 'displacement (mm)'
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
plot data index 0 using 1:4 with lines lw 2.2 lc rgb head_color notitle, \
     data index 1 using 1:4:1 with points pt 7 ps 1.7 lc palette notitle, \
     data index 1 using 1:4 with points pt 6 ps 1.7 lw 1.2 lc rgb text_color title border_title
unset multiplot
)gp";

  const std::string_view angles = R"gp(
set multiplot
left = 0.105; right = 0.965
set xrange [t_min:t_max]
top = 0.835; bottom = has_field ? 0.425 : 0.12
eval(panel)
set offsets 0,0,graph 0.05,graph 0.05
set ylabel 'angle (degrees)'
set xlabel (has_field ? '' : time_label)
if (has_field) { set format x '' }
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
if (has_head && has_tail) {
  plot data using 1:2 with lines lw 2.4 lc rgb head_color title 'head', \
       data using 1:3 with lines lw 2.4 lc rgb tail_color title 'tail tip'
} else {
  plot data using 1:(has_head ? $2 : $3) with lines lw 2.4 lc rgb (has_head ? head_color : tail_color) title (has_head ? 'head' : 'tail tip')
}
eval(without_heading)

if (has_field) {
  top = 0.355; bottom = 0.12
  eval(panel)
  set format x '%g'
  set offsets 0,0,graph 0.05,graph 0.05
  set xlabel time_label
  set ylabel 'field (mT)'
  plot data using 1:5 with lines lw 2.2 lc rgb field_color title 'b_y', \
       data using 1:4 with lines lw 1.6 dt (8,5) lc rgb field_color title 'b_x'
}
unset multiplot
)gp";

  const std::string_view stroke_loop = R"gp(
left = 0.105; right = 0.965; top = 0.835; bottom = 0.12
eval(panel)
eval(one_scale)
set xlabel 'head angle (degrees)'
set ylabel 'tail angle (degrees)'
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
set yzeroaxis lt 1 lw 0.8 lc rgb pale_color
plot data index 1 using 1:2 with filledcurves closed lc rgb tail_color fs transparent solid 0.10 noborder notitle, \
     data index 0 using 1:2 with lines lw 1.2 lc rgb pale_color title earlier_title, \
     data index 1 using 1:2 with lines lw 2.8 lc rgb tail_color title loop_title, \
     data index 3 using 1:2:3:4 with vectors head filled size screen 0.014,22,90 fixed lw 2.2 lc rgb tail_color notitle, \
     data index 2 using 1:2 with points pt 7 ps 1.6 lc rgb tail_color title 'quarters of the period', \
     data index 2 using 3:4:(word('0 ¼ ½ ¾', int(4*$5 + 1.5))) with labels font ',18' tc rgb text_color notitle
)gp";

  const std::string_view power_balance = R"gp(
set multiplot
left = 0.105; right = 0.965
set xrange [t_min:t_max]
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
top = 0.835; bottom = has_residual ? 0.425 : 0.12
eval(panel)
set offsets 0,0,graph 0.05,graph 0.05
set ylabel power_name.' ('.power_unit.')'
set xlabel (has_residual ? '' : time_label)
if (has_residual) { set format x '' }
# curves that are zero all along point at a number that is not one
plot data index 0 using 1:(has_magnetic ? $2 : NaN) with lines lw 2.4 lc rgb magnetic_color title (has_magnetic ? 'magnetic power' : ''), \
     data index 0 using 1:(has_external ? $3 : NaN) with lines lw 2.4 lc rgb external_color title (has_external ? 'external power' : ''), \
     data index 0 using 1:(has_dissipation ? $4 : NaN) with lines lw 2.4 lc rgb dissipation_color title (has_dissipation ? 'dissipation' : ''), \
     data index 1 using 1:(has_stored ? $2 : NaN) with lines lw 2.4 lc rgb elastic_color title (has_stored ? 'rate of stored energy' : '')
eval(without_heading)

if (has_residual) {
  top = 0.355; bottom = 0.12
  eval(panel)
  set format x '%g'
  set offsets 0,0,graph 0.05,graph 0.05
  set xlabel time_label
  set ylabel 'residual (%)'
  plot data index 1 using 1:3 with filledcurves y=0 lc rgb field_color fs transparent solid 0.12 noborder notitle, \
       data index 1 using 1:3 with lines lw 1.8 lc rgb field_color title residual_title
}
unset multiplot
)gp";

  const std::string_view shapes = R"gp(
left = 0.105; right = 0.875; top = 0.835; bottom = 0.12
eval(map_panel)
if (cyclic) { eval(cyclic_palette) }
set cbrange [t_min:t_max]
set cblabel instant_label offset (cyclic ? 2.5 : 1),0
eval(colorbox_beside)
if (cyclic) { eval(phase_tics) }

# Index 0: path of the tail's tip; then two blocks per instant: tail (empty without one) and head.
color(k) = word(instants, k) + 0
plot for [k=1:words(instants)] data index 2*k-1 using 2:3 with filledcurves closed lc palette cb color(k) fs transparent solid 0.13 noborder notitle, \
     for [k=1:words(instants)] data index 2*k using 2:3 with filledcurves closed lc palette cb color(k) fs transparent solid 0.12 noborder notitle, \
     for [k=1:words(instants)] data index 2*k-1 using 2:3 with lines lw 1.8 lc palette cb color(k) notitle, \
     for [k=1:words(instants)] data index 2*k using 2:3 with lines lw 1.8 lc palette cb color(k) notitle, \
     data index 0 using 2:3 with lines lw 1.6 dt (3,3) lc rgb field_color title path_title
)gp";

  const std::string_view spatial_view = R"gp(
set multiplot
set view 48, 24
set view equal xyz
set xyplane at z_min
set xrange [x_min:x_max]
set yrange [y_min:y_max]
set zrange [z_min:z_max]
set border 15 lw 0.8 lc rgb pale_color
set grid x y lt 1 lw 0.6 lc rgb pale_color
decade(width) = 10**floor(log10(width))
spacing(width) = decade(width) * (width < 2*decade(width) ? 0.5 : width < 5*decade(width) ? 1 : 2)
set xtics spacing(x_max - x_min) font ',14' offset 0,-0.3
set ytics spacing(y_max - y_min) font ',14' offset 0.3,0
unset ztics
unset key
unset colorbox
set pm3d depthorder lighting primary 0.55 specular 0.15
# per instant: tail (where there is one), then head
n_blocks = has_tail ? 2 : 1
do for [k=1:words(instants)] {
  column = (k - 1) % 2; row = (k - 1) / 2
  set lmargin at screen 0.02 + 0.49*column
  set rmargin at screen 0.49 + 0.49*column
  set tmargin at screen 0.86 - 0.42*row
  set bmargin at screen 0.46 - 0.42*row
  set label 5 word(instants, k).' '.instant_unit at screen 0.04 + 0.49*column, screen 0.83 - 0.42*row font ',17' tc rgb text_color
  set xlabel 'x (mm)' font ',15' offset 0,-1
  set ylabel 'y (mm)' font ',15' offset 1.5,0
  if (has_tail) {
    splot data index n_blocks*(k-1) using 1:2:3 with polygons fs solid 1 fc rgb tail_color, \
          data index n_blocks*(k-1)+1 using 1:2:3 with polygons fs solid 1 fc rgb head_color
  } else {
    splot data index k-1 using 1:2:3 with polygons fs solid 1 fc rgb head_color
  }
  eval(without_heading)
}
unset multiplot
)gp";

  const std::string_view flow_in_plane = R"gp(
set multiplot
set palette defined (0 '#f7fafd', 0.15 '#d3e3f1', 0.4 '#8db8db', 0.7 '#3c7fb5', 1 '#0d3b6e')
unset grid
decade(width) = 10**floor(log10(width))
spacing(width) = decade(width) * (width < 2*decade(width) ? 0.5 : width < 5*decade(width) ? 1 : 2)
n = words(instants)
n_columns = n > 1 ? 2 : 1
n_lines = n > 2 ? 2 : 1
set cbrange [0:speed_max]
zoom_out = 1.01
set ylabel offset 0.8,0
do for [k=1:n] {
  column = (k - 1) % 2; line = (k - 1) / 2
  left = 0.07 + 0.43*column; right = n_columns > 1 ? left + 0.385 : 0.87
  top = 0.83 - 0.4*line; bottom = n_lines > 1 ? top - 0.315 : 0.12
  eval(panel)
  unset key
  x_min = word(middles_x, k) - 0.5*width; x_max = x_min + width # all panels in one scale, each around the body
  y_min = word(middles_y, k) - 0.5*height; y_max = y_min + height
  eval(one_scale)
  set xtics spacing(2*half*w)
  set ytics 2*spacing(2*half*h)
  set xlabel (k > n - n_columns ? 'x (mm)' : '')
  set ylabel (column == 0 ? 'y (mm)' : '')
  set label 5 word(instants, k).' '.instant_unit at screen left, screen top + 0.022 left font ',17' tc rgb text_color
  if (k == n) {
    set colorbox user origin screen 0.915, screen bottom size screen 0.013, screen 0.83 - bottom noborder
    set label 6 'mm/s' at screen 0.915, screen 0.852 left font ',17' tc rgb text_color
  } else { unset colorbox }
  # per instant: samples, arrows, chords of the tail, chords of the head
  plot data index 4*(k-1) using 1:2:3 with image notitle, \
       data index 4*(k-1)+1 using 1:2:3:4 with vectors head filled size screen 0.005,20,60 fixed lw 1 lc rgb field_color notitle, \
       data index 4*(k-1)+2 using 1:2:3:4 with vectors nohead lw 2 lc rgb tail_color notitle, \
       data index 4*(k-1)+3 using 1:2:3:4 with vectors nohead lw 2 lc rgb head_color notitle
  eval(without_heading)
}
unset multiplot
)gp";
} // namespace swimtwin::gnuplot_scripts
