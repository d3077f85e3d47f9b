#include <fom/run/simulation.h>

#include <datasets/files/folder_lock.h>
#include <datasets/files/output_folder.h>
#include <datasets/run/run_summary_json.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/scene/mirror_plane.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/system/clocks.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <fom/run/checkpoint.h>
#include <fom/run/field_output.h>
#include <fom/run/flow_in_plane.h>
#include <fom/run/run_plan.h>
#include <fom/run/run_recorder.h>
#include <fom/step/full_order_model.h>

#include <deal.II/base/mpi.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <optional>

namespace swimtwin
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    double seconds_since(const Clock::time_point start)
    {
      return std::chrono::duration<double>(Clock::now() - start).count();
    }

    double peak_memory_MB()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return usage.ru_maxrss / 1024.;
    }

    /// One run in progress.
    template <int dim>
    class Run
    {
    public:
      Run(const Scene &scene, const SimulationOptions &options, const MPI_Comm communicator)
          : scene_(scene), options_(options), communicator_(communicator),
            is_writer_(dealii::Utilities::MPI::this_mpi_process(communicator) == 0),
            checkpoint_file_(options.folder / "checkpoint.h5"), model_(scene, communicator), recorder_(scene)
      {
        if (is_writer_)
          lock_.emplace(options.folder, options.command_line);
        if (scene.output.fields_per_period > 0 && is_writer_)
          fields_.emplace(options.folder / "fields");
        if (options.resume && std::filesystem::exists(checkpoint_file_))
          resume();
        else
        {
          note(0);
          save(); // from here on the folder belongs to this run
        }
      }

      SimulationResult finish()
      {
        const int n_steps = scene_.time.n_steps(), here = grid_step_;
        while (grid_step_ < n_steps)
        {
          advance_or_explain();
          note(++grid_step_);
          if (grid_step_ % checkpoint_interval() == 0 && grid_step_ < n_steps)
            save();
          if (options_.on_progress)
            options_.on_progress({grid_step_, n_steps, seconds_since(start_), grid_step_ - here});
        }
        return write("completed");
      }

    private:
      /// Ten checkpoints a period. At each the matrix is factorised anew, so that resuming repeats the arithmetic.
      int checkpoint_interval() const { return std::max(1, scene_.time.steps_per_period / 10); }

      int field_interval() const { return std::max(1, scene_.time.steps_per_period / scene_.output.fields_per_period); }

      void note(const int grid_step)
      {
        recorder_.note(model_, grid_step);
        if (fields_ && grid_step % field_interval() == 0)
          fields_->template write<dim>(instant_of(model_), grid_step / field_interval());
        if (is_writer_ && options_.keeps_flow &&
            is_flow_instant(scene_.time.n_steps(), scene_.time.steps_per_period, grid_step) &&
            !model_.coupling().fluid_values().empty())
          flows_.push_back(flow_in_plane(instant_of(model_)));
      }

      void advance_or_explain()
      {
        try
        {
          model_.advance();
        }
        catch (const ComputationError &error)
        {
          write(std::string("failed: ") + error.what());
          throw;
        }
      }

      Provenance provenance() const
      {
        return {current_program_version,
                options_.command_line,
                scene_.text,
                scene_.hash,
                utc_time_now(),
                wall_before_ + seconds_since(start_)};
      }

      void save()
      {
        const Checkpoint<dim> checkpoint{model_.state(),
                                         recorder_.rows(),
                                         recorder_.shapes(),
                                         recorder_.first_works(),
                                         flows_,
                                         wall_before_ + seconds_since(start_),
                                         cpu_before_ + process_cpu_time_s()};
        if (is_writer_)
          write_checkpoint(checkpoint_file_, checkpoint, provenance());
      }

      void resume()
      {
        Checkpoint<dim> checkpoint = read_checkpoint<dim>(checkpoint_file_, scene_);
        model_.restore(checkpoint.model);
        recorder_.restore(checkpoint.rows, std::move(checkpoint.shapes), std::move(checkpoint.first_works));
        flows_       = std::move(checkpoint.flows);
        grid_step_   = checkpoint.model.grid_step;
        wall_before_ = checkpoint.wall_time_s;
        cpu_before_  = checkpoint.cpu_time_s;
        if (fields_)
          fields_->adopt(grid_step_ / field_interval() + 1, field_interval() * scene_.time.time_step_s());
      }

      RunSummary summary(const std::string &status) const
      {
        RunSummary summary;
        summary.status = status;
        // A steady state has no period, and no way to it.
        const auto balances =
            scene_.time.is_steady
                ? std::vector<WorkBalance>()
                : work_balance_per_period(recorder_.trajectory(), scene_.time.period_s, recorder_.first_works());
        summarize_motion(recorder_.trajectory(), scene_.time.period_s, scene_.head.angle_rad, balances, summary);
        const StepCounts        &counts   = model_.counts();
        const CouplingCounts    &coupling = model_.coupling().counts();
        const LinearSolverCounts linear   = model_.coupling().linear_counts(),
                                 tail     = model_.coupling().tail_linear_counts();
        summary.n_unknowns                = recorder_.trajectory().front().n_unknowns;
        summary.n_steps                   = counts.n_steps;
        summary.n_linear_solves           = linear.n_solves + tail.n_solves;
        summary.n_factorizations          = linear.n_factorizations + tail.n_factorizations;
        summary.n_tail_linear_solves      = tail.n_solves;
        summary.n_tail_factorizations     = tail.n_factorizations;
        if (summary.n_linear_solves > 0)
          summary.linear_iterations_mean = double(linear.n_iterations + tail.n_iterations) / summary.n_linear_solves;
        if (counts.n_steps > 0)
          summary.coupling_iterations_mean = double(coupling.n_iterations) / counts.n_steps;
        summary.n_remeshes         = counts.n_remeshes;
        summary.n_step_halvings    = counts.n_step_halvings;
        summary.wall_time_s        = wall_before_ + seconds_since(start_);
        summary.cpu_time_s         = cpu_before_ + process_cpu_time_s();
        summary.peak_memory_MB     = peak_memory_MB();
        summary.cpu_time_of_part_s = {{"factorization", linear.factorization_cpu_s},
                                      {"krylov_solve", linear.solve_cpu_s},
                                      {"assembly", coupling.iteration_cpu_s - coupling.tail_cpu_s -
                                                       linear.factorization_cpu_s - linear.solve_cpu_s},
                                      {"tail_equilibrium", coupling.tail_cpu_s},
                                      {"mesh_motion", coupling.mesh_motion_cpu_s},
                                      {"remeshing", counts.remeshing_cpu_s}};
        summary.warnings           = warnings(balances);
        summary.inertia            = inertia_record();
        return summary;
      }

      std::optional<InertiaRecord> inertia_record() const
      {
        if (!scene_.fluid)
          return std::nullopt;
        const auto [fluid, tail, head] = inertia_shares(scene_);
        return InertiaRecord{names_of(inertia_terms(scene_)), fluid, tail, head, neglected_share(scene_)};
      }

      /// What a user has to know before trusting the numbers.
      std::vector<std::string> warnings(const std::vector<WorkBalance> &balances) const
      {
        std::vector<std::string> result = sliver_warnings(scene_);
        for (const std::string &warning : {inertia_warning(scene_), symmetry_warning(scene_),
                                           stabilization_warning(balances), open_balance_warning(balances)})
          if (!warning.empty())
            result.push_back(warning);
        return result;
      }

      /// Empty if the mesh resolves the flow.
      static std::string stabilization_warning(const std::vector<WorkBalance> &balances)
      {
        constexpr double noticed = 0.01;
        double           largest = 0.;
        for (const WorkBalance &period : balances)
          if (period.dissipated_J_m > 0.)
            largest = std::max(largest, period.stabilization_J_m / period.dissipated_J_m);
        if (largest < noticed)
          return {};
        return fmt::format(
            "the mesh is too coarse for the flow's Reynolds number: what keeps the flow smooth dissipates "
            "{:.2g} % of what the viscosity does; lower [numerics] mesh_size_m and mesh_size_far_m",
            100. * largest);
      }

      /// Empty if the balance closes as well as can be expected of the steps.
      std::string open_balance_warning(const std::vector<WorkBalance> &balances) const
      {
        const auto   worst = worst_period(balances);
        const double bound = largest_expected_imbalance(scene_.time.steps_per_period, inertia_terms(scene_).any());
        if (!worst || std::abs(*balances[*worst].imbalance()) <= bound)
          return {};
        return fmt::format(
            "the power balance is open by {:.2g} % in period {}, more than the {:.2g} % that steps of this "
            "size explain: motion or field change too fast for the step; raise [time] steps_per_period, or "
            "let the field change more slowly",
            100. * *balances[*worst].imbalance(), *worst + 1, 100. * bound);
      }

      SimulationResult write(const std::string &status)
      {
        SimulationResult result{recorder_.trajectory(), summary(status), {}, flows_};
        if (scene_.tail)
          result.snapshots = recorder_.snapshots(model_.swimmer());
        if (!is_writer_)
          return result;
        if (status == "completed")
        {
          write_together(result);
          std::filesystem::remove(checkpoint_file_);
        }
        else
          write_run_summary_json(options_.folder / "summary.json", {result.summary, provenance()});
        return result;
      }

      /// All results or none take their final names.
      void write_together(const SimulationResult &result) const
      {
        const auto staged = temporary_name(options_.folder / "summary.json.staged");
        std::filesystem::remove_all(staged);
        try
        {
          std::filesystem::create_directory(staged);
          write_trajectory_csv(staged / "trajectory.csv", result.trajectory, dim);
          if (!result.snapshots.time_s.empty())
            write_snapshots(staged / "snapshots.h5", result.snapshots, provenance());
          if (!result.flows.empty())
            write_plane_flows(staged / "flow.h5", result.flows, provenance());
          write_run_summary_json(staged / "summary.json", {result.summary, provenance()});
        }
        catch (...)
        {
          std::filesystem::remove_all(staged);
          throw;
        }
        for (const auto &entry : std::filesystem::directory_iterator(staged))
          std::filesystem::rename(entry.path(), options_.folder / entry.path().filename());
        std::filesystem::remove_all(staged);
      }

      const Scene               &scene_;
      const SimulationOptions   &options_;
      MPI_Comm                   communicator_;
      bool                       is_writer_;
      std::filesystem::path      checkpoint_file_;
      std::optional<FolderLock>  lock_; ///< of the writer, if the verb has none: runs within runs have folders, too
      Clock::time_point          start_       = Clock::now();
      double                     wall_before_ = 0., cpu_before_ = 0.;
      FullOrderModel<dim>        model_;
      RunRecorder<dim>           recorder_;
      std::optional<FieldOutput> fields_;
      std::vector<PlaneFlow>     flows_; ///< of the writer
      int                        grid_step_ = 0;
    };
  } // namespace

  SimulationResult simulate(const Scene &scene, const SimulationOptions &options, const MPI_Comm communicator)
  {
    return scene.dimension == 3 ? Run<3>(scene, options, communicator).finish()
                                : Run<2>(scene, options, communicator).finish();
  }
} // namespace swimtwin
