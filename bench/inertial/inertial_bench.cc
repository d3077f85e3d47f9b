// The reduced swimmer with inertia against the full-order model's table.
//
//   bench_inertial train MODEL_IN MODEL_OUT [n samples (150) [angle]]
//       add inertia to a model that is trained without; angle: it may depend on the head's even if nothing else does
//   bench_inertial compare MODEL TABLE.csv                        third-period displacements, run by run
//   bench_inertial time MODEL                                     of right-hand sides and periods
#include <datasets/reduced/reduced_model.h>
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <datasets/text/csv_table.h>
#include <rom/integration/swimmer_integrator.h>
#include <rom/sweep/sweep.h>
#include <rom/training/inertia_training.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

namespace swimtwin
{
  namespace
  {
    Scene scene_of(const ReducedModel &model)
    {
      return parse_scene(model.scene_text, model.scene_name + ".toml");
    }

    /// Makes the head's angle a variable, of which the resistance makes nothing.
    void add_angle(ReducedResistance &resistance)
    {
      const Eigen::Index r = resistance.coordinate_scale_m.size(), m = resistance.exponents.cols();
      if (resistance.depends_on_angle)
        return;
      Eigen::MatrixXi exponents   = Eigen::MatrixXi::Zero(resistance.exponents.rows(), m + 1);
      exponents.leftCols(r)       = resistance.exponents.leftCols(r);
      exponents.rightCols(m - r)  = resistance.exponents.rightCols(m - r);
      resistance.exponents        = exponents;
      resistance.depends_on_angle = true;
      resistance.angle_scale_rad  = 1.2;
    }

    void train_with_inertia(const std::string &in, const std::string &out, const int n_samples, const bool with_angle)
    {
      ReducedModel model = read_reduced_model(in);
      if (with_angle)
        add_angle(model.resistance);
      const Scene  scene   = scene_of(model);
      const double start   = process_cpu_time_s();
      const auto   trained = train_inertia(model, scene, n_samples, MPI_COMM_WORLD, [](const int done, const int all) {
        fmt::print(stderr, "\r{} of {}", done, all);
      });
      const double spent_s = process_cpu_time_s() - start;
      model.inertia        = trained.inertia;
      const std::string found =
          fmt::format("{} samples, {} monomials, {:.0f} s of CPU time; masses off by {:.2g} %, the power of quadratic "
                      "forces by {:.2g} % (cross-validated); the mesh adds forces of {:.2g} % of the largest",
                      trained.n_samples, model.inertia.exponents.rows(), spent_s, 100. * trained.mass_error,
                      100. * trained.quadratic_error, 100. * trained.power_defect);
      fmt::print("\n{}\n", found);
      TrainingRecord &record = model.record;
      record.cpu_time_s += spent_s;
      record.neglects.front() = neglected_inertia(model, scene);
      record.history.push_back("Inertia was added afterwards: " + found + ".");
      write_reduced_model(
          out, model,
          {current_program_version,
           fmt::format("bench_inertial train {} ... {}", std::filesystem::path(in).filename().string(), n_samples),
           scene.text, scene.hash, utc_time_now(), spent_s});
    }

    InertialDensities densities_of(const Scene &scene, const std::string &terms)
    {
      const auto any = [&terms](const std::string &term) { return terms == term || terms == "full"; };
      return {any("fluid") ? scene.fluid->density_kg_m3 : 0.,
              any("body") || terms == "tail" ? scene.tail->density_kg_m3
              : terms == "head"              ? 1.
                                             : 0.,
              any("body") || terms == "head" ? scene.head.density_kg_m3 : 0.};
    }

    /// A full-order run with some terms of inertia.
    struct FullOrderRun
    {
      double      young_modulus_Pa, viscosity_Pa_s, magnetization_A_m, frequency_Hz;
      std::string terms;
      double      displacement_m;
    };

    /// Where a table has runs of several steps, those of the most steps. What it does not say is as in the scene, with
    /// all of inertia.
    std::vector<FullOrderRun> read_runs(const std::string &file, const Scene &scene)
    {
      const CsvTable table     = CsvTable::read(file);
      const auto     column_or = [&](const char *name, const double value) {
        return table.has_column(name) ? table.column(name) : std::vector(table.n_rows(), value);
      };
      const auto M = table.column("magnetization_A_m"), f = table.column("frequency_Hz"),
                 d = table.column("displacement_m"), mu = column_or("viscosity_Pa_s", scene.fluid->viscosity_Pa_s),
                 E                    = column_or("young_modulus_Pa", scene.tail->young_modulus_Pa),
                 steps                = column_or("steps_per_period", 0.);
      const auto                terms = table.find_column("terms");
      const double              most  = steps.empty() ? 0. : *std::max_element(steps.begin(), steps.end());
      std::vector<FullOrderRun> runs;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        if (steps[row] == most)
          runs.push_back({E[row], mu[row], M[row], f[row], terms ? table.cells(row)[*terms] : "full", d[row]});
      return runs;
    }

