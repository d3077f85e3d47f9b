#include <reports/sweep/frequency_script.h>

namespace swimtwin::gnuplot_scripts
{
  const std::string_view displacement_frequency = R"gp(
left = 0.105; right = 0.65; top = 0.865; bottom = 0.12
eval(panel)
set key at screen 0.665, top left top vertical Left reverse
if (logarithmic) {
  set logscale x
  set xtics ('0.001' 1e-3, '0.01' 1e-2, '0.1' 0.1, '0.2' 0.2, '0.5' 0.5, '1' 1, '2' 2, '5' 5, '10' 10, '20' 20, '50' 50, '100' 100)
}
set xrange [f_min:f_max]
set yrange [*:*]
set offsets 0,0,graph 0.05,graph 0.05
set xlabel 'frequency (Hz)'
set ylabel 'displacement per period (mm), positive head first'
set xzeroaxis lt 1 lw 0.8 lc rgb pale_color
unset colorbox
set cbrange [-0.5:n_curves - 0.5]
# Index n_curves: the peaks; the next: other points, if there are any.
plot for [k=0:n_curves-1] data index k using 1:2 with linespoints pi every lw 2.2 pt 5 + 2*(int(k)%5) ps 1.3 lc palette cb k title value(sprintf('name_%d', k)), \
     data index int(n_curves) using 1:2:3 with points pt 6 ps 2.8 lw 1.6 lc palette title 'peaks', \
     data index int(n_curves) + 1 using (has_marks ? $1 : NaN):2:3 with points pt 4 ps 1.7 lw 1.6 lc palette title (has_marks ? marks : '')
)gp";
} // namespace swimtwin::gnuplot_scripts
