#include <app/frame/library_environment.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace swimtwin
{
  namespace
  {
    std::string value_of(const char *name)
    {
      const char *value = std::getenv(name);
      return value != nullptr ? value : "";
    }
  } // namespace

  TEST(LibraryEnvironment, KeepsNothingThatChangesLibraries)
  {
    for (const char *name : {"PETSC_OPTIONS", "PETSC_OPTIONS_YAML", "OMP_PROC_BIND", "GOMP_CPU_AFFINITY", "HDF5_DEBUG",
                             "OPENBLAS_VERBOSE", "GMSH_HOME"})
      setenv(name, "nonsense", 1);
    setenv("DEAL_II_NUM_THREADS", "many", 1);
    setenv("OMP_NUM_THREADS", "-3", 1);
    quiet_library_environment();
    for (const char *name : {"PETSC_OPTIONS", "PETSC_OPTIONS_YAML", "OMP_PROC_BIND", "GOMP_CPU_AFFINITY", "HDF5_DEBUG",
                             "OPENBLAS_VERBOSE", "GMSH_HOME"})
      EXPECT_EQ(std::getenv(name), nullptr) << name;
    EXPECT_EQ(value_of("DEAL_II_NUM_THREADS") + value_of("OMP_NUM_THREADS") + value_of("OPENBLAS_NUM_THREADS"), "111");
  }

  TEST(LibraryEnvironment, KeepsWhatSomeFileSystemsNeed)
  {
    setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
    quiet_library_environment();
    EXPECT_EQ(value_of("HDF5_USE_FILE_LOCKING"), "FALSE");
    unsetenv("HDF5_USE_FILE_LOCKING");
  }

  TEST(LibraryEnvironment, KeepsKernelsThatTheProcessorCanRun)
  {
    const auto is_kept = [](const char *kernels) {
      setenv("OPENBLAS_CORETYPE", kernels, 1);
      quiet_library_environment();
      const bool kept = value_of("OPENBLAS_CORETYPE") == kernels;
      unsetenv("OPENBLAS_CORETYPE");
      return kept;
    };
    EXPECT_TRUE(is_kept("Core2"));
#ifdef __x86_64__
    EXPECT_EQ(is_kept("SkylakeX"), __builtin_cpu_supports("avx512f") != 0);
    EXPECT_EQ(is_kept("Haswell"), __builtin_cpu_supports("avx2") != 0);
#endif
  }

  TEST(LibraryEnvironment, RankIsWhatTheLauncherSays)
  {
    setenv("PMIX_RANK", "3", 1);
    EXPECT_EQ(launched_rank(), 0) << "a rank without a job";
    setenv("PMIX_NAMESPACE", "job", 1);
    EXPECT_EQ(launched_rank(), 3);
    setenv("OMPI_MCA_btl", "tcp", 1);
    settle_mpi_environment(RanksAtWork::all);
    EXPECT_EQ(launched_rank(), 3) << "taken out of its job";
    EXPECT_EQ(value_of("OMPI_MCA_btl"), "tcp");
    settle_mpi_environment(RanksAtWork::this_one);
    EXPECT_EQ(launched_rank(), 0);
    EXPECT_EQ(value_of("OMPI_MCA_btl") + value_of("OMPI_MCA_ess_singleton_isolated"), "self1");
  }

  TEST(LibraryEnvironment, AnAllocationOfTheClusterIsNoLauncher)
  {
    for (const char *name : {"SLURM_NODELIST", "SLURM_STEP_ID", "SLURM_STEP_NUM_TASKS", "FLUX_JOB_ID", "ALPS_APP_ID"})
      setenv(name, "1", 1);
    EXPECT_EQ(unknown_launcher(), "");
    setenv("SLURM_STEP_NUM_TASKS", "4", 1);
    EXPECT_EQ(unknown_launcher(), "srun");
    settle_mpi_environment(RanksAtWork::all);
    for (const char *name : {"SLURM_NODELIST", "SLURM_STEP_ID", "SLURM_STEP_NUM_TASKS", "FLUX_JOB_ID", "ALPS_APP_ID"})
      EXPECT_EQ(std::getenv(name), nullptr) << name;
  }
} // namespace swimtwin
