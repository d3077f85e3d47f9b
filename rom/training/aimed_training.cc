#include <rom/training/aimed_training.h>

#include <datasets/reduced/held_out_error.h>
#include <datasets/system/provenance.h>
#include <rom/swimmer/carried_inertia.h>
#include <rom/training/added_runs.h>
#include <rom/training/aim.h>
#include <rom/training/cpu_budget.h>
#include <rom/training/explored_shapes.h>
#include <rom/training/held_out_runs.h>
#include <rom/training/inertia_training.h>
#include <rom/training/training.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace swimtwin
{
  namespace
  {
    /// Makes models until one meets the target, or there is nothing left to spend or to try.
    template <int dim>
    class AimedTraining
    {
    public:
      AimedTraining(const Scene &scene, const TrainingOptions &options, const MPI_Comm communicator)
          : scene_(scene), options_(options), communicator_(communicator), budget_(options.budget_s, communicator)
      {
      }

      ReducedModel run()
      {
        current_ = std::make_unique<Training<dim>>(scene_, options_, options_.n_coordinates, "samples.h5", budget_,
                                                   communicator_);
        current_->make_model();
        take_stock({});
        while (misses())
        {
          const auto        remedy = next_remedy(attempts_);
          const std::string reason =
              remedy ? reason_against(*remedy)
                     : "neither more samples, another mode nor more runs lowered the error by a tenth";
          if (!reason.empty())
            return concluded(reason);
          apply(*remedy);
        }
        return concluded("");
      }

    private:
      bool misses() const { return !missed_target(best_.record).empty(); }

      /// What a remedy costs, as far as the stages before tell.
      double expected_cost_s(const Remedy remedy) const
      {
        const double a_sample = budget_.spent_on_s("resistance samples") / std::max(1, current_->n_samples());
        if (remedy == Remedy::finer_fit)
          return budget_.spent_on_s("fits");
        if (remedy == Remedy::more_samples)
          return a_sample * fewest_more_samples;
        const double anew = 2. * budget_.spent_on_s("shapes of least energy") + budget_.spent_on_s("fits") +
                            1.2 * a_sample * options_.n_samples;
        return remedy == Remedy::another_mode ? anew : anew + .3 * budget_.spent_on_s("full-order runs");
      }

      /// Empty if there is none.
      std::string reason_against(const Remedy remedy) const
      {
        constexpr int most_modes = 8;
        if (remedy == Remedy::another_mode && current_->n_coordinates() >= most_modes)
          return fmt::format("a model of more than {} modes would be slow and hard to fit", most_modes);
        if (expected_cost_s(remedy) > budget_.left_s())
          return fmt::format("what is left of the --budget of {:.0f} s of CPU time does not suffice for {}",
                             budget_.limit_s(), text_of(remedy));
        return "";
      }

      /// Half as many again, or what can be afforded.
      int n_more_samples() const
      {
        const double a_sample = expected_cost_s(Remedy::more_samples) / fewest_more_samples;
        const double most     = a_sample > 0. ? budget_.left_s() / a_sample : 1e9;
        return static_cast<int>(std::min(most, .5 * current_->n_samples()));
      }

      void apply(const Remedy remedy)
      {
        if (remedy == Remedy::finer_fit)
          current_->fit_finely();
        else if (remedy == Remedy::more_samples)
          current_->add_samples(n_more_samples());
        else if (remedy == Remedy::another_mode)
          add_mode();
        else
          add_runs();
        take_stock(remedy);
      }

      /// The models before stay what is refined if the new one is not better.
      void add_mode()
      {
        const int n     = current_->n_coordinates() + 1;
        before_         = std::move(current_);
        const auto file = fmt::format("samples-{}-modes.h5", n);
        current_        = std::make_unique<Training<dim>>(scene_, options_, n, file, budget_, communicator_);
        current_->make_model();
      }

      /// Their shapes join those that modes and region are chosen from. Where these do for them as they are, samples
      /// are added along them alone: what is there already is used, in either case.
      void add_runs()
      {
        snapshots_before_ = options_.snapshots;
        for (const auto &folder : runs_near_worst())
          options_.snapshots.push_back(folder / "snapshots.h5");
        before_ = std::move(current_);
        const auto file =
            fmt::format("samples-{}-runs.h5", training_design(options_.range).size() + added_runs_.size());
        bring_samples(before_->sample_file(), options_.folder / file);
        current_ =
            std::make_unique<Training<dim>>(scene_, options_, before_->n_coordinates(), file, budget_, communicator_);
        current_->make_model();
      }

      std::vector<std::filesystem::path> runs_near_worst()
      {
        TrainingRunOptions         runs{options_.folder / "runs", options_.command_line,
                                training_run_overrides(options_.steps_per_period), progress("full-order runs")};
        std::vector<RunParameters> members;
        for (const auto &run : runs_near_the_worst(current_->model().record, options_.range, runs_at_once, added_runs_))
        {
          members.push_back(run.parameters);
          runs.numbers.push_back(run.number);
          added_runs_.push_back(run.number);
        }
        const auto folders = run_full_order(scene_, members, runs, communicator_);
        budget_.book("full-order runs");
        return folders;
      }

      void bring_samples(const std::filesystem::path &from, const std::filesystem::path &to) const
      {
        int rank;
        MPI_Comm_rank(communicator_, &rank);
        if (rank == 0 && !std::filesystem::exists(to))
          std::filesystem::copy_file(from, to);
        MPI_Barrier(communicator_);
      }

      /// Whether a held-out run that is further off than the target goes where no shape was.
      bool leaves_shapes() const
      {
        const ReducedModel &model = current_->model();
        return std::any_of(model.record.held_out_runs.begin(), model.record.held_out_runs.end(),
                           [&](const HeldOutRun &run) {
                             const RunParameters p{run.young_modulus_Pa, run.viscosity_Pa_s, run.magnetization_A_m,
                                                   run.frequency_Hz,     run.bx_T,           run.by_T};
                             return std::abs(relative_error(run, model.record)) > options_.target &&
                                    !predict(model, scene_, p).trust.outside_region.empty();
                           });
      }

      void take_stock(const std::optional<Remedy> remedy)
      {
        const TrainingRecord &record = current_->model().record;
        const HeldOutError    error  = displacement_error(record);
        attempts_.push_back({remedy, size_of(error), fit_share(record), leaves_shapes()});
        history_.push_back(fmt::format("{}{} modes, {} samples, {} monomials: {}; {:.0f} s of CPU time so far.",
                                       remedy ? text_of(*remedy) + ": " : "", current_->n_coordinates(),
                                       current_->n_samples(), current_->model().resistance.exponents.rows(),
                                       error.is_known() ? "off by " + error.text() : "no held-out runs",
                                       budget_.spent_s()));
        report_stage(history_.back());
        if (attempts_.size() == 1 || attempts_.back().error < best_error_)
        {
          best_       = current_->model();
          best_error_ = attempts_.back().error;
        }
        else if (remedy == Remedy::another_mode || remedy == Remedy::more_runs)
        {
          current_ = std::move(before_);
          if (remedy == Remedy::more_runs)
            options_.snapshots = snapshots_before_;
        }
        else if (remedy == Remedy::finer_fit)
          current_->give_up_fine_fits();
      }

      void report_stage(const std::string &sentence) const
      {
        if (options_.on_progress)
          options_.on_progress(sentence, 1, 1);
      }

      static std::string text_of(const Remedy remedy)
      {
        return remedy == Remedy::finer_fit      ? "more monomials"
               : remedy == Remedy::more_samples ? "more samples"
               : remedy == Remedy::another_mode ? "another mode"
                                                : "more runs near the worst";
      }

      std::function<void(int, int)> progress(const std::string &stage) const
      {
        return [this, stage](const int done, const int total) {
          if (options_.on_progress)
            options_.on_progress(stage, done, total);
        };
      }

      /// If the scene asks for it; it must not be worse than what would be said of leaving it out.
      void carry_inertia()
      {
        add_inertia(best_, scene_, communicator_, progress("inertia samples"));
        if (best_.inertia.is_given() && options_.n_held_out > 0)
          if (largest_error_with_inertia() > largest_borne_error)
            best_.inertia = {};
        budget_.book("inertia");
        auto &neglects = best_.record.neglects;
        neglects.insert(neglects.begin(), neglected_inertia(best_, scene_));
      }

      /// In the slowest and the fastest of the held-out runs; of the latter, where verbs would give its result.
      double largest_error_with_inertia()
      {
        auto       members = spread_members(options_.range, options_.n_held_out, 200);
        const auto slower  = [](const RunParameters &a, const RunParameters &b) {
          return a.frequency_Hz < b.frequency_Hz;
        };
        std::sort(members.begin(), members.end(), slower);
        const auto is_refused = [this](const RunParameters &p) {
          return InertialExtreme{p.frequency_Hz, p.viscosity_Pa_s, p.young_modulus_Pa}.error_if_carried(scene_) >
                 largest_inertial_error;
        };
        while (members.size() > 1 && is_refused(members.back()))
          members.pop_back();
        members          = {members.front(), members.back()};
        const auto stage = progress("held-out runs with inertia");
        const auto runs  = compare_with_inertia(
             best_, scene_, members, {options_.folder / "held-out-with-inertia", options_.command_line, {}, stage},
             communicator_);
        const auto error = [this](const HeldOutRun &run) { return relative_error(run, best_.record); };
        history_.push_back(fmt::format("With inertia: off by {:.2g} % at {:.3g} Hz and by {:.2g} % at {:.3g} Hz.",
                                       100. * error(runs[0]), runs[0].frequency_Hz, 100. * error(runs[1]),
                                       runs[1].frequency_Hz));
        return std::max(std::abs(error(runs[0])), std::abs(error(runs[1])));
      }

      ReducedModel concluded(const std::string &end)
      {
        carry_inertia();
        auto &record      = best_.record;
        record.cpu_time_s = budget_.spent_s();
        record.history    = history_;
        record.history.push_back(fmt::format("CPU time: {}.", budget_.text()));
        if (!end.empty())
          record.history.push_back(
              fmt::format("It ended because {}; {}.", end, cause_of(record, current_->known_shares())));
        return best_;
      }

      static constexpr int               fewest_more_samples = 100, runs_at_once = 2;
      const Scene                       &scene_;
      TrainingOptions                    options_; ///< with the shapes of runs that were added
      MPI_Comm                           communicator_;
      CpuBudget                          budget_;
      std::unique_ptr<Training<dim>>     current_, before_;
      ReducedModel                       best_;
      double                             best_error_ = 0.;
      std::vector<Attempt>               attempts_;
      std::vector<std::string>           history_;
      std::vector<int>                   added_runs_; ///< their numbers, of those that were taken back, too
      std::vector<std::filesystem::path> snapshots_before_;
    };
  } // namespace

  ReducedModel train(const Scene &scene, const TrainingOptions &options, const MPI_Comm communicator)
  {
    const auto   start = std::chrono::steady_clock::now();
    ReducedModel model = scene.dimension == 3 ? AimedTraining<3>(scene, options, communicator).run()
                                              : AimedTraining<2>(scene, options, communicator).run();
    int          rank;
    MPI_Comm_rank(communicator, &rank);
    if (rank == 0)
      write_reduced_model(options.folder / "model.h5", model,
                          {current_program_version, options.command_line, scene.text, scene.hash, utc_time_now(),
                           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    return model;
  }
} // namespace swimtwin
