#include <calibration/misfit/exact_displacements.h>
#include <datasets/system/error.h>
#include <datasets/system/parallel_for.h>

#include <rom/sweep/starting_state.h>
#include <rom/sweep/sweep.h>
#include <rom/sweep/trained_ratios.h>
#include <rom/sweep/trust.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    constexpr int periods_before_orbit = 2; // from rest, as a start for the search of the periodic motion

    std::vector<Parameter> parameters_of(const std::array<bool, n_motion_quantities> &by, const bool magnetic_tail)
    {
      std::vector<Parameter> parameters;
      if (by[by_young_modulus])
        parameters.push_back({Quantity::young_modulus});
      if (by[by_viscosity])
        parameters.push_back({Quantity::viscosity});
      if (by[by_magnetization] || by[by_field_scale])
        parameters.push_back({Quantity::magnetization});
      if (by[by_field_scale] && magnetic_tail)
        parameters.push_back({Quantity::tail_magnetization});
      return parameters;
    }

    Scene scene_of(const ReducedModel &model)
    {
      return parse_scene(model.scene_text, model.scene_name + ".toml");
    }
  } // namespace

  CalibrationModel::CalibrationModel(const ReducedModel &model, const InertiaTerms &carried)
      : inertia(carried), swimmer(model, inertial_densities(scene_of(model), carried)), range(model.range)
  {
    const Scene        scene  = scene_of(model);
    const SweepOptions own    = sweep_options(scene, model);
    base                      = own.base;
    base.initial_state        = starting_state(swimmer, own.base.initial_state);
    heading_rad               = own.heading_rad;
    body_length_m             = scene.body_length_m();
    nominal.young_modulus_Pa  = base.parameters.young_modulus_Pa;
    nominal.viscosity_Pa_s    = base.parameters.viscosity_Pa_s;
    nominal.magnetization_A_m = base.parameters.magnetization_A_m;
    if (nominal.magnetization_A_m <= 0.)
      throw InputError(fmt::format("[head] magnetization_A_m = {} of the model's scene {} is not positive, and a fit "
                                   "changes it by factors; use a model whose head has a magnetization.",
                                   nominal.magnetization_A_m, model.scene_name));
  }

  RunRequest run_request(const CalibrationModel &model, const SwimmingCondition &condition,
                         const CalibratedSwimmer &swimmer)
  {
    RunRequest request                   = model.base;
    request.parameters.young_modulus_Pa  = swimmer.young_modulus_Pa;
    request.parameters.viscosity_Pa_s    = swimmer.viscosity_Pa_s;
    request.parameters.magnetization_A_m = swimmer.magnetization_A_m;
    request.drive                        = condition.drive;
    request.drive.parameters *= swimmer.field_scale;
    request.n_periods          = condition.period.value_or(periods_before_orbit);
    request.samples_per_period = 0;
    return request;
  }

  /// What each thread has for itself.
  class ExactDisplacements::Worker
  {
  public:
    Worker(const CalibrationModel &model, const ExactOptions &options)
        : model_(model), parameters_(parameters_of(options.by, model.base.parameters.tail_magnetization_A_m != 0.)),
          plain_(model.swimmer, {.relative_tolerance = options.relative_tolerance}),
          differentiated_(model.swimmer,
                          {.relative_tolerance = options.relative_tolerance, .sensitivities = parameters_}),
          plain_orbits_(model.swimmer, orbit_options(options, {})),
          differentiated_orbits_(model.swimmer, orbit_options(options, parameters_)), by_(options.by)
    {
    }

    /// Value and, in `slopes`, derivatives by logarithms. Returns why it failed.
    std::string displacement(const SwimmingCondition &condition, const CalibratedSwimmer &swimmer,
                             const bool derivatives, double &value, Eigen::Ref<Eigen::RowVectorXd> slopes)
    {
      const RunRequest   request = run_request(model_, condition, swimmer);
      Eigen::RowVectorXd by_parameters;
      const std::string  failure = condition.period ? in_period(request, derivatives, value, by_parameters)
                                                    : in_orbit(request, derivatives, value, by_parameters);
      if (failure.empty() && derivatives)
        set_slopes(request.parameters, by_parameters, slopes);
      return failure;
    }

  private:
    static OrbitOptions orbit_options(const ExactOptions &options, const std::vector<Parameter> &parameters)
    {
      return {.relative_tolerance = options.relative_tolerance,
              .closure            = 10. * options.relative_tolerance,
              .exact_multipliers  = false,
              .parameters         = parameters};
    }

    std::string in_period(const RunRequest &request, const bool derivatives, double &value, Eigen::RowVectorXd &slopes)
    {
      const SwimmerRun run = (derivatives ? differentiated_ : plain_).run(request);
      if (!run.completed())
        return run.failure;
      value = displacement_per_period(run, model_.heading_rad).back();
      if (derivatives)
        slopes = displacement_sensitivities(run, model_.heading_rad).bottomRows<1>();
      return {};
    }

    std::string in_orbit(RunRequest request, const bool derivatives, double &value, Eigen::RowVectorXd &slopes)
    {
      const SwimmerRun run = plain_.run(request);
      if (!run.completed())
        return run.failure;
      const double height_m     = request.initial_state[1];
      request.initial_state     = run.at_period_end.back();
      request.initial_state[1]  = height_m; // between walls, whatever the parameters
      const PeriodicOrbit orbit = (derivatives ? differentiated_orbits_ : plain_orbits_).find(request);
      if (!orbit.converged())
        return orbit.failure;
      value = orbit.displacement_m(model_.heading_rad);
      if (derivatives)
        slopes = orbit.displacement_sensitivity(model_.heading_rad);
      return {};
    }

    /// The field enters by its product with the moment of head and tail alone.
    void set_slopes(const SwimmerParameters &p, const Eigen::RowVectorXd &by_parameters,
                    Eigen::Ref<Eigen::RowVectorXd> slopes) const
    {
      slopes.setZero();
      for (std::size_t k = 0; k < parameters_.size(); ++k)
      {
        const double slope = by_parameters[static_cast<Eigen::Index>(k)];
        switch (parameters_[k].quantity)
        {
        case Quantity::young_modulus:
          slopes[by_young_modulus] = slope * p.young_modulus_Pa;
          break;
        case Quantity::viscosity:
          slopes[by_viscosity] = slope * p.viscosity_Pa_s;
          break;
        case Quantity::magnetization:
          slopes[by_magnetization] = slope * p.magnetization_A_m;
          slopes[by_field_scale] += slopes[by_magnetization];
          break;
        default:
          slopes[by_field_scale] += slope * p.tail_magnetization_A_m;
        }
      }
      for (int q = 0; q < n_motion_quantities; ++q)
        if (!by_[static_cast<std::size_t>(q)])
          slopes[q] = 0.;
    }

    const CalibrationModel               &model_;
    std::vector<Parameter>                parameters_;
    SwimmerIntegrator                     plain_, differentiated_;
    PeriodicOrbitFinder                   plain_orbits_, differentiated_orbits_;
    std::array<bool, n_motion_quantities> by_;
  };

  ExactDisplacements::ExactDisplacements(const CalibrationModel &model, std::vector<SwimmingCondition> conditions,
                                         const ExactOptions &options)
      : model_(model), conditions_(std::move(conditions)), options_(options)
  {
    const int n_threads = std::clamp(options.n_threads, 1, std::max(1, n_conditions()));
    for (int t = 0; t < n_threads; ++t)
      workers_.push_back(std::make_unique<Worker>(model_, options_));
    result_.value_m.resize(n_conditions());
    result_.by_logarithm.resize(n_conditions(), n_motion_quantities);
  }

  ExactDisplacements::~ExactDisplacements() = default;

  const Displacements &ExactDisplacements::evaluate(const CalibratedSwimmer &swimmer, const bool derivatives)
  {
    std::vector<std::string> failures(conditions_.size());
    std::atomic<std::size_t> next_worker = 0;
    parallel_for(conditions_.size(), static_cast<int>(workers_.size()), [&] {
      return [&, &worker = *workers_[next_worker++]](const std::size_t i) {
        Eigen::RowVectorXd slopes(n_motion_quantities);
        const auto         row = static_cast<Eigen::Index>(i);
        failures[i] = worker.displacement(conditions_[i], swimmer, derivatives, result_.value_m[row], slopes);
        if (derivatives)
          result_.by_logarithm.row(row) = slopes;
      };
    });
    n_runs_ += n_conditions();
    const auto failed = std::find_if(failures.begin(), failures.end(), [](const auto &text) { return !text.empty(); });
    result_.failure   = failed == failures.end() ? std::string() : *failed;
    if (!result_.failed() && !result_.value_m.allFinite())
      result_.failure = "a displacement is not a finite number";
    return result_;
  }

  std::vector<std::string> ExactDisplacements::trust(const CalibratedSwimmer &swimmer) const
  {
    SwimmerIntegrator        integrator(model_.swimmer, {.relative_tolerance = options_.relative_tolerance});
    std::vector<std::string> notes;
    for (const SwimmingCondition &condition : conditions_)
    {
      const RunRequest request = run_request(model_, condition, swimmer);
      TrustNotes       trust   = trust_notes(model_.range, request, integrator.run(request));
      trust.outside_range      = notes_outside_range(model_.range, request); // data know ratios, not parameters
      notes.push_back(trust.text());
    }
    return notes;
  }
} // namespace swimtwin
