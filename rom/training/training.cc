#include <rom/training/training.h>

#include <datasets/scene/mirror_plane.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <fom/run/run_recorder.h>
#include <rom/swimmer/dense_algebra.h>
#include <rom/training/basis_builder.h>
#include <rom/training/bent_tail.h>
#include <rom/training/explored_shapes.h>
#include <rom/training/held_out_runs.h>
#include <rom/training/model_assembly.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// A part of the pose that changes displacements by less than this share is left out.
    constexpr double negligible = 2e-3;

    ShapePoint times(const double factor, ShapePoint point)
    {
      point.q *= factor;
      point.angle_rad *= factor;
      point.drift_y_m *= factor;
      return point;
    }
  } // namespace

  template <int dim>
  Training<dim>::Training(const Scene &scene, const TrainingOptions &options, const int n_coordinates,
                          const SampleFiles &files, CpuBudget &budget, const MPI_Comm communicator)
      : scene_(scene), options_(options), n_coordinates_(n_coordinates), files_(files), budget_(budget),
        communicator_(communicator), swimmer_(scene, MPI_COMM_SELF), tail_(RunRecorder<dim>(scene).snapshots(swimmer_)),
        space_(make_tail_space<dim>(tail_, swimmer_.tail().mesh))
  {
  }

  template <int dim>
  void Training<dim>::make_model()
  {
    take_snapshots();
    book("full-order runs");
    choose_shapes();
    if (!given_.empty() && !do_for_given())
    {
      const std::size_t n_own = shapes_seen_.size();
      sources_.insert(sources_.end(), options_.snapshots.begin(), options_.snapshots.end());
      sets_.insert(sets_.end(), given_.begin(), given_.end());
      given_.clear();
      files_.of_runs = files_.with_given;
      choose_shapes();
      used_.assign(shapes_seen_.begin() + static_cast<std::ptrdiff_t>(n_own), shapes_seen_.end());
    }
    sample_resistance(*sampler_);
    favour_use();
    hold_out_samples(*sampler_);
    judge();
  }

  /// Modes and region, from the shapes of sets_.
  template <int dim>
  void Training<dim>::choose_shapes()
  {
    choose_basis();
    book("shapes of least energy");
    follow_head();
    model_       = assemble_body(swimmer_, tail_, basis_);
    model_.range = options_.range;
    store_       = std::make_unique<SampleStore>(options_.folder / files_.of_runs, key_of_samples());
    resistance_  = std::make_unique<ShapeResistance<dim>>(swimmer_, basis_, wandering_.usual);
    sampler_     = std::make_unique<ShapeSampler>([this](const ShapePoint &point) { return resistance_->at(point); },
                                              basis_.n_coordinates(), *store_, communicator_);
    choose_region(*sampler_);
  }

  template <int dim>
  void Training<dim>::fit_finely()
  {
    is_fine_ = true;
    fit(*sampler_, points_, economy(true));
    favour_use();
    judge();
  }

  template <int dim>
  void Training<dim>::add_samples(const int n)
  {
    constexpr int n_rounds = 2;
    for (int round = 0; round < n_rounds; ++round)
      explore_and_fit(n / n_rounds, round + 1 == n_rounds);
    favour_use();
    judge();
  }

  template <int dim>
  void Training<dim>::take_snapshots()
  {
    const auto         given = read_sets(options_.snapshots); // refused now rather than after the runs
    TrainingRunOptions runs  = run_options("runs", "full-order runs");
    runs.overrides           = training_run_overrides(options_.steps_per_period);
    for (const auto &folder : run_full_order(scene_, training_design(options_.range), runs, communicator_))
      sources_.push_back(folder / "snapshots.h5");
    sets_  = read_sets(sources_);
    given_ = std::move(given);
  }

  /// Whether modes and region of the runs' shapes do for those given too, the model's use: then samples of a training
  /// that saw the runs alone are samples of this one.
  template <int dim>
  bool Training<dim>::do_for_given()
  {
    constexpr double worse = 2.; // what modes leave of shapes that they were not made from
    if (!basis_.bent || left_by(basis_, space_.displacements(given_), space_) > worse * basis_.projection_error_m)
      return false;
    used_                = trajectory_points(given_, basis_, space_);
    const UsualPlace own = wandering(given_, swimmer_, used_).usual;
    for (auto &point : used_)
    {
      point.drift_y_m += own.height_m(point) - wandering_.usual.height_m(point);
      keep_variables(point);
      if (region_.variables(point).cwiseAbs().maxCoeff() > 1. ||
          point.q.cwiseQuotient(region_.coordinate_scale_m).norm() > 1.)
        return false;
    }
    return true;
  }

  /// Sets what the resistance does not depend on to zero.
  template <int dim>
  void Training<dim>::keep_variables(ShapePoint &point) const
  {
    point.angle_rad *= region_.depends_on_angle;
    point.drift_y_m *= region_.depends_on_height;
  }

  template <int dim>
  std::vector<SnapshotSet> Training<dim>::read_sets(const std::vector<std::filesystem::path> &files) const
  {
    std::vector<SnapshotSet> sets;
    for (const auto &file : files)
    {
      sets.push_back(read_snapshots(file));
      space_.require_same_mesh(sets.back(), file.string());
    }
    return sets;
  }

  template <int dim>
  TrainingRunOptions Training<dim>::run_options(const std::string &folder, const std::string &stage) const
  {
    return {options_.folder / folder, options_.command_line, {}, [this, stage](const int done, const int total) {
              report(stage, done, total);
            }};
  }

  template <int dim>
  void Training<dim>::choose_basis()
  {
    if (options_.basis == BasisChoice::bending)
      choose_bending();
    else
      choose_modes();
    rest_        = {Eigen::VectorXd::Zero(basis_.n_coordinates()), 0., 0., 0.};
    n_snapshots_ = 0;
    for (const auto *sets : {&sets_, &given_})
      for (const auto &set : *sets)
        n_snapshots_ += static_cast<int>(set.tail_displacement_m.rows());
  }

  template <int dim>
  void Training<dim>::choose_modes()
  {
    if constexpr (dim == 2)
    {
      const TailStiffness stiffness(swimmer_, space_);
      BasisBuilder        builder(space_, stiffness, communicator_);
      if (options_.basis == BasisChoice::pod)
        for (std::size_t k = 0; k < sets_.size(); ++k)
          builder.add(sets_[k], sources_[k].string());
      basis_ = builder.compute(n_coordinates_, options_.n_followers);
    }
    else
      throw InputError("the modes of a swimmer in space are bending angles: leave --basis out");
  }

  template <int dim>
  void Training<dim>::choose_bending()
  {
    const Eigen::MatrixXd X = space_.displacements(sets_);
    BendingCoordinates    coordinates(swimmer_);
    coordinates.choose_modes(X, n_coordinates_);
    basis_.bent = std::make_shared<const BentTail>(
        fit_bent_tail(swimmer_, space_, coordinates, coordinates.of(X), X, communicator_,
                      [&](const int done, const int total) { report("shapes of least energy", done, total); }));
    basis_.singular_values = coordinates.singular_values() * coordinates.length_m();
    record_representation(X, space_, basis_);
  }

  template <int dim>
  void Training<dim>::follow_head()
  {
    shapes_seen_ = trajectory_points(sets_, basis_, space_);
    wandering_   = wandering(sets_, swimmer_, shapes_seen_);
    if (scene_.domain->moves_with_swimmer)
      forget_heights();
  }

  template <int dim>
  void Training<dim>::forget_heights()
  {
    wandering_.usual = {0., Eigen::VectorXd::Zero(basis_.n_coordinates())};
    for (auto &point : shapes_seen_)
      point.drift_y_m = 0.;
  }

  template <int dim>
  std::string Training<dim>::key_of_samples() const
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

  /// Of a relative change of the resistance that comes and goes with the head.
  template <int dim>
  double Training<dim>::share_of_displacement(const double change) const
  {
    return change * std::max(1., wandering_.to_and_fro);
  }

  template <int dim>
  KnownShares Training<dim>::known_shares() const
  {
    return {share_of_displacement(pose_.on_way), share_of_displacement(model_.record.velocity_error_rms)};
  }

  template <int dim>
  void Training<dim>::choose_region(ShapeSampler &sampler)
  {
    region_            = region_around(shapes_seen_, options_.shape_margin);
    region_.has_mirror = domain_is_mirrored(scene_);
    if (!scene_.domain->moves_with_swimmer)
    {
      const auto few = spread_out(shapes_seen_, {rest_}, region_, Eigen::VectorXd::Ones(region_.n_variables()), 4);
      pose_          = measure_pose_dependence(few, region_, rest_, wandering_.reach_m, sampler);
    }
    region_.depends_on_angle  = share_of_displacement(pose_.on_angle) > negligible;
    region_.depends_on_height = share_of_displacement(pose_.on_height) > negligible;
    for (auto &point : shapes_seen_)
      keep_variables(point);
  }

  template <int dim>
  void Training<dim>::sample_resistance(ShapeSampler &sampler)
  {
    const std::vector<ShapePoint> axis = sample_edge(sampler);

    // A third along the runs, a third to fill the region; then where the reduced swimmer goes and is least sure.
    const int third = options_.n_samples / 3;
    points_         = axis;
    for (const auto &point : spread_out(shapes_seen_, axis, region_, effects_, third))
      points_.push_back(point);
    for (const auto &point : filling_points(region_, rest_, third))
      points_.push_back(point);
    fit(sampler, points_, economy(false));
    constexpr int n_rounds = 3;
    for (int round = 0; round < n_rounds; ++round)
      explore_and_fit(third / n_rounds, round + 1 == n_rounds);
  }

  /// Motions that the model is for count for more than the rest of the region.
  template <int dim>
  void Training<dim>::favour_use()
  {
    constexpr int n_along = 60;
    if (used_.empty())
      return;
    fit_->favour(sampler_->sample(spread_out(used_, {rest_}, region_, effects_, n_along)));
    model_.resistance = fit_->resistance();
    book("resistance samples");
  }

  /// Rest, and the region's edge in every variable: one end, whose mirror image the other is, else those of both ends
  /// that can be. Where the tail would touch itself or a wall there, a place nearer to rest that can be stands for it.
  /// Says what the variables change at the edge.
  template <int dim>
  std::vector<ShapePoint> Training<dim>::sample_edge(ShapeSampler &sampler)
  {
    const std::vector<ShapePoint> edge = axis_points(region_, rest_);
    std::vector<ShapePoint>       points{rest_};
    effects_           = Eigen::VectorXd::Zero(region_.n_variables());
    const auto add_end = [&](const Eigen::Index variable, const ShapePoint &end) {
      for (const double share : {1., .8, .6})
      {
        const ShapePoint place   = times(share, end);
        const auto       samples = sampler.sample({rest_, place});
        if (samples.size() < 2)
          continue;
        const double effect =
            variable_effects(samples[0].resistance, {samples[1].resistance}, region_.has_mirror).maxCoeff();
        effects_(variable) = std::max(effects_(variable), effect / share);
        points.push_back(place);
        return;
      }
    };
    for (Eigen::Index k = 0; k < effects_.size(); ++k)
    {
      const ShapePoint &end = edge[static_cast<std::size_t>(k) + 1];
      add_end(k, end);
      if (!region_.has_mirror)
        add_end(k, times(-1., end));
      if (effects_(k) == 0.)
        throw ComputationError("the tail touches itself or a wall at the edge of the region of shapes: narrow the "
                               "range (a stiffer tail, a weaker field) or lower --modes");
    }
    return points;
  }

  /// n more samples where the reduced swimmer goes and the fit is least sure.
  template <int dim>
  void Training<dim>::explore_and_fit(const int n, const bool is_last)
  {
    constexpr int n_members = 40;
    const auto    candidates =
        shapes_of(explore(model_, scene_, spread_members(options_.range, n_members, explored_), rest_));
    explored_ += n_members;
    for (const auto &point : fit_->worst_supported(candidates, n))
      points_.push_back(point);
    fit(*sampler_, points_, economy(is_last));
  }

  template <int dim>
  void Training<dim>::fit(ShapeSampler &sampler, const std::vector<ShapePoint> &points, const FitEconomy &economy)
  {
    const int total   = std::max(options_.n_samples, static_cast<int>(points.size()));
    samples_          = sampler.sample(points, [&](const int done, int) {
      report("resistance samples", done, total);
      book("resistance samples");
    });
    fit_              = std::make_unique<ResistanceFit>(samples_, region_, effects_, wandering_.usual, economy);
    model_.resistance = fit_->resistance();
    book("fits");
  }

  /// What the swimmer's way does not feel is left out at last alone: until then samples are chosen, which are to do for
  /// finer fits too.
  template <int dim>
  FitEconomy Training<dim>::economy(const bool is_last) const
  {
    if (is_fine_)
      return {1.};
    if (!is_last)
      return {};
    const auto ways = [this](const ReducedResistance &resistance) {
      ReducedModel model = model_;
      model.resistance   = resistance;
      return third_ways(model, scene_);
    };
    return {nearly_as_good, ways, options_.target};
  }

  /// Shapes of the reduced swimmer's own runs that no sample is near to.
  template <int dim>
  void Training<dim>::hold_out_samples(ShapeSampler &sampler)
  {
    constexpr std::size_t      n      = 60;
    const auto                 points = explore(model_, scene_, spread_members(options_.range, n, 1000), rest_);
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
  template <int dim>
  void Training<dim>::judge()
  {
    model_.record = {};
    record_velocity_errors();
    record();
    compare();
    book("held-out full-order runs");
  }

  template <int dim>
  void Training<dim>::record_velocity_errors()
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

  template <int dim>
  void Training<dim>::record()
  {
    auto &r                 = model_.record;
    r.target                = options_.target;
    r.singular_values_m     = basis_.singular_values.head(std::min<Eigen::Index>(40, basis_.singular_values.size()));
    r.energy_captured       = basis_.energy_captured;
    r.n_snapshots           = n_snapshots_;
    r.n_resistance_samples  = static_cast<int>(samples_.size());
    const Eigen::VectorXd d = samples_.front().resistance.diagonal().cwiseSqrt().cwiseInverse();
    for (const auto &sample : samples_)
    {
      const Eigen::VectorXd values = symmetric_eigenvalues(d.asDiagonal() * sample.resistance * d.asDiagonal());
      r.largest_condition          = std::max(r.largest_condition, values.maxCoeff() / values.minCoeff());
    }
    constexpr double of_note = 0.01;
    r.neglects.push_back(
        scene_.domain->moves_with_swimmer
            ? "Nothing of the pose: the domain moves with the swimmer."
            : fmt::format("The place along the domain: over the {:.2g} mm that the body's middle "
                          "went in two periods, resistance changes by at most {:.2g} % (some {:.2g} % of "
                          "the displacement{}).",
                          1e3 * wandering_.reach_m[0], 100. * pose_.on_way, 100. * known_shares().place,
                          known_shares().place > of_note ? "; a longer domain would help" : ""));
    if (!scene_.domain->moves_with_swimmer && !region_.depends_on_height)
      r.neglects.push_back(fmt::format("The height in the domain: over the {:.2g} mm from the usual one, resistance "
                                       "changes by at most {:.2g} % (some {:.2g} % of the displacement).",
                                       1e3 * wandering_.reach_m[1], 100. * pose_.on_height,
                                       100. * share_of_displacement(pose_.on_height)));
    if (!scene_.domain->moves_with_swimmer && !region_.depends_on_angle)
      r.neglects.push_back(
          fmt::format("The angle in the domain: resistance changes by at most {:.2g} % (some {:.2g} % of the "
                      "displacement).",
                      100. * pose_.on_angle, 100. * share_of_displacement(pose_.on_angle)));
    r.neglects.push_back(fmt::format("Shapes outside the modes: {:.2g} um root mean square of those in the runs.",
                                     1e6 * basis_.projection_error_m));
  }

  template <int dim>
  void Training<dim>::compare()
  {
    if (!options_.known_runs.empty())
    {
      model_.record.held_out_runs = compare_with_known(model_, scene_, options_.known_runs);
      return;
    }
    model_.record.held_out_runs =
        compare_with_full_order(model_, scene_, spread_members(options_.range, options_.n_held_out, 200),
                                run_options("held-out", "held-out full-order runs"), communicator_);
  }

  template <int dim>
  void Training<dim>::report(const std::string &stage, const int done, const int total) const
  {
    if (options_.on_progress)
      options_.on_progress(stage, done, total);
  }

  template class Training<2>;
  template class Training<3>;
} // namespace swimtwin