    double displacement(const ReducedModel &model, const Scene &scene, const FullOrderRun &run)
    {
      SweepOptions options = sweep_options(scene, model);
      options.periodic = options.indicator = false;
      options.n_threads                    = 1;
      options.densities                    = densities_of(scene, run.terms);
      const auto result                    = sweep(
                             model, {{run.young_modulus_Pa}, {run.viscosity_Pa_s}, {run.magnetization_A_m}, {}, {}, {run.frequency_Hz}},
                             options);
      if (!result.front().note.empty())
        fmt::print("  {}\n", result.front().note);
      return result.front().displacement_m;
    }

    /// How far off, in %, over several runs.
    struct Deviations
    {
      double squares = 0., largest = 0.;
      int    n = 0;

      void add(const double off)
      {
        squares += off * off;
        largest = std::max(largest, std::abs(off));
        ++n;
      }
    };

    void compare(const std::string &file, const std::string &table)
    {
      const ReducedModel                                   model = read_reduced_model(file);
      const Scene                                          scene = scene_of(model);
      std::map<std::pair<double, std::string>, Deviations> deviations; // by viscosity and terms
      fmt::print("E (kPa), viscosity (Pa s), M (kA/m), f (Hz), terms: full-order (um), reduced, off in %\n");
      for (const FullOrderRun &run : read_runs(table, scene))
      {
        const double reduced = displacement(model, scene, run), off = 100. * (reduced / run.displacement_m - 1.);
        deviations[{run.viscosity_Pa_s, run.terms}].add(off);
        fmt::print("{:5.4g} {:5.3g} {:4.4g} {:4.3g} {:5}: {:8.3f} {:8.3f} {:+6.2f} %\n", 1e-3 * run.young_modulus_Pa,
                   run.viscosity_Pa_s, 1e-3 * run.magnetization_A_m, run.frequency_Hz, run.terms,
                   1e6 * run.displacement_m, 1e6 * reduced, off);
        std::fflush(stdout);
      }
      for (const auto &[what, off] : deviations)
        fmt::print("{} at {:.3g} Pa s: {:.2f} % rms, {:.2f} % worst of {}\n", what.second, what.first,
                   std::sqrt(off.squares / off.n), off.largest, off.n);
    }

    void time(const std::string &file)
    {
      const ReducedModel model = read_reduced_model(file);
      const Scene        scene = scene_of(model);
      for (const char *terms : {"none", "full"})
      {
        const ReducedSwimmer swimmer(model, densities_of(scene, terms));
        SwimmerMotion        motion      = swimmer.make_motion();
        RateDerivatives      derivatives = swimmer.make_derivatives();
        SwimmerState         state       = state_at_rest(swimmer, .1);
        state.segment(3, swimmer.n_modes()).setConstant(1e-5);
        const SwimmerParameters parameters = swimmer_parameters(scene);
        constexpr int           n          = 20000;
        double                  start      = thread_cpu_time_s();
        for (int k = 0; k < n; ++k)
          swimmer.set_rate(state, {5e-3, 1e-3}, parameters, motion);
        const double rate = (thread_cpu_time_s() - start) / n;
        start             = thread_cpu_time_s();
        for (int k = 0; k < n / 10; ++k)
          swimmer.differentiate(state, {5e-3, 1e-3}, parameters, motion, derivatives);
        const double jacobian = (thread_cpu_time_s() - start) / (n / 10);
        RunRequest   request  = sweep_options(scene, model).base;
        request.initial_state = state_at_rest(swimmer);
        SwimmerIntegrator integrator(swimmer, {});
        start                = thread_cpu_time_s();
        const SwimmerRun run = integrator.run(request);
        fmt::print("{}: right-hand side {:.2f} us, Jacobian {:.1f} us, a period {:.3f} ms ({} steps, {} rates, {} "
                   "Jacobians in three)\n",
                   terms, 1e6 * rate, 1e6 * jacobian, 1e3 * (thread_cpu_time_s() - start) / 3., run.n_steps,
                   run.n_rate_evaluations, run.n_jacobians);
      }
    }
  } // namespace
} // namespace swimtwin

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::vector<std::string>           words(argv + 1, argv + argc);
  try
  {
    if (words.size() >= 3 && words[0] == "train")
      swimtwin::train_with_inertia(words[1], words[2], words.size() > 3 ? std::stoi(words[3]) : 150,
                                   words.size() > 4 && words[4] == "angle");
    else if (words.size() == 3 && words[0] == "compare")
      swimtwin::compare(words[1], words[2]);
    else if (words.size() == 2 && words[0] == "time")
      swimtwin::time(words[1]);
    else
    {
      fmt::print(stderr, "see the top of bench/inertial/inertial_bench.cc\n");
      return 2;
    }
    return 0;
  }
  catch (const std::exception &error)
  {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
