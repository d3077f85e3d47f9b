#include <calibration/fit/fit_requirements.h>
#include <calibration/fit/noise_level.h>
#include <calibration/run/calibrate.h>
#include <calibration/run/calibration_warnings.h>
#include <calibration/run/full_order_check.h>
#include <calibration/uncertainty/null_reading.h>
#include <calibration/uncertainty/parameter_summary.h>
#include <datasets/scene/inertia_terms.h>
#include <datasets/system/clocks.h>
#include <datasets/system/parallel_for.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr int n_posterior = 200;

    void require_sense(const FitInput &input)
    {
      require_enough_observations(input);
      require_overlap_with_trained(input);
      require_fixed_lengths(input);
    }

    /// One calibration, section by section of its result.
    class Calibration
    {
    public:
      Calibration(const FitInput &input, const std::vector<ObservationSet> &sets, const CalibrationOptions &options)
          : input_(input), sets_(sets), options_(options)
      {
      }

      CalibrationResult run()
      {
        const double start = wall_time_s();
        estimate_          = fit(input_);
        describe_fit();
        result_.fit_time_s = wall_time_s() - start;
        describe_information();
        describe_residuals();
        add_intervals();
        add_forecast();
        add_discrepancy();
        conclude();
        result_.uncertainty_time_s = wall_time_s() - start - result_.fit_time_s;
        return std::move(result_);
      }

    private:
      void show(const std::string &what, const double done) const
      {
        if (options_.on_progress)
          options_.on_progress(what, done);
      }

      void describe_fit()
      {
        result_.level               = input_.problem.level;
        result_.inertia             = names_of(input_.model.inertia);
        result_.swimmer             = input_.map.swimmer(estimate_.x());
        result_.swimmer.noise_scale = estimate_.noise_scale;
        result_.n_observations      = input_.data.n();
        result_.n_degrees_of_freedom =
            input_.data.n() - input_.map.size() + static_cast<int>(estimate_.information.undecided.cols());
        result_.misfit               = estimate_.misfit;
        result_.chi_squared          = estimate_.information.residual.squaredNorm();
        result_.kkt_residual         = estimate_.kkt_residual;
        result_.polish_step          = estimate_.polish_step;
        result_.integrator_tolerance = estimate_.integrator_tolerance;
        result_.n_evaluations = estimate_.search.minima[static_cast<std::size_t>(estimate_.search.best)].n_evaluations;
        result_.max_evaluations = input_.problem.max_evaluations;
        result_.loss            = to_string(input_.problem.loss);
        result_.starts          = waterfall(input_, estimate_.search);
        for (const SearchStep &step : estimate_.search.minima[static_cast<std::size_t>(estimate_.search.best)].trace)
          result_.trace.push_back({step.n_evaluations, step.objective});
        factor_ = coverage_factor(result_.level, free_noise_scale(input_.problem) != nullptr,
                                  std::max(1, result_.n_degrees_of_freedom));
      }

      void describe_information()
      {
        const Information &information = estimate_.information;
        constexpr double   unknown     = std::numeric_limits<double>::quiet_NaN();
        result_.parameters             = summarize_parameters(input_, estimate_, factor_);
        result_.singular_values        = information.singular_values;
        result_.null_directions        = null_directions(input_, estimate_);
        result_.covariance             = information.covariance;
        for (int j = 0; j < input_.map.size(); ++j)
          if (information.touches_undecided(j))
          {
            result_.covariance.row(j).setConstant(unknown);
            result_.covariance.col(j).setConstant(unknown);
          }
        const Eigen::VectorXd deviations = result_.covariance.diagonal().cwiseSqrt();
        result_.correlation =
            deviations.cwiseInverse().asDiagonal() * result_.covariance * deviations.cwiseInverse().asDiagonal();
      }

      void describe_residuals()
      {
        const Misfit          misfit = misfit_of(input_, estimate_);
        const Prediction     &at     = estimate_.prediction;
        const Eigen::VectorXd r      = misfit.residuals(at);
        const Eigen::VectorXd curve =
            at.value_m - at.by_error * estimate_.unknowns.tail(estimate_.error.n_components());
        const auto trust = ExactDisplacements(input_.model, input_.data.conditions, {}).trust(result_.swimmer);
        for (int i = 0; i < input_.data.n(); ++i)
        {
          const auto set = static_cast<std::size_t>(input_.data.set[static_cast<std::size_t>(i)]);
          result_.residuals.push_back({input_.data.set_names[set], input_.data.frequency_Hz[i],
                                       input_.data.observed_m[i], input_.data.sigma_m[i], curve[i],
                                       at.by_error.row(i).norm(), r[i], misfit.loss.weight(r[i]),
                                       trust[static_cast<std::size_t>(i)]});
        }
      }

      void add_intervals()
      {
        const int p = input_.map.size();
        if (input_.problem.profiles)
        {
          std::vector<Profile> profiles(static_cast<std::size_t>(p));
          parallel_for(profiles.size(), n_threads_for(profiles.size(), input_.n_threads), [&] {
            return
                [&](const std::size_t j) { profiles[j] = profile_of(input_, estimate_, static_cast<int>(j), factor_); };
          });
          for (std::size_t j = 0; j < profiles.size(); ++j)
          {
            result_.parameters[j].profile = profiles[j].interval;
            if (!profiles[j].curve.value.empty())
              result_.profiles.push_back(profiles[j].curve);
          }
        }
        show("bootstrap", 0.);
        const int       n            = input_.problem.n_bootstrap_samples;
        const auto      seed         = static_cast<unsigned long>(input_.problem.seed);
        const Bootstrap samples      = bootstrap(input_, estimate_, n, seed);
        result_.n_bootstrap_failures = samples.n_failures;
        if (n > 0)
          for (int j = 0; j < p; ++j)
            result_.parameters[static_cast<std::size_t>(j)].bootstrap =
                bootstrap_interval(input_, estimate_, samples, j, result_.level);
        result_.bootstrap.resize(samples.x.rows(), p);
        for (Eigen::Index i = 0; i < samples.x.rows(); ++i)
          result_.bootstrap.row(i) = input_.map.values(samples.x.row(i));
        add_posterior(samples.x.rows() > 0 ? samples.x : draws_from_curvature(estimate_, n_posterior, seed));
        result_.posterior_method = samples.x.rows() > 0 ? "bootstrap" : "curvature";
      }

      void add_posterior(const Eigen::MatrixXd &x)
      {
        for (Eigen::Index i = 0; i < std::min<Eigen::Index>(n_posterior, x.rows()); ++i)
        {
          const Eigen::VectorXd inside = x.row(i).transpose().cwiseMax(input_.map.lower()).cwiseMin(input_.map.upper());
          result_.posterior.push_back(input_.map.swimmer(inside));
          result_.posterior.back().noise_scale = estimate_.noise_scale;
        }
      }

      void add_forecast()
      {
        show("band", 0.);
        const Forecast curves = forecast(input_, estimate_, sets_, options_.n_frequencies);
        for (const Forecast::Curve &curve : curves.curves)
          result_.bands.push_back(prediction_band(input_, estimate_, curve, factor_));
        const auto names  = input_.map.names();
        const auto chosen = std::find(names.begin(), names.end(), input_.problem.next_parameter);
        result_.next      = next_experiment(input_, estimate_, curves,
                                       chosen == names.end() ? 0 : static_cast<int>(chosen - names.begin()));
        result_.n_runs    = estimate_.n_runs + curves.n_runs;
      }

      void add_discrepancy()
      {
        ModelDiscrepancy &discrepancy   = result_.discrepancy;
        discrepancy.relative_size       = estimate_.error.relative_size;
        discrepancy.correlation_decades = estimate_.error.decades;
        discrepancy.origin              = estimate_.error.origin;
        if (options_.n_checks > 0 && options_.full_order)
          check_with_full_order(input_, estimate_, options_, factor_, discrepancy);
      }

      void conclude()
      {
        result_.warnings = calibration_warnings(input_, sets_, estimate_, result_);
        set_status();
      }

      void set_status()
      {
        if (estimate_.information.undecided.cols() > 0)
        {
          result_.status = "undetermined";
          result_.message =
              fmt::format("the data leave {} direction(s) open: {}", estimate_.information.undecided.cols(),
                          result_.null_directions.front().reading);
        }
        else if (estimate_.polished)
        {
          result_.status  = "converged";
          result_.message = fmt::format("first-order residual {:.1e}", result_.kkt_residual);
        }
        else
        {
          result_.status  = "stalled";
          result_.message = fmt::format("the last step would still move the estimate by {:.2g}; first-order residual "
                                        "{:.1e}",
                                        result_.polish_step, result_.kkt_residual);
        }
      }

      const FitInput                    &input_;
      const std::vector<ObservationSet> &sets_;
      const CalibrationOptions          &options_;
      Estimate                           estimate_;
      CalibrationResult                  result_;
      double                             factor_ = 0.;
    };
  } // namespace

  CalibrationResult calibrate(const ReducedModel &reduced, const CalibrationProblem &problem,
                              const std::vector<ObservationSet> &sets, const CalibrationOptions &options)
  {
    const CalibrationData  data = calibration_data(sets);
    const CalibrationModel model(reduced, options.inertia);
    const ParameterMap     map(problem, model.nominal, data.largest_m());
    const FitInput input{model, reduced, problem, data, map, n_threads_for(64, options.n_threads), options.on_progress};
    require_sense(input);
    return Calibration(input, sets, options).run();
  }

  std::vector<std::string> check_before_fit(const ReducedModel &reduced, const CalibrationProblem &problem,
                                            const std::vector<ObservationSet> &sets, const InertiaTerms &inertia)
  {
    const CalibrationData  data = calibration_data(sets);
    const CalibrationModel model(reduced, inertia);
    const ParameterMap     map(problem, model.nominal, data.largest_m());
    require_sense({model, reduced, problem, data, map});
    return data_warnings(model, sets);
  }
} // namespace swimtwin
