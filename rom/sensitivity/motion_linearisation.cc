#include <rom/sensitivity/motion_linearisation.h>

#include <rom/integration/radau_rule.h>
#include <rom/swimmer/dense_algebra.h>

#include <array>

namespace swimtwin
{
  namespace
  {
    constexpr int n_stages = RadauRule::n_stages;

    struct Stage
    {
      Eigen::VectorXd state;
      Eigen::MatrixXd jacobian, input; ///< of dy/dphase by the state and by the parameters
    };

    class Linearisation
    {
    public:
      Linearisation(PhaseEquations &equations, const StoredMotion &motion)
          : equations_(equations), motion_(motion), rule_(radau_rule())
      {
      }

      LinearisedInstant start() const
      {
        const Eigen::Index n = equations_.swimmer().n_states(), m = equations_.drive().parameters.size();
        return {0., motion_.state_at(0.), Eigen::MatrixXd::Zero(n, m), Eigen::VectorXd::Zero(n),
                Eigen::MatrixXd::Zero(n, m)};
      }

      LinearisedInstant next(const LinearisedInstant &before, const double phase)
      {
        const double h = phase - before.phase;
        for (int i = 0; i < n_stages; ++i)
          set_stage(before.phase + rule_.c[i] * h, stages_[static_cast<std::size_t>(i)]);
        const Eigen::MatrixXd S   = stage_sensitivities(h, before.by_parameters);
        const Eigen::Index    n   = before.state.size();
        LinearisedInstant     now = before;
        now.phase                 = phase;
        now.state                 = stages_.back().state;
        now.by_parameters         = S.bottomRows(n);
        for (int i = 0; i < n_stages; ++i)
        {
          const double weight = h * rule_.A(n_stages - 1, i);
          now.integral += weight * stages_[static_cast<std::size_t>(i)].state;
          now.integral_by_parameters += weight * S.middleRows(i * n, n);
        }
        return now;
      }

    private:
      void set_stage(const double phase, Stage &stage)
      {
        const Drive &drive       = equations_.drive();
        stage.state              = motion_.state_at(phase);
        const RateDerivatives &d = equations_.derivatives(phase, stage.state);
        stage.jacobian           = d.by_state / drive.frequency_Hz;
        stage.input              = d.by_field * drive.field->slopes(phase, drive.parameters) / drive.frequency_Hz;
      }

      /// S_i = S_0 + h sum_j A_ij (J_j S_j + G_j), G the input.
      Eigen::MatrixXd stage_sensitivities(const double h, const Eigen::MatrixXd &before) const
      {
        const Eigen::Index n      = before.rows();
        Eigen::MatrixXd    matrix = Eigen::MatrixXd::Identity(n_stages * n, n_stages * n);
        Eigen::MatrixXd    load(n_stages * n, before.cols());
        for (int i = 0; i < n_stages; ++i)
        {
          load.middleRows(i * n, n) = before;
          for (int j = 0; j < n_stages; ++j)
          {
            const Stage &stage = stages_[static_cast<std::size_t>(j)];
            matrix.block(i * n, j * n, n, n) -= h * rule_.A(i, j) * stage.jacobian;
            load.middleRows(i * n, n) += h * rule_.A(i, j) * stage.input;
          }
        }
        return solve_by_lu(matrix, load);
      }

      PhaseEquations             &equations_;
      const StoredMotion         &motion_;
      RadauRule                   rule_;
      std::array<Stage, n_stages> stages_;
    };
  } // namespace

  std::vector<LinearisedInstant> linearise_motion(PhaseEquations &equations, const StoredMotion &motion,
                                                  const std::vector<double> &phases)
  {
    constexpr int                  steps_at_once = 8; // of the motion: more of them where it changes fast
    Linearisation                  linearisation(equations, motion);
    std::vector<LinearisedInstant> instants = {linearisation.start()};
    int                            step     = 0;
    for (const double phase : phases)
    {
      LinearisedInstant now = instants.back();
      for (int taken = 1; step < motion.n_steps() && motion.end_of_step(step) < phase; ++step, ++taken)
        if (taken % steps_at_once == 0)
          now = linearisation.next(now, motion.end_of_step(step));
      instants.push_back(linearisation.next(now, phase));
    }
    return instants;
  }
} // namespace swimtwin
