// The buffer of the BLAS.
#pragma once

namespace swimtwin
{
  /// OpenBLAS takes a buffer at its first product, keeps it, and tries for ever if there is no memory for it: let it
  /// take the buffer now. Throws ComputationError if there is none.
  void take_blas_buffer();
} // namespace swimtwin
