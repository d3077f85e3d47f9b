#include <rom/training/training.h>

#include <datasets/system/clocks.h>
#include <datasets/scene/dimensionless_groups.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <fom/run/run_recorder.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/training/basis_builder.h>
#include <rom/training/bent_tail.h>
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
      Training(const Scene &scene, const TrainingOptions &options, const MPI_Comm communicator)
          : scene_(scene), options_(options), communicator_(communicator), swimmer_(scene, MPI_COMM_SELF),
            tail_(RunRecorder<2>(scene).snapshots(swimmer_)), space_(make_tail_space(tail_))
      {
      }

      ReducedModel run()
      {
        take_snapshots();
        choose_basis();
        follow_head();
        model_       = assemble_body(swimmer_, tail_, basis_);
        model_.range = options_.range;
        SampleStore  store(options_.folder / "samples.h5", key_of_samples());
        ShapeSampler sampler(scene_, basis_, wandering_.usual, store, communicator_);
        choose_region(sampler);
        sample_resistance(sampler);
        hold_out_samples(sampler);
        record();
        compare();
        return model_;
      }

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
        basis_ = builder.compute(options_.n_coordinates, options_.n_followers);
      }

      void choose_bending()
      {
        const Eigen::MatrixXd X = space_.displacements(sets_);
        BendingCoordinates    coordinates(swimmer_);
        coordinates.choose_modes(X, options_.n_coordinates);
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
        const int               third  = options_.n_samples / 3;
        std::vector<ShapePoint> points = axis;
        for (const auto &point : spread_out(shapes_seen_, axis, region_, effects_, third))
          points.push_back(point);
        for (const auto &point : filling_points(region_, rest_, third))
          points.push_back(point);
        fit(sampler, points);
        constexpr int n_rounds = 3;
        for (int round = 0; round < n_rounds; ++round)
        {
          const auto candidates = shapes_of(explore(model_, spread_members(options_.range, 40, 1 + 40 * round), rest_));
          for (const auto &point : fit_->worst_supported(candidates, third / n_rounds))
            points.push_back(point);
          fit(sampler, points);
        }
      }

      void fit(ShapeSampler &sampler, const std::vector<ShapePoint> &points)
      {
        samples_          = sampler.sample(points,
                                           [&](const int done, int) { report("resistance samples", done, options_.n_samples); });
        fit_              = std::make_unique<ResistanceFit>(samples_, region_, effects_, wandering_.usual);
        model_.resistance = fit_->resistance();
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
        double sum = 0.;
        auto  &r   = model_.record;
        for (const auto &point : chosen)
          for (const auto &sample : sampler.sample({point.shape}))
          {
            const double error   = fit_->velocity_error_at(sample, point.velocity);
            r.velocity_error_max = std::max(r.velocity_error_max, error);
            sum += error * error;
            ++r.n_held_out_samples;
          }
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
        double cpu_s = process_cpu_time_s();
        MPI_Allreduce(MPI_IN_PLACE, &cpu_s, 1, MPI_DOUBLE, MPI_SUM, communicator_);
        model_.record.cpu_time_s = cpu_s;
      }

      void report(const std::string &stage, const int done, const int total) const
      {
        if (options_.on_progress)
          options_.on_progress(stage, done, total);
      }

      const Scene                       &scene_;
      const TrainingOptions             &options_;
      MPI_Comm                           communicator_;
      Swimmer<2>                         swimmer_;
      SnapshotSet                        tail_; ///< its mesh alone
      TailSpace                          space_;
      std::vector<std::filesystem::path> sources_;
      std::vector<SnapshotSet>           sets_;
      int                                n_snapshots_ = 0;
      TailBasis                          basis_;
      ShapePoint                         rest_;
      std::vector<ShapePoint>            shapes_seen_;
      Wandering                          wandering_;
      SampledRegion                      region_;
      PoseDependence                     pose_;
      Eigen::VectorXd                    effects_;
      std::vector<ResistanceSample>      samples_;
      std::unique_ptr<ResistanceFit>     fit_;
      ReducedModel                       model_;
    };
  } // namespace

  ReducedModel train(const Scene &scene, const TrainingOptions &options, const MPI_Comm communicator)
  {
    const auto   start = std::chrono::steady_clock::now();
    ReducedModel model = Training(scene, options, communicator).run();
    int          rank;
    MPI_Comm_rank(communicator, &rank);
    if (rank == 0)
      write_reduced_model(options.folder / "model.h5", model,
                          {current_program_version, options.command_line, scene.text, scene.hash, utc_time_now(),
                           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    return model;
  }
} // namespace swimtwin
