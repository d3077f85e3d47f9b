#include <rom/sensitivity/adjoint_integrator.h>
#include <rom/sensitivity/adjoint_step.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr double growth           = 2.; // of pieces away from the end
    constexpr double steps_in_a_piece = 3.; // of the longest that are allowed

    /// Pieces that begin short at the end of the run, where shapes forget the functional fast: as long as the fastest
    /// of them at first, then growing; as far as the field's last kink, which stays the end of a piece.
    void grade(std::vector<double> &pieces, const double shortest, const double last_kink)
    {
      const double end = pieces.back();
      pieces.pop_back();
      std::vector<double> added;
      double              length = shortest;
      for (double phase = end - length; phase > last_kink; phase -= length)
      {
        while (!pieces.empty() && pieces.back() > last_kink && pieces.back() >= phase - 0.5 * length)
        {
          phase = std::min(phase, pieces.back());
          pieces.pop_back();
        }
        if (phase <= last_kink)
          break;
        added.push_back(phase);
        length *= growth;
        if (!pieces.empty() && length >= phase - pieces.back())
          break;
      }
      if (pieces.empty())
        pieces.push_back(0.);
      pieces.insert(pieces.end(), added.rbegin(), added.rend());
      pieces.push_back(end);
    }
  } // namespace

  double MotionGradient::by(const Parameter &parameter) const
  {
    switch (parameter.quantity)
    {
    case Quantity::young_modulus:
      return by_parameters.young_modulus_Pa;
    case Quantity::viscosity:
      return by_parameters.viscosity_Pa_s;
    case Quantity::magnetization:
      return by_parameters.magnetization_A_m;
    case Quantity::tail_magnetization:
      return by_parameters.tail_magnetization_A_m;
    case Quantity::frequency:
      return by_frequency;
    case Quantity::field:
      return by_field[parameter.index];
    case Quantity::initial_angle:
      return by_initial_state[2];
    case Quantity::initial_shape:
      return by_initial_state[3 + parameter.index];
    case Quantity::initial_velocity:
      return by_initial_state[by_initial_state.size() / 2 + parameter.index];
    }
    return 0.;
  }

  AdjointIntegrator::AdjointIntegrator(const ReducedSwimmer &swimmer, const AdjointOptions &options)
      : options_(options), equations_(swimmer, {}), store_(swimmer, {.relative_tolerance = options.relative_tolerance,
                                                                     .max_step_periods   = options.max_step_periods,
                                                                     .max_steps          = options.max_steps})
  {
  }

  std::vector<double> AdjointIntegrator::pieces()
  {
    const double        longest = steps_in_a_piece * options_.max_step_periods;
    std::vector<double> phases  = {0.};
    for (int step = 0, taken = 0; step < motion_.n_steps(); ++step)
    {
      const bool is_last = step + 1 == motion_.n_steps();
      const bool is_long = !is_last && motion_.end_of_step(step + 1) - phases.back() > longest;
      if (++taken < options_.steps_per_piece && !is_last && !is_long && !motion_.ends_at_kink(step))
        continue;
      phases.push_back(motion_.end_of_step(step));
      taken = 0;
    }
    return phases;
  }

  double AdjointIntegrator::last_kink() const
  {
    for (int step = motion_.n_steps() - 2; step >= 0; --step)
      if (motion_.ends_at_kink(step))
        return motion_.end_of_step(step);
    return 0.;
  }

  bool AdjointIntegrator::go_forward(const RunRequest &request, const MotionFunctional &functional)
  {
    result_ = MotionGradient();
    motion_ = store_.run(request);
    equations_.start(request);
    result_.status  = motion_.status;
    result_.failure = motion_.failure;
    result_.n_steps = motion_.n_steps();
    if (!motion_.completed())
      return false;
    pieces_       = pieces();
    result_.value = functional.terminal(motion_.end());
    return true;
  }

  void AdjointIntegrator::go_back(const RunRequest &request, const MotionFunctional &functional)
  {
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(request.initial_state.size());
    functional.add_terminal_gradient(motion_.end(), lambda);
    result_.by_field = Eigen::VectorXd::Zero(request.drive.parameters.size());
    const Eigen::MatrixXd J =
        equations_.derivatives(request.n_periods, motion_.end()).by_state / request.drive.frequency_Hz;
    grade(pieces_, std::min(1. / J.bottomRightCorner(J.rows() - 2, J.rows() - 2).norm(), options_.max_step_periods),
          last_kink());
    result_.n_pieces = static_cast<int>(pieces_.size()) - 1;
    AdjointStep step(equations_, motion_, functional);
    for (std::size_t i = pieces_.size() - 1; i > 0; --i)
      step.take(pieces_[i - 1], pieces_[i], lambda, result_);
    result_.by_initial_state = lambda;
  }

  MotionGradient AdjointIntegrator::differentiate(const RunRequest &request, const MotionFunctional &functional)
  {
    if (go_forward(request, functional))
      go_back(request, functional);
    return result_;
  }

  MotionGradient AdjointIntegrator::evaluate(const RunRequest &request, const MotionFunctional &functional)
  {
    if (!go_forward(request, functional))
      return result_;
    const RadauRule rule = radau_rule();
    for (std::size_t i = 1; i < pieces_.size(); ++i)
      for (int k = 0; k < RadauRule::n_stages; ++k)
      {
        const double          length = pieces_[i] - pieces_[i - 1], phase = pieces_[i] - rule.c[k] * length;
        const Eigen::VectorXd state = motion_.state_at(phase);
        result_.value += length * rule.A(RadauRule::n_stages - 1, k) / request.drive.frequency_Hz *
                         functional.running({phase, state, equations_.field_T(phase)});
      }
    return result_;
  }
} // namespace swimtwin
