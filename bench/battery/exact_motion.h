// The reduced swimmer's motion with ingredients of the full-order model put in: what each costs in displacement.
#pragma once

#include <fom/body/swimmer.h>
#include <rom/swimmer/reduced_swimmer.h>
#include <rom/training/posed_fluid.h>
#include <rom/training/run_parameters.h>
#include <rom/training/sample_store.h>
#include <rom/training/tail_basis.h>

namespace swimtwin
{
  enum class ResistanceSource {
    full_order_in_place,
    full_order_at_usual_height, ///< but as far along as it is
    full_order_in_usual_place,
    surrogate
  };

  /// Steps of BDF2 as in the full-order model; the resistance of each is iterated, the elastic force by Newton's
  /// method.
  template <int dim>
  class ExactMotion
  {
  public:
    /// All must outlive this.
    ExactMotion(const Swimmer<dim> &swimmer, const ReducedModel &model, const TailBasis &basis, const UsualPlace &place)
        : swimmer_(swimmer), reduced_(model), basis_(basis), place_(place), fluid_(swimmer)
    {
    }

    /// Displacement (m, head first) of the last of n periods. Throws ComputationError where a step finds no end.
    double displacement_m(const RunParameters &member, ResistanceSource source, int n_periods, int steps_per_period);

    /// At unit viscosity, in the place of the state or the usual one.
    Eigen::MatrixXd resistance(const Eigen::VectorXd &state, ResistanceSource source);

    const ReducedSwimmer &reduced() const { return reduced_; }

  private:
    Configuration<dim> configuration(const Eigen::VectorXd &state, ResistanceSource source) const;

    const Swimmer<dim> &swimmer_;
    ReducedSwimmer      reduced_;
    const TailBasis    &basis_;
    UsualPlace          place_;
    PosedFluid<dim>     fluid_;
  };
} // namespace swimtwin
