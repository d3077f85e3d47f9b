#include <rom/training/training.h>

#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <fom/run/run_recorder.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/training/aim.h>
#include <rom/training/basis_builder.h>
#include <rom/training/bent_tail.h>
#include <rom/training/cpu_budget.h>
#include <rom/training/explored_shapes.h>
#include <rom/training/held_out_runs.h>
#include <rom/training/model_assembly.h>
#include <rom/training/pose_dependence.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// Below this relative change of the resistance the pose is left out.
    constexpr double negligible = 1e-3;

    class Training
    {
    public:
      /// With this many coordinates; their samples are kept in this file of the folder.
      Training(const Scene &scene, const TrainingOptions &options, const int n_coordinates, const char *sample_file,
               CpuBudget &budget, const MPI_Comm communicator)
          : scene_(scene), options_(options), n_coordinates_(n_coordinates), sample_file_(options.folder / sample_file),
            budget_(budget), communicator_(communicator), swimmer_(scene, MPI_COMM_SELF),
            tail_(RunRecorder<2>(scene).snapshots(swimmer_)), space_(make_tail_space(tail_))
      {
      }

      void make_model()
      {
        take_snapshots();
        book("full-order runs");
        choose_basis();
        book("shapes of least energy");
        follow_head();
        model_       = assemble_body(swimmer_, tail_, basis_);
        model_.range = options_.range;
        store_       = std::make_unique<SampleStore>(sample_file_, key_of_samples());
        sampler_     = std::make_unique<ShapeSampler>(scene_, basis_, wandering_.usual, *store_, communicator_);
        choose_region(*sampler_);
        sample_resistance(*sampler_);
        hold_out_samples(*sampler_);
        judge();
      }

      /// With the set of monomials that is best, not the smallest that is nearly as good.
      void fit_finely()
      {
        nearly_ = 1.;
        fit(*sampler_, points_);
        judge();
      }

      void add_samples(const int n)
      {
        constexpr int n_rounds = 2;
        for (int round = 0; round < n_rounds; ++round)
          explore_and_fit(n / n_rounds);
        judge();
      }

      const ReducedModel &model() const { return model_; }
      int                 n_coordinates() const { return basis_.n_coordinates(); }
      int                 n_samples() const { return static_cast<int>(samples_.size()); }

    private:
      void take_snapshots()
      {
        const auto         given = read_sets(options_.snapshots); // refused now rather than after the runs
        TrainingRunOptions runs  = run_options("runs", "full-order runs");
        runs.overrides = {"time.periods=2", fmt::format("time.steps_per_period={}", options_.steps_per_period),
                          "output.snapshots_per_period=30", "output.fields_per_period=0"};
        for (const auto &folder : run_full_order(scene_, training_design(options_.range), runs, communicator_))
          sources_.push_back(folder / "snapshots.h5");
        sets_ = read_sets(sources_);
        sources_.insert(sources_.end(), options_.snapshots.begin(), options_.snapshots.end());
        sets_.insert(sets_.end(), given.begin(), given.end());
      }

      std::vector<SnapshotSet> read_sets(const std::vector<std::filesystem::path> &files) const
      {
        std::vector<SnapshotSet> sets;
        for (const auto &file : files)
        {
          sets.push_back(read_snapshots(file));
          space_.require_same_mesh(sets.back(), file.string());
        }
        return sets;
      }

      TrainingRunOptions run_options(const std::string &folder, const std::string &stage) const
      {
        return {options_.folder / folder, options_.command_line, {}, [this, stage](const int done, const int total) {
                  report(stage, done, total);
                }};
      }

      void choose_basis()
      {
        if (options_.basis == BasisChoice::bending)
          choose_bending();
        else
          choose_modes();
        n_snapshots_ = 0;
        for (const auto &set : sets_)
          n_snapshots_ += static_cast<int>(set.tail_displacement_m.rows());
        rest_ = {Eigen::VectorXd::Zero(basis_.n_coordinates()), 0., 0., 0.};
      }

      void choose_modes()
      {
        const TailStiffness stiffness(swimmer_, space_);
        BasisBuilder        builder(space_, stiffness, communicator_);
        if (options_.basis == BasisChoice::pod)
          for (std::size_t k = 0; k < sets_.size(); ++k)
            builder.add(sets_[k], sources_[k].string());
        basis_ = builder.compute(n_coordinates_, options_.n_followers);
      }

      void choose_bending()
      {
        const Eigen::MatrixXd X = space_.displacements(sets_);
        BendingCoordinates    coordinates(swimmer_);
        coordinates.choose_modes(X, n_coordinates_);
        basis_.bent = std::make_shared<const BentTail>(
            fit_bent_tail(swimmer_, space_, coordinates, coordinates.of(X), communicator_,
                          [&](const int done, const int total) { report("shapes of least energy", done, total); }));
        basis_.singular_values = coordinates.singular_values() * coordinates.length_m();
        record_representation(X, space_, basis_);
      }

      void follow_head()
      {
        shapes_seen_ = trajectory_points(sets_, basis_, space_);
        wandering_   = wandering(sets_, swimmer_, shapes_seen_);
        if (scene_.domain->moves_with_swimmer)
          forget_heights();
      }

      void forget_heights()
      {
        wandering_.usual = {0., Eigen::VectorXd::Zero(basis_.n_coordinates())};
        for (auto &point : shapes_seen_)
          point.drift_y_m = 0.;
      }

      std::string key_of_samples() const
      {
        std::string bytes = fmt::format("{} {:.17g}", scene_.hash, wandering_.usual.by_sine_m);
        bytes.append(reinterpret_cast<const char *>(wandering_.usual.by_coordinate.data()),
                     static_cast<std::size_t>(wandering_.usual.by_coordinate.size()) * sizeof(double));
        const Eigen::MatrixXd none;
        for (const auto *numbers :
             {&basis_.coordinates, &basis_.followers, &basis_.quadratic, basis_.bent ? &basis_.bent->modes : &none,
              basis_.bent ? &basis_.bent->amplitudes.coefficients : &none})
          bytes.append(reinterpret_cast<const char *>(numbers->data()),
                       static_cast<std::size_t>(numbers->size()) * sizeof(double));
        return digest(bytes);
      }

      void choose_region(ShapeSampler &sampler)
      {
        region_ = region_around(shapes_seen_, options_.shape_margin);
        if (!scene_.domain->moves_with_swimmer)
        {
          const auto few = spread_out(shapes_seen_, {rest_}, region_, Eigen::VectorXd::Ones(region_.n_variables()), 4);
          pose_          = measure_pose_dependence(few, region_, rest_, wandering_.reach_m, sampler);
        }
        region_.depends_on_angle  = pose_.on_angle > negligible;
        region_.depends_on_height = pose_.on_height > negligible;
        for (auto &point : shapes_seen_)
        {
          point.angle_rad *= region_.depends_on_angle;
          point.drift_y_m *= region_.depends_on_height;
        }
      }

      void sample_resistance(ShapeSampler &sampler)
      {
        const auto axis    = axis_points(region_, rest_);
        const auto at_axis = sampler.sample(axis);
        if (at_axis.size() != axis.size())
          throw ComputationError(
              "the tail touches itself or a wall at the edge of the region of shapes: narrow the range "
              "(a stiffer tail, a weaker field) or lower --modes");
        std::vector<Eigen::MatrixXd> edge;
        for (std::size_t k = 1; k < at_axis.size(); ++k)
          edge.push_back(at_axis[k].resistance);
        effects_ = variable_effects(at_axis.front().resistance, edge);

        // A third along the runs, a third to fill the region; then where the reduced swimmer goes and is least sure.
        const int third = options_.n_samples / 3;
        points_         = axis;
        for (const auto &point : spread_out(shapes_seen_, axis, region_, effects_, third))
          points_.push_back(point);
        for (const auto &point : filling_points(region_, rest_, third))
          points_.push_back(point);
        fit(sampler, points_);
        constexpr int n_rounds = 3;
        for (int round = 0; round < n_rounds; ++round)
          explore_and_fit(third / n_rounds);
      }

      /// n more samples where the reduced swimmer goes and the fit is least sure.
      void explore_and_fit(const int n)
      {
        constexpr int n_members = 40;
        const auto candidates = shapes_of(explore(model_, spread_members(options_.range, n_members, explored_), rest_));
        explored_ += n_members;
        for (const auto &point : fit_->worst_supported(candidates, n))
          points_.push_back(point);
        fit(*sampler_, points_);
      }

      void fit(ShapeSampler &sampler, const std::vector<ShapePoint> &points)
      {
        const int total   = std::max(options_.n_samples, static_cast<int>(points.size()));
        samples_          = sampler.sample(points, [&](const int done, int) {
          report("resistance samples", done, total);
          book("resistance samples");
        });
        fit_              = std::make_unique<ResistanceFit>(samples_, region_, effects_, wandering_.usual, nearly_);
        model_.resistance = fit_->resistance();
        book("fits");
      }

      /// Shapes of the reduced swimmer's own runs that no sample is near to.
      void hold_out_samples(ShapeSampler &sampler)
      {
        constexpr std::size_t      n      = 60;
        const auto                 points = explore(model_, spread_members(options_.range, n, 1000), rest_);
        std::vector<ExploredPoint> chosen;
        for (std::size_t k = 0; k < n; ++k)
          chosen.push_back(points[k * points.size() / n + 1 + k % 7]); // moving, at all phases
        sampler.sample(shapes_of(chosen));                             // all ranks together; from the store below
        for (const auto &point : chosen)
          for (const auto &sample : sampler.sample({point.shape}))
            held_out_samples_.emplace_back(sample, point.velocity);
        book("held-out samples");
      }

      /// What the model is worth.
      void judge()
      {
        model_.record = {};
        record_velocity_errors();
        record();
        compare();
        book("held-out full-order runs");
      }

      void record_velocity_errors()
      {
        auto  &r   = model_.record;
        double sum = 0.;
        for (const auto &[sample, velocity] : held_out_samples_)
        {
          const double error   = fit_->velocity_error_at(sample, velocity);
          r.velocity_error_max = std::max(r.velocity_error_max, error);
          sum += error * error;
        }
        r.n_held_out_samples = static_cast<int>(held_out_samples_.size());
        r.velocity_error_rms = std::sqrt(sum / std::max(1, r.n_held_out_samples));
      }

      void record()
      {
        auto &r                = model_.record;
        r.target               = options_.target;
        r.singular_values_m    = basis_.singular_values.head(std::min<Eigen::Index>(40, basis_.singular_values.size()));
        r.energy_captured      = basis_.energy_captured;
        r.n_snapshots          = n_snapshots_;
        r.n_resistance_samples = static_cast<int>(samples_.size());
        const Eigen::VectorXd d = samples_.front().resistance.diagonal().cwiseSqrt().cwiseInverse();
        for (const auto &sample : samples_)
        {
          const Eigen::VectorXd values = symmetric_eigenvalues(d.asDiagonal() * sample.resistance * d.asDiagonal());
          r.largest_condition          = std::max(r.largest_condition, values.maxCoeff() / values.minCoeff());
        }
        r.neglects.push_back(fmt::format(
            "Inertia of fluid and solid: the unsteady group 2 pi rho f L^2 / mu is up to {:.2g}, an estimated "
            "{:.2g} % of the displacement are missing there with the stiffest tail.",
            unsteady_group(scene_, options_.range.frequency_Hz.high, options_.range.viscosity_Pa_s.low),
            100. * inertia_shares(scene_, options_.range.frequency_Hz.high, options_.range.viscosity_Pa_s.low,
                                  options_.range.young_modulus_Pa.high)
                       .together()));
        r.neglects.push_back(scene_.domain->moves_with_swimmer
                                 ? "Nothing of the pose: the domain moves with the swimmer."
                                 : fmt::format("The place along the domain: over the {:.2g} mm that the body's middle "
                                               "went in two periods, resistance changes by at most {:.2g} %.",
                                               1e3 * wandering_.reach_m[0], 100. * pose_.on_way));
        if (!scene_.domain->moves_with_swimmer && !region_.depends_on_height)
          r.neglects.push_back(
              fmt::format("The height in the domain: over the {:.2g} mm from the usual one, resistance "
                          "changes by at most {:.2g} %.",
                          1e3 * wandering_.reach_m[1], 100. * pose_.on_height));
        if (!scene_.domain->moves_with_swimmer && !region_.depends_on_angle)
          r.neglects.push_back(
              fmt::format("The angle in the domain: resistance changes by at most {:.2g} %.", 100. * pose_.on_angle));
        r.neglects.push_back(fmt::format("Shapes outside the modes: {:.2g} um root mean square of those in the runs.",
                                         1e6 * basis_.projection_error_m));
      }

      void compare()
      {
        model_.record.held_out_runs =
            compare_with_full_order(model_, scene_, spread_members(options_.range, options_.n_held_out, 200),
                                    run_options("held-out", "held-out full-order runs"), communicator_);
      }

      void book(const std::string &purpose) { budget_.book(purpose); }

      void report(const std::string &stage, const int done, const int total) const
      {
        if (options_.on_progress)
          options_.on_progress(stage, done, total);
      }

      const Scene                                              &scene_;
      const TrainingOptions                                    &options_;
      int                                                       n_coordinates_;
      std::filesystem::path                                     sample_file_;
      CpuBudget                                                &budget_;
      MPI_Comm                                                  communicator_;
      Swimmer<2>                                                swimmer_;
      SnapshotSet                                               tail_; ///< its mesh alone
      TailSpace                                                 space_;
      std::vector<std::filesystem::path>                        sources_;
      std::vector<SnapshotSet>                                  sets_;
      int                                                       n_snapshots_ = 0;
      TailBasis                                                 basis_;
      ShapePoint                                                rest_;
      std::vector<ShapePoint>                                   shapes_seen_;
      Wandering                                                 wandering_;
      SampledRegion                                             region_;
      PoseDependence                                            pose_;
      Eigen::VectorXd                                           effects_;
      std::unique_ptr<SampleStore>                              store_;
      std::unique_ptr<ShapeSampler>                             sampler_;
      std::vector<ShapePoint>                                   points_;       ///< where samples are wanted
      int                                                       explored_ = 1; ///< of the range's members, the next
      double                                                    nearly_   = ResistanceFit::usual_nearly;
      std::vector<ResistanceSample>                             samples_;
      std::unique_ptr<ResistanceFit>                            fit_;
      std::vector<std::pair<ResistanceSample, Eigen::VectorXd>> held_out_samples_; ///< and velocities
      ReducedModel                                              model_;
    };

    /// Makes models until one meets the target, or there is nothing left to spend or to try.
    class AimedTraining
    {
    public:
      AimedTraining(const Scene &scene, const TrainingOptions &options, const MPI_Comm communicator)
          : scene_(scene), options_(options), communicator_(communicator), budget_(options.budget_s, communicator)
      {
      }

      ReducedModel run()
      {
        current_ =
            std::make_unique<Training>(scene_, options_, options_.n_coordinates, "samples.h5", budget_, communicator_);
        current_->make_model();
        take_stock({});
        while (misses())
        {
          const auto        remedy = next_remedy(attempts_);
          const std::string reason =
              remedy ? reason_against(*remedy) : "neither more samples nor another mode lowered the error by a tenth";
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
        return 2. * budget_.spent_on_s("shapes of least energy") + budget_.spent_on_s("fits") +
               1.2 * a_sample * options_.n_samples;
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
        else
          add_mode();
        take_stock(remedy);
      }

      /// The models before stay what is refined if the new one is not better.
      void add_mode()
      {
        const int n     = current_->n_coordinates() + 1;
        before_         = std::move(current_);
        const auto file = fmt::format("samples-{}-modes.h5", n);
        current_        = std::make_unique<Training>(scene_, options_, n, file.c_str(), budget_, communicator_);
        current_->make_model();
      }

      void take_stock(const std::optional<Remedy> remedy)
      {
        const TrainingRecord &record = current_->model().record;
        const HeldOutError    error  = displacement_error(record);
        attempts_.push_back({remedy, size_of(error), fit_share(record)});
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
        else if (remedy == Remedy::another_mode)
          current_ = std::move(before_);
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
                                                : "another mode";
      }

      ReducedModel concluded(const std::string &end)
      {
        auto &record      = best_.record;
        record.cpu_time_s = budget_.spent_s();
        record.history    = history_;
        record.history.push_back(fmt::format("CPU time: {}.", budget_.text()));
        if (!end.empty())
          record.history.push_back(fmt::format("It ended because {}; {}.", end, cause_of(record)));
        return best_;
      }

      static constexpr int      fewest_more_samples = 100;
      const Scene              &scene_;
      const TrainingOptions    &options_;
      MPI_Comm                  communicator_;
      CpuBudget                 budget_;
      std::unique_ptr<Training> current_, before_;
      ReducedModel              best_;
      double                    best_error_ = 0.;
      std::vector<Attempt>      attempts_;
      std::vector<std::string>  history_;
    };
  } // namespace

  ReducedModel train(const Scene &scene, const TrainingOptions &options, const MPI_Comm communicator)
  {
    const auto   start = std::chrono::steady_clock::now();
    ReducedModel model = AimedTraining(scene, options, communicator).run();
    int          rank;
    MPI_Comm_rank(communicator, &rank);
    if (rank == 0)
      write_reduced_model(options.folder / "model.h5", model,
                          {current_program_version, options.command_line, scene.text, scene.hash, utc_time_now(),
                           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    return model;
  }
} // namespace swimtwin
