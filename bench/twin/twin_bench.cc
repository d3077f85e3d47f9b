#include <datasets/reduced/reduced_model.h>
#include <datasets/scene/scene.h>
#include <twin/measurement/camera_sensor.h>
#include <datasets/system/clocks.h>
#include <fmt/format.h>
using namespace swimtwin;
int main(int, char **argv)
{
  ReducedModel      model = read_reduced_model(argv[1]);
  ReducedSwimmer    sw(model);
  SwimmerParameters p = swimmer_parameters(parse_scene(model.scene_text, model.scene_name));
  FieldSignal       f;
  f.play_sinusoid(0, 4e-3, 4e-3, 0.8);
  StateTransition t(sw);
  SwimmerState    s = state_at_rest(sw);
  int             n = 20000;
  double          h = 1 / 30.;
  double          a = wall_time_s();
  for (int i = 0; i < n; ++i)
    if (!t.advance(f, i * h, (i + 1) * h, p, {0, 0}, s))
      fmt::print("fail\n");
  double b = wall_time_s();
  fmt::print("{:.1f} us per step\n", 1e6 * (b - a) / n);
  SwimmerMotion   m = sw.make_motion();
  RateDerivatives d = sw.make_derivatives();
  a                 = wall_time_s();
  for (int i = 0; i < n; ++i)
    sw.differentiate(s, {4e-3, 1e-3}, p, m, d);
  b = wall_time_s();
  fmt::print("{:.1f} us per differentiate\n", 1e6 * (b - a) / n);
}
