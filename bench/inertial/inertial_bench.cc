// The reduced swimmer with inertia against the full-order model's table.
//
//   bench_inertial train MODEL_IN MODEL_OUT [n samples (150) [angle]]
//       add inertia to a model that is trained without; angle: it may depend on the head's even if nothing else does
//   bench_inertial compare MODEL TABLE.csv                        third-period displacements, term by term
//   bench_inertial time MODEL                                     of right-hand sides and periods
#include <datasets/reduced/reduced_model.h>
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <rom/integration/swimmer_integrator.h>
#include <rom/sweep/sweep.h>
#include <rom/training/inertia_training.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

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
      model.inertia        = trained.inertia;
      fmt::print("\n{} samples in {:.0f} s, {} monomials; off by {:.2g} % (M), {:.2g} % (quadratic), defect of power "
                 "{:.2g} %\n",
                 trained.n_samples, process_cpu_time_s() - start, model.inertia.exponents.rows(),
                 100. * trained.mass_error, 100. * trained.quadratic_error, 100. * trained.power_defect);
      write_reduced_model(out, model,
                          {current_program_version, "bench_inertial", scene.text, scene.hash, utc_time_now(),
                           process_cpu_time_s() - start});
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

    double displacement(const ReducedModel &model, const Scene &scene, const std::string &terms, const double M,
                        const double viscosity, const double frequency)
    {
      SweepOptions options = sweep_options(scene, model);
      options.periodic = options.indicator = false;
      options.n_threads                    = 1;
      options.densities                    = densities_of(scene, terms);
      const auto result                    = sweep(model, {{}, {viscosity}, {M}, {}, {}, {frequency}}, options).front();
      if (!result.note.empty())
        fmt::print("  {}\n", result.note);
      return result.displacement_m;
    }

    void compare(const std::string &file, const std::string &table)
    {
      const ReducedModel model = read_reduced_model(file);
      const Scene        scene = scene_of(model);
      std::ifstream      in(table);
      std::string        line;
      std::getline(in, line);
      std::map<std::string, Eigen::Array3d>                                       sums;
      std::map<std::tuple<double, double, double>, std::map<std::string, double>> rows;
      while (std::getline(in, line))
      {
        std::istringstream       fields(line);
        std::vector<std::string> cells;
        for (std::string cell; std::getline(fields, cell, ',');)
          cells.push_back(cell);
        rows[{std::stod(cells[1]), std::stod(cells[0]), std::stod(cells[2])}][cells[3]] = std::stod(cells[4]);
      }
      fmt::print("viscosity  M  f: full-order (um), reduced, off in % for none, body, fluid, full\n");
      for (const auto &[key, full_order] : rows)
      {
        const auto &[viscosity, M, frequency] = key;
        std::string text                      = fmt::format("{:5.3g} {:6.0f} {:4.2g}:", viscosity, M, frequency);
        for (const char *terms : {"none", "head", "tail", "body", "fluid", "full"})
          if (full_order.contains(terms))
          {
            const double truth   = full_order.at(terms);
            const double reduced = displacement(model, scene, terms, M, viscosity, frequency);
            const double off     = 100. * (reduced / truth - 1.);
            text += fmt::format("  {:7.2f} {:7.2f} {:+6.2f} %", 1e6 * truth, 1e6 * reduced, off);
            auto &sum = sums.try_emplace(fmt::format("{} at {:.3g} Pa s", terms, viscosity), Eigen::Array3d::Zero())
                            .first->second;
            sum += Eigen::Array3d(1., off * off, 0.);
            sum[2] = std::max(sum[2], std::abs(off));
          }
        fmt::print("{}\n", text);
        std::fflush(stdout);
      }
      for (const auto &[what, sum] : sums)
        fmt::print("{}: {:.2f} % rms, {:.2f} % worst of {:.0f}\n", what, std::sqrt(sum[1] / sum[0]), sum[2], sum[0]);
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
