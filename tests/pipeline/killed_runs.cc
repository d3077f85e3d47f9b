#include <tests/pipeline/killed_runs.h>

#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_open.h>
#include <datasets/run/plane_flow.h>
#include <datasets/run/snapshot_set.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <set>

namespace swimtwin
{
  namespace
  {
    namespace fs = std::filesystem;
    using Clock  = std::chrono::steady_clock;

    constexpr int steps_per_period = 40, checkpoint_interval = steps_per_period / 10;

    std::vector<fs::path> files_below(const fs::path &folder)
    {
      std::vector<fs::path> files;
      std::error_code       ignored; // names come and go
      for (fs::recursive_directory_iterator entry(folder, ignored), end; !ignored && entry != end;
           entry.increment(ignored))
        files.push_back(entry->path());
      return files;
    }

    bool is_temporary(const fs::path &path)
    {
      return path.string().find(".partial") != std::string::npos;
    }

    bool has_temporary_file(const fs::path &folder)
    {
      const auto files = files_below(folder);
      return std::any_of(files.begin(), files.end(), is_temporary);
    }

    bool has_staged_results(const fs::path &folder)
    {
      const auto files = files_below(folder);
      return fs::exists(folder / "trajectory.csv") || fs::exists(folder / "summary.json") ||
             std::any_of(files.begin(), files.end(),
                         [](const fs::path &file) { return file.string().find("staged") != std::string::npos; });
    }

    /// Of the time grid, in the last checkpoint; -1 without one.
    int step_of_checkpoint(const fs::path &folder)
    {
      const fs::path file = folder / "checkpoint.h5";
      return fs::exists(file) ? static_cast<int>(Hdf5Reader(file).read_number_attribute("/", "grid_step")) : -1;
    }

    int step_of_last_field(const fs::path &folder)
    {
      int last = -1;
      for (const fs::path &file : files_below(folder))
        if (const std::string name = file.filename().string(); name.starts_with("tail-") && file.extension() == ".vtu")
          last = std::max(last, std::stoi(name.substr(5)));
      return last;
    }

    void expect_listed_fields_to_exist(const fs::path &list)
    {
      const std::string text = content(list);
      EXPECT_NE(text.find("</VTKFile>"), std::string::npos) << list;
      for (std::size_t at = text.find("file=\""); at != std::string::npos; at = text.find("file=\"", at + 1))
      {
        const std::string name = text.substr(at + 6, text.find('"', at + 6) - at - 6);
        EXPECT_TRUE(fs::exists(list.parent_path() / name)) << list << " lists " << name;
      }
    }

    /// Each file that has its final name is whole.
    void expect_whole(const fs::path &file, const std::size_t n_rows)
    {
      const std::string name = file.filename().string();
      if (name == "checkpoint.h5")
        EXPECT_NO_THROW(require_seal(file, ""));
      else if (name == "trajectory.csv")
        EXPECT_EQ(read_trajectory_csv(file).size(), n_rows);
      else if (name == "summary.json")
        EXPECT_EQ(read_run_summary_json(file).summary.status, "completed");
      else if (name == "snapshots.h5")
        EXPECT_EQ(read_snapshots(file).time_s.size(), n_rows);
      else if (name == "flow.h5")
        EXPECT_EQ(read_plane_flows(file).size(), 4u);
      else if (file.extension() == ".vtu")
        EXPECT_NE(content(file).find("</VTKFile>"), std::string::npos) << file;
      else if (file.extension() == ".pvd")
        expect_listed_fields_to_exist(file);
      else
        EXPECT_TRUE(name == "fields" || name == ".swimtwin.lock") << file << " is left";
    }

    std::set<std::string> names_in(const fs::path &folder)
    {
      std::set<std::string> names;
      for (const fs::path &file : files_below(folder))
        names.insert(fs::relative(file, folder).string());
      return names;
    }

    /// The run that is not interrupted, and its wall time: what all others are measured against.
    struct Uninterrupted
    {
      Motion                        motion;
      std::set<std::string>         names;
      std::chrono::duration<double> time;
    };

    Uninterrupted run_uninterrupted(const ShrunkScene &scene)
    {
      const TemporaryFolder folder;
      const auto            start = Clock::now();
      simulate(scene, folder.path);
      return {read_motion(folder.path), names_in(folder.path), Clock::now() - start};
    }

