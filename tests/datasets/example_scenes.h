// Scene texts for the tests of the reader.
#pragma once

#include <string>

namespace swimtwin
{
  /// A valid swimmer in a box; line 1 is `dimension = 2`.
  inline const std::string swimmer_toml = R"(dimension = 2
[fluid]
density_kg_m3 = 1260.0
viscosity_Pa_s = 1.52
[domain]
shape = "box"
size_m = [40e-3, 20e-3]
[domain.walls]
left = "traction-free"
right = "traction-free"
[head]
shape = "rectangle"
size_m = [0.5e-3, 1.5e-3]
density_kg_m3 = 7000.0
magnetization_A_m = 1e5
[tail]
length_m = 7.5e-3
root_height_m = 1.5e-3
tip_height_m = 0.2e-3
young_modulus_Pa = 1e5
poisson_ratio = 0.4
density_kg_m3 = 1300.0
[field]
bx_T = 5e-3
by_T = 5e-3
frequency_Hz = 0.8
[time]
periods = 3
steps_per_period = 100
)";

  /// A valid elastic beam in vacuum; line 1 is `dimension = 2`.
  inline const std::string beam_toml = R"(dimension = 2
[head]
shape = "disc"
diameter_m = 0.1
motion = "fixed"
[tail]
length_m = 0.35
root_height_m = 0.02
tip_height_m = 0.02
tip = "flat"
young_modulus_Pa = 1.4e6
poisson_ratio = 0.4
density_kg_m3 = 1000.0
[time]
duration_s = 1.0
steps = 10
)";
} // namespace swimtwin
