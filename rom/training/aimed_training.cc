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
          : scene_(scene), options_(options), communicator_(communicator), budget_(options.budget_s, communicator),
            added_runs_(options.added_runs)
      {
      }

      ReducedModel run()
      {
        make_model(options_.n_coordinates);
        take_stock({});
        while (misses())
        {
          const auto remedy = next_remedy(attempts_, [this](const Remedy r) { return reason_against(r).empty(); });
          if (!remedy)
            return concluded(reason_to_end());
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

      std::string reason_to_end() const
      {
        for (const Remedy remedy : {Remedy::another_mode, Remedy::more_samples, Remedy::more_runs})
          if (const auto reason = reason_against(remedy); !reason.empty())
            return reason;
        return "neither more samples, another mode nor more runs lowered the error by a tenth";
      }

      /// Empty if there is none.
      std::string reason_against(const Remedy remedy) const
      {
        constexpr int most_modes = 8;
        if (remedy == Remedy::another_mode && current_->n_coordinates() >= most_modes)
          return fmt::format("a model of more than {} modes would be slow and hard to fit", most_modes);
        if (remedy == Remedy::more_runs && next_runs().empty())
          return "no other run of the range is near the worst ones";
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

      void make_model(const int n_coordinates)
      {
        const bool        as_asked = n_coordinates == options_.n_coordinates;
        const std::string name     = as_asked ? "samples" : fmt::format("samples-{}-modes", n_coordinates);
        SampleFiles       files    = {name + ".h5", name + ".h5"};
        const auto        n_runs   = training_design(options_.range).size() + added_runs_.size();
        if (!added_runs_.empty())
          files.with_given = fmt::format("{}-{}-runs.h5", name, n_runs);
        current_ = std::make_unique<Training<dim>>(scene_, options_, n_coordinates, files, budget_, communicator_);
        current_->make_model();
      }

      /// The models before stay what is refined if the new one is not better.
      void add_mode()
      {
        before_ = std::move(current_);
        make_model(before_->n_coordinates() + 1);
      }

      /// Their shapes join those that modes and region are chosen from. Where these do for them as they are, samples
      /// are added along them alone. The model gets as many samples and as fine a fit as the one before, which it is
      /// compared with.
      void add_runs()
      {
        options_before_ = options_;
        for (const auto &folder : runs_near_worst())
          options_.snapshots.push_back(folder / "snapshots.h5");
        before_ = std::move(current_);
        make_model(before_->n_coordinates());
        if (const int missing = before_->n_samples() - current_->n_samples(); missing > fewest_more_samples / 10)
          current_->add_samples(missing);
        if (before_->is_fine())
          current_->fit_finely();
      }

      std::vector<AddedRun> next_runs() const
      {
        return runs_near_the_worst(current_->model().record, options_.range, runs_at_once, added_runs_);
      }

      std::vector<std::filesystem::path> runs_near_worst()
      {
        TrainingRunOptions         runs{options_.folder / "runs", options_.command_line,
                                training_run_overrides(options_.steps_per_period), progress("full-order runs")};
        std::vector<RunParameters> members;
        for (const auto &run : next_runs())
        {
          members.push_back(run.parameters);
          runs.numbers.push_back(run.number);
          added_runs_.push_back(run.number);
          options_.added_runs.push_back(run.number);
        }
        const auto folders = run_full_order(scene_, members, runs, communicator_);
        budget_.book("full-order runs");
        return folders;
      }

      /// Whether a held-out run that is further off than the target goes where no shape was.
      bool leaves_shapes() const
      {
        const ReducedModel &model = current_->model();
        return std::any_of(model.record.held_out_runs.begin(), model.record.held_out_runs.end(),
                           [&](const HeldOutRun &run) {
                             return std::abs(relative_error(run, model.record)) > options_.target &&
                                    !predict(model, scene_, parameters_of(run)).trust.outside_region.empty();
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
          best_                   = current_->model();
          best_shares_            = current_->known_shares();
          best_.record.added_runs = options_.added_runs;
          best_error_             = attempts_.back().error;
        }
        else if (remedy == Remedy::another_mode || remedy == Remedy::more_runs)
        {
          current_ = std::move(before_);
          if (remedy == Remedy::more_runs)
            options_ = options_before_;
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
          record.history.push_back(fmt::format("It ended because {}; {}.", end, cause_of(record, best_shares_)));
        return best_;
      }

      static constexpr int           fewest_more_samples = 100, runs_at_once = 2;
      const Scene                   &scene_;
      TrainingOptions                options_, options_before_; ///< with the shapes of runs that were added
      MPI_Comm                       communicator_;
      CpuBudget                      budget_;
      std::unique_ptr<Training<dim>> current_, before_;
      ReducedModel                   best_;
      KnownShares                    best_shares_;
      double                         best_error_ = 0.;
      std::vector<Attempt>           attempts_;
      std::vector<std::string>       history_;
      std::vector<int>               added_runs_; ///< their numbers, of those that were taken back, too
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
