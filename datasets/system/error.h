// The two failures that the command-line tool knows. Anything else that is thrown is a defect of ours.
#pragma once

#include <stdexcept>

namespace swimtwin
{
  /// The user can fix it: bad scene, missing file, impossible value. The tool prints what() and exits with 2.
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// A healthy input whose computation failed (solver, mesh, disk). The tool prints what() and exits with 1.
  class ComputationError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// What is healthy with more memory, or a coarser mesh.
  class OutOfMemory : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };
} // namespace swimtwin
