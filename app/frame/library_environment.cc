#include <app/frame/library_environment.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace swimtwin
{
  namespace
  {
    /// Whether the processor has the registers that kernels of this name use (OpenBLAS trusts the name; one that it
    /// does not know it leaves alone).
    bool kernels_fit_processor([[maybe_unused]] std::string kernels)
    {
#ifdef __x86_64__
      std::transform(kernels.begin(), kernels.end(), kernels.begin(),
                     [](const unsigned char c) { return static_cast<char>(std::tolower(c)); });
      const auto is_one_of = [&](const std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), kernels) != names.end();
      };
      if (is_one_of({"skylakex", "cooperlake", "sapphirerapids"}))
        return __builtin_cpu_supports("avx512f") != 0;
      if (is_one_of({"haswell", "zen", "excavator"}))
        return __builtin_cpu_supports("avx2") != 0;
      if (is_one_of({"sandybridge", "bulldozer", "piledriver", "steamroller"}))
        return __builtin_cpu_supports("avx") != 0;
#endif
      return true;
    }

    /// Variables that somebody may have set for good reason, and that break nothing.
    bool may_stay(const std::string_view name, const char *value)
    {
      if (name == "OPENBLAS_CORETYPE") // decides the last digits of a result
        return kernels_fit_processor(value);
      return name == "HDF5_USE_FILE_LOCKING" || name == "OPENBLAS_L2_SIZE";
    }

    template <std::size_t n>
    void drop_variables(const std::array<std::string_view, n> &prefixes)
    {
      std::vector<std::string> names;
      for (char **entry = environ; entry != nullptr && *entry != nullptr; ++entry)
      {
        const std::string_view text = *entry, name = text.substr(0, text.find('='));
        const char            *value = name.size() < text.size() ? *entry + name.size() + 1 : "";
        const bool             foreign =
            std::any_of(prefixes.begin(), prefixes.end(), [&](const auto &prefix) { return name.starts_with(prefix); });
        if (foreign && !may_stay(name, value))
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

  std::string unknown_launcher()
  {
    const auto has_several = [](const char *variable) {
      const char *n_tasks = std::getenv(variable);
      return n_tasks != nullptr && std::string_view(n_tasks) != "1";
    };
    if (is_launched())
      return {};
    return has_several("SLURM_STEP_NUM_TASKS") ? "srun" : has_several("FLUX_JOB_SIZE") ? "flux run" : "";
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
    drop_variables(std::array<std::string_view, 10>{"OMPI_", "PMIX_", "PMI_", "ORTE_", "OPAL_", "PRTE_", "SLURM_",
                                                    "FLUX_", "ALPS_", "UCX_"});
    ::setenv("OMPI_MCA_ess", "singleton", 1);
    ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
    ::setenv("OMPI_MCA_orte_create_session_dirs", "0", 1);
    ::setenv("OMPI_MCA_btl", "self", 1);
    ::setenv("OMPI_MCA_pml", "ob1", 1); // others look for fast networks, and complain of what they find
    ::setenv("OMPI_MCA_mca_base_param_files", "none", 1);
    ::setenv("PMIX_MCA_mca_base_param_files", "none", 1);
  }
} // namespace swimtwin
