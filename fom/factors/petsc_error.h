// Return codes of PETSc and SLEPc as exceptions of ours.
#pragma once

#include <datasets/system/error.h>

#include <petscsys.h>

#include <string>

namespace swimtwin
{
  /// `where` completes the sentence "the linear algebra ran out of memory while it ...".
  inline OutOfMemory out_of_memory(const std::string &where)
  {
    return OutOfMemory("memory ran out while the linear algebra " + where +
                       "; use a coarser mesh ([numerics] mesh_growth and mesh sizes) or allow more memory");
  }

  /// `what` completes the sentence "the linear algebra failed while it ...". Throws ComputationError.
  inline void check_petsc(const PetscErrorCode code, const char *what)
  {
    if (code == PETSC_ERR_MEM)
      throw out_of_memory(what);
    if (code != 0)
      throw ComputationError(std::string("the linear algebra failed while it ") + what + " (PETSc error " +
                             std::to_string(code) + "): most likely memory is short; use a coarser mesh");
  }
} // namespace swimtwin
