#include <tests/fuzz/fuzzed_readers.h>

#include <tests/fuzz/hdf5_mutation.h>

#include <control/goal/goal_file.h>
#include <control/goal/target_goal.h>
#include <control/goal/tracking_goal.h>
#include <datasets/files/hdf5_file.h>
#include <datasets/observation/calibration_problem.h>
#include <datasets/observation/calibration_result.h>
#include <datasets/observation/observation_set.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/run/plan_result.h>
#include <datasets/run/plane_flow.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/run/snapshot_set.h>
#include <datasets/run/trajectory.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/scene.h>
#include <datasets/surface/surface_reader.h>
#include <datasets/system/error.h>
#include <reports/run/run_folder.h>
#include <reports/sweep/sweep_folder.h>
#include <rom/sweep/sweep.h>
#include <tests/datasets/example_observations.h>
#include <tests/datasets/example_surfaces.h>
#include <tests/places.h>
#include <tests/reports/synthetic_calibration.h>
#include <tests/reports/synthetic_run.h>

#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string shipped(const std::string &name)
    {
      return content(fs::path(places::source) / name);
    }

    std::vector<std::string> shipped_in(const std::string &folder, const std::string &ending)
    {
      std::vector<fs::path> files;
      for (const auto &entry : fs::directory_iterator(fs::path(places::source) / folder))
        if (entry.path().extension() == ending)
          files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      std::vector<std::string> texts;
      for (const fs::path &file : files)
        texts.push_back(content(file));
      return texts;
    }

    /// Faults of a long table show in its first rows.
    std::string first_lines(const std::string &text, int n)
    {
      std::size_t end = 0;
      while (n-- > 0 && end != std::string::npos)
        end = text.find('\n', end == 0 ? 0 : end + 1);
      return text.substr(0, end);
    }

    template <typename Write>
    std::string written(const Write &write)
    {
      const TemporaryFolder folder;
      write(folder.path / "file");
      return content(folder.path / "file");
    }

    void read_observed(const fs::path &file)
    {
      for (const Observation &point : read_observations(file).points)
        if (!(point.frequency_Hz > 0. && point.sigma_m >= 0.))
          throw std::logic_error("an observation without frequency or error bar");
    }

    FuzzedReader table_reader(const std::string &name, const std::vector<std::string> &tables,
                              const std::string &sidecar)
    {
      return {name, "data.csv", tables, {{"data.toml", sidecar}}, false, read_observed};
    }

    FuzzedReader sidecar_reader(const std::string &name, const std::vector<std::string> &sidecars,
                                const std::map<std::string, std::string> &tables)
    {
      return {name, "data.toml", sidecars, tables, false, read_observed};
    }

    /// Of two swims, three periods of each: what makes the smallest curve.
    std::string two_tracks()
    {
      std::string table = "frequency_Hz,time_s,x_m,y_m,angle_rad\n";
      for (const double frequency : {1., 2.})
        for (int i = 0; i <= 40; ++i)
          table += fmt::format("{},{},{},1e-5,-0.01\n", frequency, 0.08 * i / frequency, -1e-5 * i);
      return table;
    }

    std::string deeplabcut_table()
    {
      std::string table = "scorer,net,net,net,net,net,net\nbodyparts,head,head,head,tail,tail,tail\n"
                          "coords,x,y,likelihood,x,y,likelihood\n";
      for (int i = 0; i < 90; ++i)
        table += fmt::format("{},{},{},0.99,{},12,0.2\n", i, 100. - 0.5 * i, 10. + i % 25, 200. - i);
      return table;
    }

    const std::string side_of_tracks =
        "source = \"made\"\nsynthetic = true\nswimmer = \"none\"\nmeasured_by = \"typed\"\n"
        "period = \"periodic\"\n[field]\nbx_T = 5e-3\nby_T = 5e-3\n[camera]\n"
        "position_sigma_m = 1e-6\nhead_first = [-1, 0]\n";

    /// Two films, the second of which is as it should be.
    std::string side_of_films(const std::string &more)
    {
      return side_of_tracks +
             "pixel_m = 5e-6\nframe_s = 0.04\n[[recording]]\nfile = \"film.csv\"\nfrequency_Hz = 1.0\n" + more +
             "[[recording]]\nfile = \"other.csv\"\nfrequency_Hz = 1.8\n" + more;
    }

    std::vector<FuzzedReader> observation_readers()
    {
      const std::string cases = "tests/datasets/cases/";
      const std::string soft  = shipped("datasets/observations/synthetic-soft.csv"),
                        side  = shipped("datasets/observations/synthetic-soft.toml");
      const std::string film  = first_lines(shipped("datasets/observations/synthetic-trackmate-1Hz.csv"), 120),
                        other = first_lines(shipped("datasets/observations/synthetic-trackmate-1.8Hz.csv"), 120);
      const std::string films = side_of_films(""), labels = deeplabcut_table(),
                        labelled = side_of_films("body_part = \"head\"\n");
      const auto read_film       = [](const fs::path &file) { read_observed(file.parent_path() / "side.toml"); };
      return {table_reader("curve",
                           {soft, shipped(cases + "curves/mm.csv"), shipped(cases + "curves/replicates.csv"),
                            shipped(cases + "excel/semicolon-comma.csv"), shipped(cases + "excel/empty-columns.csv"),
                            shipped(cases + "excel/empty-rows.csv")},
                           side),
              sidecar_reader("sidecar of a curve", {side, shipped(cases + "curves/mm.toml")}, {{"data.csv", soft}}),
              table_reader("tracks", {two_tracks()}, side_of_tracks),
              sidecar_reader("sidecar of tracks", {side_of_tracks}, {{"data.csv", two_tracks()}}),
              sidecar_reader("sidecar of TrackMate films", {films}, {{"film.csv", film}, {"other.csv", other}}),
              sidecar_reader("sidecar of DeepLabCut films", {labelled}, {{"film.csv", labels}, {"other.csv", labels}}),
              {"TrackMate",
               "film.csv",
               {film, other, first_lines(shipped(cases + "trackmate/a-latin.csv"), 120)},
               {{"side.toml", films}, {"other.csv", other}},
               false,
               read_film},
              {"DeepLabCut", "film.csv", {labels}, {{"side.toml", labelled}, {"other.csv", labels}}, false, read_film}};
    }

    Trajectory short_motion()
    {
      return synthetic_trajectory(1.25, 24, 8);
    }

    std::string summary_of_a_run()
    {
      RunRecord record;
      record.summary.status                    = "completed";
      record.summary.displacement_per_period_m = {1e-4, 2e-4};
      record.summary.cpu_time_of_part_s        = {{"assembly", 1.}};
      record.summary.warnings                  = {"a doubt"};
      record.provenance = {"swimtwin 0.1.0", "simulate", swimmer_toml, "abc", "2025-01-31T12:00:00Z", 7.};
      return written([&](const fs::path &file) { write_run_summary_json(file, record); });
    }

    std::string snapshots_of_a_run()
    {
      SnapshotSet set       = synthetic_snapshots(short_motion(), 4, 2);
      const auto  n         = set.tail_nodes_m.size();
      set.tail_velocity_m_s = set.tail_displacement_m;
      set.field_T           = set.pose;
      set.clamped_nodes     = Eigen::VectorXi::LinSpaced(3, 0, 2);
      set.tail_mass_m2.resize(n, n);
      set.tail_mass_m2.setIdentity();
      return written([&](const fs::path &file) {
        write_snapshots(file, set, {"swimtwin 0.1.0", "simulate", "dimension = 2\n", "abc", "2025-01-31", 7.});
      });
    }

    std::string plan_of_a_field()
    {
      PlannedField field;
      field.status = "converged";
      field.bx_T   = {1e-3, 2e-3, 3e-3};
      field.by_T   = {0., 0., 5e-3};
      field.start  = {0.1, 1e-4};
      field.terms  = {{"mean_speed", 1e-4}};
      field.trace  = {{10, -1., 0.5, 3}, {30, -2., 0., 8}};
      PlanResult plan;
      plan.status    = "converged";
      plan.fields    = {field};
      plan.trade_off = {{0.5, 1e-4, 2e-4, 1., 2., "converged", "stalled"}};
      plan.replay    = PlanReplay{100, {{"a", 0.1, {1., 2.}, {1., 2.}, 4e-4}, {"b", 0.1, {1.}, {1.}, 5.8e-4}}, 3.};
      return written([&](const fs::path &file) { write_plan_result(file, plan); });
    }

    PlaneFlow small_flow()
    {
      PlaneFlow flow;
      flow.time_s         = 1.;
      flow.x_m            = {0., 1e-3, 2e-3};
      flow.y_m            = {0., 1e-3};
      flow.velocity_m_s   = Eigen::MatrixXd::Constant(6, 3, 1e-3);
      flow.part           = Eigen::VectorXi::LinSpaced(6, 0, 3);
      flow.head_outline_m = flow.tail_outline_m = Eigen::MatrixXd::Constant(2, 4, 1e-3);
      return flow;
    }

    std::vector<FuzzedReader> result_readers()
    {
      const std::string trajectory = written([](const fs::path &file) { write_trajectory_csv(file, short_motion()); });
      const std::string summary = summary_of_a_run(), snapshots = snapshots_of_a_run();
      const std::string calibration =
          written([](const fs::path &file) { write_calibration_result(file, synthetic_calibration(3)); });
      const auto        read_folder = [](const fs::path &file) { read_run(file.parent_path()); };
      const auto        read_table  = [](const fs::path &file) { read_sweep(file.parent_path()); };
      const std::string table       = "young_modulus_Pa,magnetization_A_m,viscosity_Pa_s,frequency_Hz,displacement_m\n"
                                      "1e5,1e5,1.52,0.8,1.7e-4\n1e5,1e5,1.52,0.9,1.8e-4\n1e5,1e5,1.52,1.2,\n";
      const std::string sweep       = "{\"model\": {\"file\": \"m.h5\", \"n_modes\": 4}, \"provenance\": "
                                      "{\"program_version\": \"a\", \"command_line\": \"b\", \"scene_text\": \"\", "
                                      "\"scene_hash\": \"\", \"created\": \"c\", \"wall_time_s\": 1.5}}\n";
      return {
          {"trajectory.csv", "trajectory.csv", {trajectory}, {{"summary.json", summary}}, false, read_folder},
          {"summary.json", "summary.json", {summary}, {{"trajectory.csv", trajectory}}, false, read_folder},
          {"snapshots.h5", "snapshots.h5", {snapshots}, {}, true, [](const fs::path &file) { read_snapshots(file); }},
          {"flow.h5",
           "flow.h5",
           {written([](const fs::path &file) {
             write_plane_flows(file, {small_flow(), small_flow()}, {"swimtwin", "simulate", "", "abc", "", 7.});
           })},
           {},
           true,
           [](const fs::path &file) { read_plane_flows(file); }},
          {"calibration.json",
           "calibration.json",
           {calibration},
           {},
           false,
           [](const fs::path &file) { read_calibration_result(file); }},
          {"plan.json",
           "plan.json",
           {plan_of_a_field()},
           {},
           false,
           [](const fs::path &file) { read_plan_result(file).confirmation(); }},
          {"displacement_frequency.csv",
           "displacement_frequency.csv",
           {table},
           {{"sweep.json", sweep}},
           false,
           read_table},
          {"sweep.json", "sweep.json", {sweep}, {{"displacement_frequency.csv", table}}, false, read_table}};
    }

    std::vector<FuzzedReader> goal_readers()
    {
      static const ReducedModel model         = read_reduced_model(std::string(places::models) + "/open-2d.h5");
      const auto                read_steering = [](const fs::path &file) {
        if (is_target_goal(file))
          read_target_goal(file, model);
        else
          read_tracking_goal(file, model);
      };
      return {{"goal",
               "goal.toml",
               shipped_in("datasets/goals", ".toml"),
               {},
               false,
               [](const fs::path &file) { read_goal(file, model); }},
              {"steering goal", "goal.toml", shipped_in("bench/tracking", ".toml"), {}, false, read_steering},
              {"calibration problem",
               "problem.toml",
               {shipped("datasets/problems/two-ratios.toml"), shipped("tests/datasets/cases/curves/problem.toml")},
               {},
               false,
               [](const fs::path &file) { read_calibration_problem(file); }}};
    }

    std::vector<FuzzedReader> scene_readers()
    {
      const std::string program = "time_s,bx_T,by_T\n0,5e-3,0\n0.25,5e-3,5e-3\n0.5,5e-3,0\n0.75,5e-3,-5e-3\n";
      return {
          {"scene",
           "scene.toml",
           shipped_in("datasets/scenes", ".toml"),
           {{"helix-3d.msh", shipped("datasets/scenes/helix-3d.msh")},
            {"tadpole-3d.msh", shipped("datasets/scenes/tadpole-3d.msh")}},
           false,
           [](const fs::path &file) { inertia_warning(read_scene(file)); }},
          {"field program",
           "field.csv",
           {program, first_lines(written([](const fs::path &file) { write_trajectory_csv(file, short_motion()); }), 8)},
           {},
           false,
           [](const fs::path &file) { FieldProgram::read_csv(file, 1.); }}};
    }

    std::vector<FuzzedReader> surface_readers()
    {
      const ExampleSurface box  = example_box({1., 2., 3.});
      const auto           read = [](const fs::path &file) {
        enclosed_volume(read_closed_surface(file, 1e-3, SurfaceUse::walls));
      };
      return {{"surface in STL", "surface.stl", {stl_text(box), stl_bytes(box)}, {}, false, read},
              {"surface of gmsh",
               "surface.msh",
               {msh_text(box), msh41_text(box, 8), msh_text(example_sphere(0, 1., true))},
               {},
               false,
               read}};
    }

    std::vector<FuzzedReader> model_readers()
    {
      const ReducedModel model = truncated(read_reduced_model(std::string(places::models) + "/open-2d.h5"), 2);
      const std::string  small = written([&](const fs::path &file) {
        write_reduced_model(file, model, {"swimtwin 0.1.0", "train", "", "abc", "2025-01-31", 7.});
      });
      return {{"reduced model", "model.h5", {small}, {}, true, [](const fs::path &file) {
                 const ReducedModel read = read_reduced_model(file);
                 sweep_options(parse_scene(read.scene_text, read.scene_name), read);
               }}};
    }

