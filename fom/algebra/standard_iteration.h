// Krylov methods of the library with preconditioners of the library, for systems that need none made for them.
#pragma once

#include <petscksp.h>

namespace swimtwin
{
  /// multigrid: conjugate gradients with smoothed aggregation (GAMG), for positive definite matrices;
  /// subdomains: GMRES with the additive Schwarz method (GASM), a subdomain a rank, each solved by factors.
  enum class StandardPreconditioner { none, multigrid, subdomains };

  /// A matrix that changes its values and keeps its pattern.
  class StandardIteration
  {
  public:
    /// The matrix must outlive this. Collective.
    StandardIteration(MPI_Comm communicator, Mat matrix, StandardPreconditioner preconditioner);
    ~StandardIteration();
    StandardIteration(const StandardIteration &)            = delete;
    StandardIteration &operator=(const StandardIteration &) = delete;

    /// For the matrix as it is. False if a subdomain could not be factorised. Collective.
    bool set_up();
    /// Starts from the solution that it is given.
    KSP solver() const { return ksp_; }

  private:
    Mat matrix_;
    KSP ksp_ = nullptr;
  };
} // namespace swimtwin
