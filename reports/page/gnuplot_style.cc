#include <reports/page/gnuplot_style.h>

namespace swimtwin::gnuplot_scripts
{
  const std::string_view style =
      R"gp(# The look shared by the pictures of this folder: change it here, then run gnuplot on the scripts again.
set encoding utf8
if (strlen(picture) > 4 && picture[strlen(picture)-3:*] eq '.svg') {
  set terminal svg size 1600,1000 enhanced font 'DejaVu Sans,19' linewidth 1.6 background '#ffffff'
} else {
  set terminal pngcairo size 1600,1000 enhanced font 'DejaVu Sans,19' linewidth 1.6 background '#ffffff'
}
set output picture

head_color        = '#1d4e89'
tail_color        = '#d1662b'
magnetic_color    = '#1d4e89'
dissipation_color = '#c23b4e'
elastic_color     = '#3a9a6b'
external_color    = '#8a5fa8'
field_color       = '#3f3f46'
pale_color        = '#b4bac4'
text_color        = '#26262b'
note_color        = '#5f6673'

set border 3 lw 0.8 lc rgb '#5f6673'
set tics out nomirror scale 0.5 textcolor rgb text_color
set grid back lt 1 lw 0.5 lc rgb '#e3e6ea'
set xlabel tc rgb text_color offset 0,0.2
set ylabel tc rgb text_color offset -0.5,0
set minussign
set label 1 heading at screen 0.105,0.957 left font ',25' tc rgb text_color
set label 2 caption at screen 0.105,0.912 left font ',18' tc rgb note_color

# early to late, readable in grey and for the colour-blind
set palette defined (0 '#fbbf5b', 0.25 '#ee7d50', 0.5 '#c23b6a', 0.75 '#712c86', 1 '#22175c')
cyclic_palette = "set palette defined (0 '#22175c', 0.17 '#2f6fb5', 0.34 '#35a892', 0.5 '#e3b23c', 0.67 '#dc6a3a', 0.84 '#a52a6b', 1 '#22175c')"

# eval(panel) puts the next plot between left, right, top and bottom (parts of the picture); eval(one_scale) sets ranges
# that show x_min ... y_max in it with the same scale on both axes and fill it; eval(map_panel) does
# both for places. The key stands above the panel.
panel = "set key at screen right, top + 0.043 right top horizontal Left reverse width 1 samplen 1.8 textcolor rgb text_color; \
  set lmargin at screen left; set rmargin at screen right; \
  set tmargin at screen top; set bmargin at screen bottom"
zoom_out = 1.14
larger(a, b) = a > b ? a : b
one_scale = "w = 1600. * (right - left); h = 1000. * (top - bottom); \
  half = 0.5 * zoom_out * larger((x_max - x_min) / w, (y_max - y_min) / h); \
  set xrange [0.5*(x_min + x_max) - half*w : 0.5*(x_min + x_max) + half*w]; \
  set yrange [0.5*(y_min + y_max) - half*h : 0.5*(y_min + y_max) + half*h]"
map_panel = panel.'; '.one_scale."; set xlabel 'x (mm)'; set ylabel 'y (mm)'"

# More to eval: colorbox_beside puts the scale of colours to the right of the panel, phase_tics marks the quarters of a
# period on it; without_heading comes before the second panel; upper_tics and lower_tics are for two panels above each
# other with frequencies along x, whose names stand below the lower one.
colorbox_beside = "set colorbox user origin screen right + 0.02, screen bottom size screen 0.013, screen top - bottom noborder"
phase_tics = "set cbtics ('0' 0, '¼' 0.25, '½' 0.5, '¾' 0.75, '1' 1)"
without_heading = "unset label 1; unset label 2"
frequencies = '0.01 0.02 0.05 0.1 0.2 0.3 0.5 0.7 1 1.5 2 3 5 10 20 50'
upper_tics = "if (logarithmic) { set logscale x; set xtics (); do for [f in frequencies] { set xtics add ('' f + 0.) } } else { set format x '' }"
lower_tics = "if (logarithmic) { set logscale x; set xtics (); do for [f in frequencies] { set xtics add (f f + 0.) } } else { set format x '%g' }"
)gp";
} // namespace swimtwin::gnuplot_scripts
