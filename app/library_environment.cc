#include <app/library_environment.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace swimtwin
{
  namespace
  {
    template <std::size_t n>
    void drop_variables(const std::array<std::string_view, n> &prefixes)
    {
      std::vector<std::string> names;
      for (char **entry = environ; entry != nullptr && *entry != nullptr; ++entry)
      {
        const std::string_view name = std::string_view(*entry).substr(0, std::string_view(*entry).find('='));
        if (name != "HDF5_USE_FILE_LOCKING" &&
            std::any_of(prefixes.begin(), prefixes.end(), [&](const auto &prefix) { return name.starts_with(prefix); }))
          names.emplace_back(name);
      }
      for (const std::string &name : names)
        ::unsetenv(name.c_str());
    }

    bool is_launched()
    {
      return std::getenv("PMIX_NAMESPACE") != nullptr && std::getenv("PMIX_RANK") != nullptr;
    }
  } // namespace

  int launched_rank()
  {
    int rank = 0;
    if (is_launched())
    {
      const std::string_view text(std::getenv("PMIX_RANK"));
      std::from_chars(text.data(), text.data() + text.size(), rank);
    }
    return rank;
  }

  void quiet_library_environment()
  {
    drop_variables(std::array<std::string_view, 13>{"PETSC_", "SLEPC_", "DEAL_II_", "OMP_", "GOMP_", "KMP_",
                                                    "OPENBLAS_", "GOTO_", "MKL_", "BLIS_", "KOKKOS_", "HDF5_",
                                                    "GMSH_"});
    for (const char *name : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "DEAL_II_NUM_THREADS"})
      ::setenv(name, "1", 1);
  }

  void settle_mpi_environment(const RanksAtWork ranks)
  {
    if (ranks == RanksAtWork::all && is_launched())
      return;
    drop_variables(std::array<std::string_view, 6>{"OMPI_", "PMIX_", "PMI_", "ORTE_", "OPAL_", "PRTE_"});
    ::setenv("OMPI_MCA_ess", "singleton", 1);
    ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
    ::setenv("OMPI_MCA_orte_create_session_dirs", "0", 1);
    ::setenv("OMPI_MCA_btl", "self", 1);
    ::setenv("OMPI_MCA_mca_base_param_files", "none", 1);
    ::setenv("PMIX_MCA_mca_base_param_files", "none", 1);
  }
} // namespace swimtwin
