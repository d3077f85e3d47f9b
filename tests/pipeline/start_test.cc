#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <sys/resource.h>

namespace swimtwin
{
  namespace
  {
    const ShrunkScene small_swimmer = coarse_swimmer(20, 0.1);

    /// A line of the shell with the tool as $TOOL; what is in front of it stands in for the user's machine.
    Outcome shell(const std::string &line)
    {
      return run({"sh", "-c", "TOOL=" + std::string(places::tool) + "; " + line});
    }

    std::string plan_words()
    {
      std::string words = "plan --quiet";
      for (const std::string &word : small_swimmer.arguments())
        words += " " + word;
      return words;
    }

    void expect_silent_success(const Outcome &outcome)
    {
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(outcome.out + outcome.err, "");
    }

    /// User and system, of children that ended.
    double cpu_time_of_children_s()
    {
      rusage usage{};
      getrusage(RUSAGE_CHILDREN, &usage);
      const auto seconds = [](const timeval &t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
      return seconds(usage.ru_utime) + seconds(usage.ru_stime);
    }
  } // namespace

  TEST(Start, TheToolLinksNothingOfTheFullOrderModel)
  {
    const Outcome libraries = run({"ldd", places::tool});
    ASSERT_EQ(libraries.exit_code, 0) << libraries.err;
    for (const char *library : {"deal", "petsc", "slepc", "gmsh", "trilinos", "mumps", "blas", "libTK", "vtk"})
      EXPECT_EQ(libraries.out.find(library), std::string::npos) << library;
    // HDF5 brings MPI along, but nobody in the tool can start it.
    const Outcome symbols = run({"nm", "--dynamic", "--undefined-only", places::tool});
    ASSERT_EQ(symbols.exit_code, 0) << symbols.err;
    EXPECT_EQ(symbols.out.find("MPI_Init"), std::string::npos);
    EXPECT_EQ(symbols.out.find("PetscInit"), std::string::npos);
  }

  TEST(Start, WordsAndInputAreReadBeforeAnyLibraryStarts)
  {
#ifdef __SANITIZE_ADDRESS__
    constexpr double slower = 3.;
#else
    constexpr double slower = 1.;
#endif
    const std::string shipped = places::source + std::string("/datasets");
    const auto        takes   = [&](const std::vector<std::string> &words, const int exit_code) {
      const double before = cpu_time_of_children_s();
      EXPECT_EQ(run_tool(words).exit_code, exit_code) << words.front();
      return (cpu_time_of_children_s() - before) / slower;
    };
    // Full-order libraries take 0.3 s of CPU time to load and start.
    EXPECT_LE(takes({"--version"}, 0), 0.15);
    EXPECT_LE(takes({"simulate", "--help"}, 0), 0.15);
    EXPECT_LE(takes({"calibrate", "reference-2d", shipped + "/problems/two-ratios.toml", "--data",
                     shipped + "/observations/synthetic-soft.csv", "--check"},
                    0),
              0.15);
    EXPECT_LE(takes({"simulate", "no-such-scene", "--output", "unused"}, 2), 0.15);
    EXPECT_LE(takes({"optimize", "no-such-model", "goal.toml", "--replay", "--output", "unused"}, 2), 0.15);
  }

  TEST(Start, NeedsNeitherSshNorAFolderForTemporaryFilesNorAnyVariable)
  {
    expect_silent_success(shell("exec env -i $TOOL " + plan_words()));
    expect_silent_success(shell("TMPDIR=/nonexistent PATH=/nonexistent exec $TOOL " + plan_words()));
    expect_silent_success(shell("HOME=/nonexistent exec $TOOL " + plan_words()));
  }

