// Owners of SUNDIALS objects.
#pragma once

#include <Eigen/Dense>
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <new>

namespace swimtwin::sundials
{
  template <typename Pointer, void (*release)(Pointer)>
  struct Release
  {
    using pointer = Pointer;
    void operator()(const Pointer object) const { release(object); }
  };

  inline void release_context(SUNContext context)
  {
    SUNContext_Free(&context);
  }
  inline void release_matrix(SUNMatrix matrix)
  {
    SUNMatDestroy(matrix);
  }
  inline void release_solver(SUNLinearSolver solver)
  {
    SUNLinSolFree(solver);
  }
  inline void release_cvodes(void *memory)
  {
    CVodeFree(&memory);
  }
  inline void release_vector(N_Vector vector)
  {
    N_VDestroy(vector);
  }

  using Context      = std::unique_ptr<_SUNContext, Release<SUNContext, release_context>>;
  using Matrix       = std::unique_ptr<_generic_SUNMatrix, Release<SUNMatrix, release_matrix>>;
  using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, Release<SUNLinearSolver, release_solver>>;
  using Integrator   = std::unique_ptr<void, Release<void *, release_cvodes>>;
  using Vector       = std::unique_ptr<_generic_N_Vector, Release<N_Vector, release_vector>>;

  /// What SUNDIALS gives back, or bad_alloc: making its objects fails for lack of memory only.
  template <typename Pointer>
  Pointer made(const Pointer object)
  {
    if (object == nullptr)
      throw std::bad_alloc();
    return object;
  }

  /// Of what sets an integrator up, which fails for lack of memory only; without it the next call would be lost.
  inline void require_memory(const int flag)
  {
    if (flag < 0)
      throw std::bad_alloc();
  }

  inline Context make_context()
  {
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    return Context(made(context));
  }

  /// An error handler: return codes say all that there is to say.
  inline void ignore_message(int, const char *, const char *, char *, void *) {}

  inline Eigen::Map<Eigen::VectorXd> values(const N_Vector vector)
  {
    return {N_VGetArrayPointer(vector), static_cast<Eigen::Index>(N_VGetLength_Serial(vector))};
  }
} // namespace swimtwin::sundials
