#include <calibration/calibrate.h>
#include <calibration/full_order_check.h>
#include <calibration/null_reading.h>
#include <calibration/parameter_summary.h>
#include <datasets/clocks.h>
#include <datasets/error.h>
#include <datasets/parallel_for.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr int n_posterior = 200;

    bool has_free_noise(const CalibrationProblem &problem)
    {
      return std::any_of(problem.free.begin(), problem.free.end(),
                         [](const FreeParameter &f) { return f.quantity == FittedQuantity::noise_scale; });
    }

    void require_enough_observations(const FitInput &input)
    {
      const int n = input.data.n(), p = static_cast<int>(input.problem.free.size());
      if (n >= p)
        return;
      throw InputError(fmt::format("{} observations cannot fit {} parameters; add observations or fix parameters with "
                                   "value = ... in the problem file.",
                                   n, p));
    }

    /// Groups that the model was trained for, the field's scale at 1.
    GroupBox trained_box(const MotionGroups &groups, const CalibrationModel &model)
    {
      const TrainedRange &range = model.range;
      CalibratedSwimmer   low = model.nominal, high = model.nominal;
      low.young_modulus_Pa   = range.young_modulus_Pa.low;
      high.young_modulus_Pa  = range.young_modulus_Pa.high;
      low.magnetization_A_m  = range.magnetization_A_m.low;
      high.magnetization_A_m = range.magnetization_A_m.high;
      low.viscosity_Pa_s     = range.viscosity_Pa_s.high;
      high.viscosity_Pa_s    = range.viscosity_Pa_s.low;
      return {groups.values(low), groups.values(high)};
    }

    /// Bounds that hold nothing that the model knows are most likely in another unit.
    void require_overlap_with_trained(const FitInput &input)
    {
      if (input.problem.allow_untrained)
        return;
      const MotionGroups groups(input.model);
      const GroupBox     asked   = input.map.group_box(groups, input.map.lower(), input.map.upper());
      const GroupBox     trained = trained_box(groups, input.model);
      const char        *names[] = {"E/mu (1/s)", "M/mu (A/(m Pa s))"};
      for (Eigen::Index g = 0; g < 2; ++g)
        if (asked.upper[g] < trained.lower[g] || asked.lower[g] > trained.upper[g])
          throw InputError(fmt::format(
              "the bounds exclude every start that the model was trained for: they allow {} from {:.4g} to {:.4g}, and "
              "it knows {:.4g} to {:.4g}; check their units, or set allow_untrained = true in [fit].",
              names[g], std::exp(asked.lower[g]), std::exp(asked.upper[g]), std::exp(trained.lower[g]),
              std::exp(trained.upper[g])));
    }

    std::vector<FitStart> waterfall(const FitInput &input, const Estimate &estimate)
    {
      std::vector<FitStart> starts;
      for (std::size_t i = 0; i < estimate.search.minima.size(); ++i)
      {
        const Minimum &minimum = estimate.search.minima[i];
        FitStart       start;
        start.start = input.map.values(estimate.starts.col(static_cast<Eigen::Index>(i)));
        start.end   = minimum.x.size() > 0 ? input.map.values(minimum.x) : start.start;
        start.misfit_at_start =
            minimum.trace.empty() ? std::numeric_limits<double>::quiet_NaN() : minimum.trace.front().objective;
        start.misfit        = minimum.is_feasible() ? minimum.objective : std::numeric_limits<double>::quiet_NaN();
        start.status        = to_string(minimum.status);
        start.kkt_residual  = minimum.kkt_residual;
        start.n_evaluations = minimum.n_evaluations;
        starts.push_back(start);
      }
      std::stable_sort(starts.begin(), starts.end(), [](const FitStart &a, const FitStart &b) {
        return a.misfit < b.misfit || (std::isfinite(a.misfit) && !std::isfinite(b.misfit));
      });
      return starts;
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
        result_.starts          = waterfall(input_, estimate_);
        for (const SearchStep &step : estimate_.search.minima[static_cast<std::size_t>(estimate_.search.best)].trace)
          result_.trace.push_back({step.n_evaluations, step.objective});
        factor_ =
            coverage_factor(result_.level, has_free_noise(input_.problem), std::max(1, result_.n_degrees_of_freedom));
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
        for (const ObservationSet &set : sets_)
          for (const std::string &warning : set.warnings)
            result_.warnings.push_back(warning);
        warn_of_sizes();
        warn_of_trust();
        warn_of_bounds();
        warn_of_scatter();
        if (estimate_.error.origin == "none" && !input_.problem.model_error)
          result_.warnings.push_back(
              "the model has no held-out runs, so its own error is not known and counts as zero");
        set_status();
      }

      void warn_of_sizes()
      {
        for (const ObservationSet &set : sets_)
          if (!set.body_length_m)
            for (const std::string &warning : implausible_sizes(set, input_.model.body_length_m))
              if (std::find(result_.warnings.begin(), result_.warnings.end(), warning) == result_.warnings.end())
                result_.warnings.push_back(warning);
      }

      void warn_of_trust()
      {
        const auto &all     = result_.residuals;
        const auto  outside = [](const ObservationResidual &r) { return !r.trust.empty(); };
        const auto  first   = std::find_if(all.begin(), all.end(), outside);
        if (first != all.end())
          result_.warnings.push_back(fmt::format(
              "at the estimate {} of {} observations are outside what the model was trained for (the first, {:.4g} Hz: "
              "{})",
              std::count_if(all.begin(), all.end(), outside), all.size(), first->frequency_Hz, first->trust));
      }

      void warn_of_bounds()
      {
        for (const CalibratedParameter &p : result_.parameters)
          if (p.role == ParameterRole::free && p.at_bound && !p.undetermined)
            result_.warnings.push_back(fmt::format("{} = {:.4g} lies at its bound: its interval ends there; widen the "
                                                   "bounds if they are not physical",
                                                   p.name, p.value));
      }

      void warn_of_scatter()
      {
        if (result_.n_degrees_of_freedom < 1 || has_free_noise(input_.problem) ||
            input_.problem.loss != LossKind::least_squares)
          return;
        const boost::math::chi_squared law(result_.n_degrees_of_freedom);
        const double                   larger = boost::math::cdf(boost::math::complement(law, result_.chi_squared));
        if (larger < 1e-3)
          result_.warnings.push_back(fmt::format(
              "the residuals are larger than the stated sigma explain (chi^2 = {:.4g} at {} degrees of "
              "freedom): intervals are too short; free noise_scale, use a robust loss, or look for what the "
              "model lacks",
              result_.chi_squared, result_.n_degrees_of_freedom));
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
    const CalibrationModel model(reduced);
    const ParameterMap     map(problem, model.nominal, data.largest_m());
    const FitInput input{model, reduced, problem, data, map, n_threads_for(64, options.n_threads), options.on_progress};
    require_enough_observations(input);
    require_overlap_with_trained(input);
    return Calibration(input, sets, options).run();
  }
} // namespace swimtwin