  TEST(Start, TakesNoOrdersFromOthersSettings)
  {
    const TemporaryFolder folder;
    const std::string     options = "-ksp_type nonsense\n-log_view\n-info\n";
    for (const char *name : {".petscrc", "petscrc"})
      folder.write(name, options);
    folder.write(".gmshrc", "Mesh.MeshSizeFactor = 3;\nGeneral.Terminal = 1;\n");
    std::filesystem::create_directory(folder.path / ".openmpi");
    folder.write(".openmpi/mca-params.conf", "btl = nonsense\npml = nonsense\n");
    const std::string here = "cd " + folder.path.string() + "; export HOME=$PWD; ";
    expect_silent_success(shell(here + "exec $TOOL " + plan_words()));
    EXPECT_FALSE(std::filesystem::exists(folder.path / ".fltk")) << "written outside the output folder";
    expect_silent_success(
        shell("export PETSC_OPTIONS='-info -bad' PETSC_OPTIONS_YAML=nonsense SLEPC_DIR=x; exec $TOOL " + plan_words()));
    expect_silent_success(shell("export OMPI_MCA_btl=nonsense OMPI_MCA_pml=nonsense OMPI_MCA_plm_rsh_agent=nowhere; "
                                "exec $TOOL " +
                                plan_words()));
    expect_silent_success(shell("export OMP_NUM_THREADS=x OMP_DISPLAY_ENV=true DEAL_II_NUM_THREADS=many HDF5_DEBUG=all "
                                "OPENBLAS_CORETYPE=none OPENBLAS_VERBOSE=5 OPENBLAS_NUM_THREADS=-1; exec $TOOL " +
                                plan_words()));
  }

  TEST(Start, WorksInAFolderThatWasDeleted)
  {
    const TemporaryFolder folder;
    const std::string there = "mkdir " + (folder.path / "gone").string() + "; cd " + (folder.path / "gone").string() +
                              "; rmdir " + (folder.path / "gone").string() + "; ";
    expect_silent_success(shell(there + "exec $TOOL " + plan_words()));
    expect_failure(shell(there + "exec $TOOL " + plan_words() + " --output results"), 2, {"results"});
    EXPECT_FALSE(std::filesystem::exists("/results"));
  }

  TEST(Start, SaysWhichProgramItMisses)
  {
    const TemporaryFolder folder;
    std::filesystem::copy(places::tool, folder.path / "swimtwin");
    expect_failure(run({folder.path / "swimtwin", "plan", small_swimmer.arguments().front()}), 1,
                   {(folder.path / "swimtwin-full-order").string(), "No such file", "copy it with the tool"});
    EXPECT_EQ(run({folder.path / "swimtwin", "--version"}).exit_code, 0);
    std::filesystem::copy(std::filesystem::path(places::tool).parent_path() / "swimtwin-full-order",
                          folder.path / "swimtwin-full-order");
    EXPECT_EQ(run({folder.path / "swimtwin", "plan", small_swimmer.arguments().front(), "--quiet"}).exit_code, 0);
  }

  TEST(Start, WorksAloneInAnAllocationOfACluster)
  {
    expect_silent_success(shell("export SLURM_JOB_ID=5 SLURM_NODELIST=n1; exec $TOOL " + plan_words()));
    expect_silent_success(shell("export FLUX_JOB_ID=5 FLUX_URI=local:///x; exec $TOOL " + plan_words()));
    const TemporaryFolder folder;
    expect_failure(shell("export SLURM_NODELIST=n1 SLURM_STEP_ID=0 SLURM_STEP_NUM_TASKS=4; exec $TOOL simulate " +
                         small_swimmer.arguments().front() + " --output " + (folder.path / "run").string()),
                   2, {"srun started several tasks", "mpirun -n N"});
  }

  TEST(Start, AnMpiThatCannotStartIsOneSentence)
  {
    // The program itself, without the care that the tool takes: told to be one of a job that is not there.
    const Outcome outcome = shell("export PMIX_NAMESPACE=1 PMIX_RANK=0 OMPI_MCA_btl=nonsense OMPI_MCA_ess=pmi; exec "
                                  "$TOOL-full-order " +
                                  plan_words());
    expect_failure(outcome, 1, {"MPI and PETSc", "cannot be started"});
  }
} // namespace swimtwin
