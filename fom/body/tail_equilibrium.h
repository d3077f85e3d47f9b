// The elastic tail alone, clamped to its head and loaded at its nodes: the structure's part of a partitioned coupling.
#pragma once

#include <fom/body/swimmer.h>
#include <fom/unknowns/condensation.h>

namespace swimtwin
{
  template <int dim>
  class TailEquilibrium
  {
  public:
    /// The swimmer has a tail and must outlive this. Collective.
    TailEquilibrium(const Swimmer<dim> &swimmer, const LinearSolverOptions &options, MPI_Comm communicator);

    /// Newton's method: find the shape (m, head frame), starting from the given one, whose internal forces equal the
    /// nodal loads (head frame, N per unit depth). It ends when the update's root mean square over the tail is below
    /// the tolerance. False if it does not get there, or turns an element inside out. Collective.
    bool solve(const NodalField<dim> &loads, double tolerance_m, NodalField<dim> &shape);

    const LinearSolverCounts &counts() const { return solver_.counts(); }
    void                      set_counts(const LinearSolverCounts &counts) { solver_.set_counts(counts); }
    void                      forget_factors() { solver_.forget_factors(); }
    unsigned int              n_unknowns() const { return map_.n_unknowns(); }

  private:
    void            assemble(const NodalField<dim> &loads, const NodalField<dim> &shape);
    NodalField<dim> nodal(const std::vector<double> &unknowns) const;

    const Swimmer<dim>       &swimmer_;
    NodeNumbering<dim>        numbering_;
    MotionMap<dim>            map_;
    Condensation<dim>         condensation_;
    LinearSystem              solver_;
    std::vector<unsigned int> owned_cells_;
  };
} // namespace swimtwin
