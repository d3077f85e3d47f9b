// The numbers that a swimmer's motion depends on, and that say what may be neglected.
#pragma once

#include <datasets/scene/scene.h>

#include <string>

namespace swimtwin
{
  /// Unsteady group 2 pi rho f L^2 / mu: inertia of the fluid against viscosity over one period.
  double unsteady_group(const Scene &scene);
  /// The same at another frequency and viscosity.
  double unsteady_group(const Scene &scene, double frequency_Hz, double viscosity_Pa_s);
  /// How far (m) the fluid reaches: half of the smaller extent of the domain in the plane of motion. Scene with a
  /// domain.
  double fluid_reach_m(const Scene &scene);
  /// The unsteady group of that length; in space, where flows decay within it, of the body's if that is less.
  double unsteady_group_of_domain(const Scene &scene, double frequency_Hz, double viscosity_Pa_s);
  /// Largest speed (m/s) that walls, inflows and given motions ever impose.
  double largest_imposed_speed_m_s(const Scene &scene);
  /// "an estimated 3 % of the displacement", of what a term of inertia is worth.
  std::string share_of_displacement(double share);
  /// A sentence if inertia is neglected without the scene having said so, and is not small; else empty.
  std::string inertia_warning(const Scene &scene);
  /// How the swimmer swings about the field's direction by itself when it is turned away and let go: as a rigid plate
  /// of its length, with the fluid that a plate takes along (pi rho L^4 / 128) and its viscous torque per rate (pi mu
  /// L^2 / 2).
  struct MagneticSwing
  {
    double rate_rad_s    = 0.; ///< undamped; zero where nothing turns it
    double damping_ratio = 0.; ///< from 1 on it does not swing
  };
  MagneticSwing magnetic_swing(const Scene &scene);

  /// Magnetic torque against the viscous torque of a turn per period: M A B / (mu f L^2), in space M V B / (mu f L^3);
  /// and the elastic group E h^3 / (12 (1 - nu^2) mu f L^3) with the tail's mean height h, in space E h^4 / (64 mu f
  /// L^4) (I / pi of a round section). Zero where the scene lacks what they need.
  double magnetic_group(const Scene &scene);
  double elastic_group(const Scene &scene);
  double elastic_group(const Scene &scene, double frequency_Hz, double viscosity_Pa_s, double young_modulus_Pa);
} // namespace swimtwin
