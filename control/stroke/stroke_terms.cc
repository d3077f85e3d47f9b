#include <control/stroke/stroke_terms.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Keeps the slopes of a stroke without any empty.
    bool has_slopes(const Stroke &stroke)
    {
      return stroke.slopes.drift_m.size() > 0;
    }

    TermValue displacement(const Stroke &stroke, const double heading_rad)
    {
      const Eigen::RowVector2d head_first(-std::cos(heading_rad), -std::sin(heading_rad));
      TermValue                term;
      term.value = head_first * stroke.orbit.drift_m;
      if (has_slopes(stroke))
        term.slopes = head_first * stroke.slopes.drift_m;
      return term;
    }

    /// Times frequency^power.
    TermValue times_frequency(TermValue term, const Stroke &stroke, const double power)
    {
      const double f      = stroke.request.drive.frequency_Hz;
      const double factor = std::pow(f, power);
      if (has_slopes(stroke))
      {
        term.slopes *= factor;
        term.slopes[term.slopes.size() - 1] += power * factor / f * term.value;
      }
      term.value *= factor;
      return term;
    }

    /// By Parseval's theorem.
    TermValue mean_square(const FourierField &field, const Stroke &stroke)
    {
      const auto            &series = field.series();
      const Eigen::VectorXd &c      = stroke.request.drive.parameters;
      Eigen::VectorXd        weight = Eigen::VectorXd::Constant(c.size(), 0.5);
      for (const int component : {0, 1})
        weight[series.bias(component)] = 1.;
      TermValue term{c.cwiseAbs2().dot(weight), {}};
      if (has_slopes(stroke))
      {
        term.slopes                = Eigen::RowVectorXd::Zero(c.size() + 1);
        term.slopes.head(c.size()) = 2. * c.cwiseProduct(weight).transpose();
      }
      return term;
    }

    /// The work in a period is that of B on the moment m, which returns: the integral of B dm = - integral of m dB.
    TermValue magnetic_work(const ReducedSwimmer &swimmer, const FourierField &field, const Stroke &stroke)
    {
      const auto            &series = field.series();
      const Eigen::VectorXd &c      = stroke.request.drive.parameters;
      const auto             n      = static_cast<double>(stroke.samples.size());
      TermValue              work;
      if (has_slopes(stroke))
        work.slopes = Eigen::RowVectorXd::Zero(c.size() + 1);
      for (std::size_t i = 0; i < stroke.samples.size(); ++i)
      {
        const ReducedSnapshot &now = stroke.samples[i];
        const ShapeVector      q   = swimmer.shape_of(now.state);
        const Eigen::Matrix2d  R   = Eigen::Rotation2Dd(now.state[2]).toRotationMatrix();
        const Eigen::Vector2d  m   = R * swimmer.moment(q, stroke.request.parameters);
        const Eigen::Vector2d  dB  = series.rate(now.phase, c);
        work.value -= m.dot(dB) / n;
        if (!has_slopes(stroke))
          continue;
        const Eigen::MatrixXd &S = stroke.slopes.states[i];
        const Eigen::MatrixXd  dm =
            Eigen::Vector2d(-m.y(), m.x()) * S.row(2) +
            R * swimmer.moment_slopes(q, stroke.request.parameters) * S.middleRows(3, swimmer.n_modes());
        work.slopes -= dB.transpose() * dm / n;
        work.slopes.head(c.size()) -= m.transpose() * series.rate_slopes(now.phase) / n;
      }
      return work;
    }

    TermValue efficiency(const TermValue &speed, const TermValue &power, const double viscosity)
    {
      TermValue term{viscosity * speed.value * speed.value / power.value, {}};
      if (speed.slopes.size() > 0)
        term.slopes =
            viscosity * speed.value / power.value * 2. * speed.slopes - term.value / power.value * power.slopes;
      return term;
    }
  } // namespace

  std::string to_string(const StrokeTerm term)
  {
    switch (term)
    {
    case StrokeTerm::mean_speed:
      return "mean_speed";
    case StrokeTerm::displacement:
      return "displacement";
    case StrokeTerm::efficiency:
      return "efficiency";
    case StrokeTerm::mean_square_field:
      return "mean_square_field";
    case StrokeTerm::copper_loss:
      return "copper_loss";
    case StrokeTerm::magnetic_work:
      break;
    }
    return "magnetic_work";
  }

  std::string_view unit(const StrokeTerm term)
  {
    switch (term)
    {
    case StrokeTerm::mean_speed:
      return "m/s";
    case StrokeTerm::displacement:
      return "m";
    case StrokeTerm::efficiency:
      return "";
    case StrokeTerm::mean_square_field:
      return "T^2";
    case StrokeTerm::copper_loss:
      return "T^2 s";
    case StrokeTerm::magnetic_work:
      break;
    }
    return "J/m";
  }

  bool is_gain(const StrokeTerm term)
  {
    return term == StrokeTerm::mean_speed || term == StrokeTerm::displacement || term == StrokeTerm::efficiency;
  }

  TermValue evaluate(const StrokeTerm term, const ReducedSwimmer &swimmer, const FourierField &field,
                     const Stroke &stroke, const double heading_rad)
  {
    const auto speed = [&] { return times_frequency(displacement(stroke, heading_rad), stroke, 1.); };
    switch (term)
    {
    case StrokeTerm::mean_speed:
      return speed();
    case StrokeTerm::displacement:
      return displacement(stroke, heading_rad);
    case StrokeTerm::efficiency:
      return efficiency(speed(), times_frequency(magnetic_work(swimmer, field, stroke), stroke, 1.),
                        stroke.request.parameters.viscosity_Pa_s);
    case StrokeTerm::mean_square_field:
      return mean_square(field, stroke);
    case StrokeTerm::copper_loss:
      return times_frequency(mean_square(field, stroke), stroke, -1.);
    case StrokeTerm::magnetic_work:
      break;
    }
    return magnetic_work(swimmer, field, stroke);
  }
} // namespace swimtwin
