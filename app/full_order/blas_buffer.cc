#include <app/full_order/blas_buffer.h>

#include <datasets/system/memory_limits.h>

#include <petscsys.h> // before the next, which needs it

#include <petscblaslapack.h>

#include <vector>

namespace swimtwin
{
  void take_blas_buffer()
  {
    constexpr double buffer_MB = 140.; // 134 MB of address space with the kernels of wide registers, less with others
    require_memory("the buffer of the BLAS", {buffer_MB, buffer_MB, 0.}, "close other programs");
    constexpr PetscBLASInt    n   = 128; // smaller products do without the buffer
    constexpr double          one = 1., zero           = 0.;
    const std::vector<double> a(std::size_t(n) * n), b = a;
    std::vector<double>       c = a;
    BLASgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
  }
} // namespace swimtwin
