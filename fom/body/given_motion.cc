#include <fom/body/given_motion.h>

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    constexpr double two_pi = 2. * std::numbers::pi;

    /// The axis of a tail at one time: from its root on, straight before it.
    class BentAxis
    {
    public:
      BentAxis(const TailWave &wave, const double length_m, const double time_s)
          : wave_(wave), length_(length_m), phase_(two_pi * wave.frequency_Hz * time_s + wave.phase_rad)
      {
      }

      double angle(const double s) const
      {
        const double share = s / length_;
        return s <= 0. ? 0. : wave_.angle_rad * share * std::sin(phase_ - two_pi * wave_.waves * share);
      }

      /// From the root to the arc length s (m).
      std::array<double, 2> position(const double s) const
      {
        if (s <= 0.)
          return {s, 0.};
        // Gauss' rule of fifteen points on pieces that are a tenth of a turn: exact but for round-off.
        const int    n     = 1 + int(10. * (std::abs(wave_.angle_rad) + std::abs(wave_.waves)) * s / length_);
        const double piece = s / n;
        double       x = 0., y = 0.;
        for (int i = 0; i < n; ++i)
        {
          using Rule = boost::math::quadrature::gauss<double, 15>;
          x += Rule::integrate([&](const double r) { return std::cos(angle(r)); }, i * piece, (i + 1) * piece);
          y += Rule::integrate([&](const double r) { return std::sin(angle(r)); }, i * piece, (i + 1) * piece);
        }
        return {x, y};
      }

    private:
      const TailWave &wave_;
      double          length_, phase_;
    };
  } // namespace

  template <int dim>
  GivenPose<dim> given_pose(const Head &head, const double time_s)
  {
    const HeadOscillation &given = head.oscillation;
    const double           rate = two_pi * given.frequency_Hz, phase = rate * time_s + given.phase_rad;
    GivenPose<dim>         result;
    for (int c = 0; c < 2; ++c)
    {
      result.pose.center[c] = head.center_m[c] + given.amplitude_m[c] * std::sin(phase);
      result.velocity[c]    = given.amplitude_m[c] * rate * std::cos(phase);
    }
    result.pose.set_attitude(Attitude<dim>::about_z(head.angle_rad + given.angle_rad * std::sin(phase)));
    result.omega[rotation_about_z<dim>] = given.angle_rad * rate * std::cos(phase); // about z
    return result;
  }

  template <int dim>
  NodalField<dim> given_shape(const Swimmer<dim> &swimmer, const double time_s)
  {
    const Scene    &scene  = swimmer.scene();
    const double    root_x = .5 * scene.head.size_m[0];
    const BentAxis  axis(scene.tail->wave, scene.tail->length_m, time_s);
    NodalField<dim> shape;
    for (const auto &X : swimmer.tail().mesh.nodes)
    {
      const double s = X[0] - root_x, angle = axis.angle(s);
      const auto [x, y] = axis.position(s);
      Tensor<1, dim> d;
      d[0] = root_x + x - X[1] * std::sin(angle) - X[0];
      d[1] = y + X[1] * (std::cos(angle) - 1.);
      shape.push_back(d);
    }
    return shape;
  }

  template <int dim>
  void take_given_configuration(const Swimmer<dim> &swimmer, const double time_s, Configuration<dim> &configuration)
  {
    const Scene &scene = swimmer.scene();
    if (scene.head.is_driven())
      configuration.pose = given_pose<dim>(scene.head, time_s).pose;
    if (scene.tail && scene.tail->is_driven())
      configuration.shape = given_shape(swimmer, time_s);
  }

  template GivenPose<2>  given_pose<2>(const Head &, double);
  template GivenPose<3>  given_pose<3>(const Head &, double);
  template NodalField<2> given_shape<2>(const Swimmer<2> &, double);
  template NodalField<3> given_shape<3>(const Swimmer<3> &, double);
  template void          take_given_configuration<2>(const Swimmer<2> &, double, Configuration<2> &);
  template void          take_given_configuration<3>(const Swimmer<3> &, double, Configuration<3> &);
} // namespace swimtwin
