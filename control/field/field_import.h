// Field programs from elsewhere.
#pragma once

#include <control/field/fourier_field.h>

#include <string>
#include <vector>

namespace swimtwin
{
  /// Why the numbers of a field program may be in other units than T and s; one sentence each, with the remedy.
  std::vector<std::string> unit_doubts(const FieldProgram &program);

  /// The drive of a program by its first harmonics. `loss` is the largest difference (T) of the two fields.
  struct ImportedField
  {
    Drive  drive;
    double loss_T = 0.;
  };
  ImportedField import_field(const FieldProgram &program, int n_harmonics);
} // namespace swimtwin