    void expect_the_uninterrupted_end(const fs::path &folder, const Uninterrupted &whole)
    {
      constexpr double round_off = 1e-9; // body lengths, rad: the coupling and linear tolerances hide less
      const Motion     resumed   = read_motion(folder);
      EXPECT_LE(distance(resumed.trajectory, whole.motion.trajectory), round_off);
      EXPECT_LE(largest_angle_difference(resumed.trajectory, whole.motion.trajectory), round_off);
      EXPECT_EQ(resumed.summary.n_steps, whole.motion.summary.n_steps);
      EXPECT_EQ(resumed.summary.n_remeshes, whole.motion.summary.n_remeshes);
      EXPECT_EQ(names_in(folder), whole.names);
    }

    /// A run in a folder of its own, killed and resumed.
    class KilledRun
    {
    public:
      KilledRun(const ShrunkScene &scene, const Uninterrupted &whole) : scene_(scene), whole_(whole) {}

      /// False if it came to its end before the kill.
      bool start_and_kill(const KillInstant instant, const double fraction)
      {
        const int    before = step_of_checkpoint(run_);
        ChildProcess process(tool(simulate_arguments(scene_, run_, {"--resume", "--quiet"})));
        wait_for(process, instant, fraction);
        if (!process.kill())
        {
          const Outcome outcome = process.wait();
          EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
          expect_the_uninterrupted_end(run_, whole_);
          return false;
        }
        expect_nothing_lost_or_false(before);
        return true;
      }

      void finish()
      {
        simulate(scene_, run_, {"--resume", "--quiet"});
        expect_the_uninterrupted_end(run_, whole_);
      }

    private:
      void wait_for(ChildProcess &process, const KillInstant instant, const double fraction) const
      {
        const auto latest = Clock::now() + 0.8 * fraction * whole_.time;
        if (instant != KillInstant::results_named)
          process.wait_until([&] { return Clock::now() >= latest; });
        if (instant == KillInstant::while_writing)
          process.wait_until([&] { return has_temporary_file(run_); });
        if (instant == KillInstant::results_named)
          process.wait_until([&] { return has_staged_results(run_); });
      }

      void expect_nothing_lost_or_false(const int step_before) const
      {
        const int step = step_of_checkpoint(run_);
        if (step < 0 && step_before >= 0) // killed on its way out, when all was done
          EXPECT_TRUE(fs::exists(run_ / "summary.json")) << "neither a checkpoint nor results";
        else
        {
          EXPECT_GE(step, step_before);
          EXPECT_GE(step, step_of_last_field(run_) - checkpoint_interval);
        }
        for (const fs::path &file : files_below(run_))
          if (!is_temporary(file))
            expect_whole(file, whole_.motion.trajectory.size());
      }

      const ShrunkScene   &scene_;
      const Uninterrupted &whole_;
      TemporaryFolder      folder_;
      const fs::path       run_ = folder_.path / "run";
    };
  } // namespace

  ShrunkScene busy_swimmer(const std::string &inertia)
  {
    return coarse_swimmer(steps_per_period, 1.)
        .with({"fluid.inertia=" + inertia, "fluid.viscosity_Pa_s=0.5", "numerics.remesh_every_steps=15",
               "output.fields_per_period=40", "output.snapshots_per_period=40"});
  }

  void kill_and_resume(const ShrunkScene &scene, const int n_kills, const unsigned int seed)
  {
    const Uninterrupted whole = run_uninterrupted(scene);
    std::mt19937        random(seed);
    int                 n = 0, n_runs = 0, n_of_kind[3] = {};
    while (n < n_kills && !testing::Test::HasFailure())
    {
      ++n_runs;
      KilledRun run(scene, whole);
      bool      goes_on = true;
      while (goes_on && n < n_kills && !testing::Test::HasFailure())
      {
        // Every seventh at the end: such a process goes all the way.
        const auto instant = n % 7 == 6   ? KillInstant::results_named
                             : n % 2 == 1 ? KillInstant::while_writing
                                          : KillInstant::any_time;
        goes_on            = run.start_and_kill(instant, double(random()) / double(std::mt19937::max()));
        n += goes_on;
        n_of_kind[int(instant)] += goes_on;
      }
      if (goes_on)
        run.finish();
    }
    std::cout << n << " kills in " << n_runs << " runs: " << n_of_kind[0] << " at any time, " << n_of_kind[1]
              << " while a file was written, " << n_of_kind[2] << " while results took their names" << std::endl;
  }
} // namespace swimtwin