#ifdef __SANITIZE_ADDRESS__
    constexpr bool sanitized = true;
#else
    constexpr bool sanitized = false;
#endif
    constexpr std::size_t GiB = std::size_t(1) << 30;

    std::size_t peak_memory()
    {
      struct ::rusage usage = {};
      ::getrusage(RUSAGE_SELF, &usage);
      return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
    }

    /// A sentence that a user can act on; several are one per line.
    std::string fault_of_words(const std::string &words)
    {
      for (const char *foreign : {"defect", "std::", "exception", "basic_string", "vector::", "terminate"})
        if (words.find(foreign) != std::string::npos)
          return fmt::format("\"{}\" is not a sentence of ours", words);
      if (words.size() < 20 || words.find("\n\n") != std::string::npos)
        return fmt::format("\"{}\" says nothing", words);
      constexpr std::ptrdiff_t most_lines = 40;
      if (std::count(words.begin(), words.end(), '\n') > most_lines)
        return fmt::format("a message of {} lines: {}", std::count(words.begin(), words.end(), '\n'), words);
      return {};
    }

    std::string fault_of_outcome(const FuzzedReader &reader, const fs::path &file)
    {
      try
      {
        reader.read(file);
        return {};
      }
      catch (const InputError &error)
      {
        return fault_of_words(error.what());
      }
      catch (const std::exception &error)
      {
        return fmt::format("an error of its own: {}", error.what());
      }
    }
  } // namespace

  std::vector<FuzzedReader> online_readers()
  {
    std::vector<FuzzedReader> readers;
    for (const auto &group :
         {scene_readers(), surface_readers(), observation_readers(), result_readers(), goal_readers(), model_readers()})
      readers.insert(readers.end(), group.begin(), group.end());
    return readers;
  }

  void write_mutant(const FuzzedReader &reader, const fs::path &file, RandomNumbers &random)
  {
    for (const auto &[name, text] : reader.beside)
      std::ofstream(file.parent_path() / name, std::ios::binary) << text;
    const bool in_order = reader.is_hdf5 && pick(random, 4) > 0;
    std::ofstream(file, std::ios::binary)
        << (in_order ? pick_from(random, reader.seeds) : mutated_text(reader.seeds, random));
    if (in_order)
      mutate_hdf5(file, random);
    if (reader.finish)
      reader.finish(file);
  }

  void limit_reading()
  {
    if (sanitized) // takes all address space for itself
      return;
    const ::rlimit limit{6 * GiB, RLIM_INFINITY};
    ::setrlimit(RLIMIT_AS, &limit);
  }

  std::string fault_of(const FuzzedReader &reader, const fs::path &file)
  {
    constexpr unsigned int patience_s = 60;
    constexpr double       longest_s  = sanitized ? 20. : 5.; // a goal of a target is swum once
    const std::size_t      before     = peak_memory();
    const std::clock_t     start      = std::clock();
    ::alarm(patience_s);
    std::string fault = fault_of_outcome(reader, file);
    ::alarm(0);
    const double time_s = double(std::clock() - start) / CLOCKS_PER_SEC;
    if (fault.empty() && time_s > longest_s)
      fault = fmt::format("it took {:.1f} s", time_s);
    if (fault.empty() && peak_memory() > before + GiB / 2)
      fault = fmt::format("it took {} MB of memory", (peak_memory() - before) >> 20);
    return fault;
  }
} // namespace swimtwin
