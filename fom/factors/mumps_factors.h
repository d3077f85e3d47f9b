// Factors of a distributed matrix by MUMPS.
#pragma once

#include <petscksp.h>

namespace swimtwin
{
  /// They stay while the matrix changes, until they are computed anew. MUMPS keeps its analysis with the pattern.
  class MumpsFactors
  {
  public:
    MumpsFactors() = default;
    ~MumpsFactors() { clear(); }
    MumpsFactors(const MumpsFactors &)            = delete;
    MumpsFactors &operator=(const MumpsFactors &) = delete;

    void clear();
    /// Of this matrix, which lives as long: by LU, or by Cholesky's factors of a positive definite one. Collective.
    void set_matrix(MPI_Comm communicator, Mat matrix, bool is_positive_definite);
    /// Of the whole matrix by LU, whatever its symmetry.
    void use_whole();
    /// Of a symmetric matrix' upper triangle alone, LDL^T: half the work.
    void use_upper_triangle();
    /// Of the matrix as it is. False if pivots failed it; throws OutOfMemory. Collective.
    bool compute();
    /// y = A^-1 x with the A of the last computation. Collective.
    void apply(Vec x, Vec y) const;
    /// The same for all columns of a dense matrix. Collective.
    void apply(Mat B, Mat X) const;

    /// A Krylov solver for the matrix as it is, with these factors as its preconditioner as long as it is told to keep
    /// them (KSPSetReusePreconditioner).
    KSP solver() const { return ksp_; }

  private:
    bool set_up();
    bool set_up_in_larger_workspace();

    Mat matrix_ = nullptr;
    KSP ksp_    = nullptr;
  };
} // namespace swimtwin
