#include <datasets/files/json_entries.h>
#include <datasets/observation/calibration_result.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  static Json json_of(const ParameterRole role)
  {
    return to_string(role);
  }

  static void read_json(const Json &json, ParameterRole &role)
  {
    const auto word = json.get<std::string>();
    for (const ParameterRole candidate : {ParameterRole::free, ParameterRole::fixed, ParameterRole::derived})
      if (word == to_string(candidate))
      {
        role = candidate;
        return;
      }
    throw InputError(fmt::format("has a parameter of the unknown role {}", word));
  }

  template <Like<CalibratedSwimmer> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("young_modulus_Pa", v.young_modulus_Pa);
    visit("viscosity_Pa_s", v.viscosity_Pa_s);
    visit("magnetization_A_m", v.magnetization_A_m);
    visit("field_scale", v.field_scale);
    visit("geometry_scale", v.geometry_scale);
    visit("displacement_offset_m", v.displacement_offset_m);
    visit("displacement_scale", v.displacement_scale);
    visit("noise_scale", v.noise_scale);
  }

  template <Like<ClaimedInterval> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("method", v.method);
    visit("low", v.low);
    visit("high", v.high);
    visit("note", v.note);
  }

  template <Like<CalibratedParameter> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("name", v.name);
    visit("role", v.role);
    visit("logarithmic", v.logarithmic);
    visit("value", v.value);
    visit("standard_error", v.standard_error);
    visit("lower", v.lower);
    visit("upper", v.upper);
    visit("prior_mean", v.prior_mean);
    visit("prior_standard_deviation", v.prior_standard_deviation);
    visit("at_bound", v.at_bound);
    visit("undetermined", v.undetermined);
    visit("curvature", v.curvature);
    visit("profile", v.profile);
    visit("bootstrap", v.bootstrap);
  }

  template <Like<NullDirection> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("direction", v.direction);
    visit("strength", v.strength);
    visit("has_prior", v.has_prior);
    visit("reading", v.reading);
  }

  template <Like<FitStart> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("start", v.start);
    visit("end", v.end);
    visit("misfit_at_start", v.misfit_at_start);
    visit("misfit", v.misfit);
    visit("status", v.status);
    visit("kkt_residual", v.kkt_residual);
    visit("n_evaluations", v.n_evaluations);
  }

  template <Like<TraceStep> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("n_evaluations", v.n_evaluations);
    visit("misfit", v.misfit);
  }

  template <Like<ParameterProfile> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("name", v.name);
    visit("value", v.value);
    visit("misfit_increase", v.misfit_increase);
    visit("threshold", v.threshold);
  }

  template <Like<PredictionBand> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("data_set", v.data_set);
    visit("frequency_Hz", v.frequency_Hz);
    visit("value", v.value);
    visit("low", v.low);
    visit("high", v.high);
    visit("observation_low", v.observation_low);
    visit("observation_high", v.observation_high);
  }

  template <Like<ObservationResidual> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("data_set", v.data_set);
    visit("frequency_Hz", v.frequency_Hz);
    visit("observed", v.observed);
    visit("sigma", v.sigma);
    visit("predicted", v.predicted);
    visit("model_error", v.model_error);
    visit("standardised", v.standardised);
    visit("weight", v.weight);
    visit("trust", v.trust);
  }

  template <Like<NextExperiment> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("parameter", v.parameter);
    visit("data_set", v.data_set);
    visit("frequency_Hz", v.frequency_Hz);
    visit("interval_ratio", v.interval_ratio);
    visit("information_gain", v.information_gain);
    visit("best_frequency_Hz", v.best_frequency_Hz);
    visit("best_interval_ratio", v.best_interval_ratio);
    visit("most_informative_frequency_Hz", v.most_informative_frequency_Hz);
  }

  template <Like<FullOrderCheck> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("data_set", v.data_set);
    visit("frequency_Hz", v.frequency_Hz);
    visit("reduced", v.reduced);
    visit("full_order", v.full_order);
  }

  template <Like<ModelDiscrepancy> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("relative_size", v.relative_size);
    visit("correlation_decades", v.correlation_decades);
    visit("origin", v.origin);
    visit("checks", v.checks);
    visit("moved_estimate", v.moved_estimate);
    visit("largest_move", v.largest_move);
    visit("verdict", v.verdict);
  }

  template <Like<CalibrationResult> Type, typename Visitor>
  void for_each_entry(Type &v, const Visitor &visit)
  {
    visit("status", v.status);
    visit("message", v.message);
    visit("level", v.level);
    visit("swimmer", v.swimmer);
    visit("parameters", v.parameters);
    visit("inertia", v.inertia);
    visit("misfit", v.misfit);
    visit("chi_squared", v.chi_squared);
    visit("n_observations", v.n_observations);
    visit("n_degrees_of_freedom", v.n_degrees_of_freedom);
    visit("kkt_residual", v.kkt_residual);
    visit("polish_step", v.polish_step);
    visit("n_evaluations", v.n_evaluations);
    visit("max_evaluations", v.max_evaluations);
    visit("n_runs", v.n_runs);
    visit("integrator_tolerance", v.integrator_tolerance);
    visit("loss", v.loss);
    visit("starts", v.starts);
    visit("trace", v.trace);
    visit("covariance", v.covariance);
    visit("correlation", v.correlation);
    visit("singular_values", v.singular_values);
    visit("null_directions", v.null_directions);
    visit("profiles", v.profiles);
    visit("bootstrap", v.bootstrap);
    visit("n_bootstrap_failures", v.n_bootstrap_failures);
    visit("posterior", v.posterior);
    visit("posterior_method", v.posterior_method);
    visit("bands", v.bands);
    visit("residuals", v.residuals);
    visit("next", v.next);
    visit("discrepancy", v.discrepancy);
    visit("refinement", v.refinement);
    visit("warnings", v.warnings);
    visit("model_file", v.model_file);
    visit("scene_name", v.scene_name);
    visit("problem_text", v.problem_text);
    visit("data_files", v.data_files);
    visit("fit_time_s", v.fit_time_s);
    visit("uncertainty_time_s", v.uncertainty_time_s);
    visit("provenance", v.provenance);
  }

  const char *to_string(const ParameterRole role)
  {
    return role == ParameterRole::free ? "free" : role == ParameterRole::fixed ? "fixed" : "derived";
  }

  const ClaimedInterval &CalibratedParameter::interval() const
  {
    if (!profile.method.empty())
      return profile;
    return bootstrap.method.empty() ? curvature : bootstrap;
  }

  std::vector<std::string> CalibrationResult::free_names() const
  {
    std::vector<std::string> names;
    for (const CalibratedParameter &parameter : parameters)
      if (parameter.role == ParameterRole::free)
        names.push_back(parameter.name);
    return names;
  }

  const CalibratedParameter *CalibrationResult::find(const std::string &name) const
  {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const CalibratedParameter &parameter) { return parameter.name == name; });
    return found == parameters.end() ? nullptr : &*found;
  }

  void write_calibration_result(const std::filesystem::path &file, const CalibrationResult &result)
  {
    write_json_file(file, json_of(result));
  }

  double ModelDiscrepancy::largest_difference() const
  {
    constexpr double smallest_scale = .05; // of the largest: near its zeros a displacement is no measure of itself
    double           scale = 0., largest = 0.;
    for (const FullOrderCheck &check : checks)
      scale = std::max(scale, std::abs(check.full_order));
    for (const FullOrderCheck &check : checks)
      largest = std::max(largest, std::abs(check.reduced - check.full_order) /
                                      std::max(std::abs(check.full_order), smallest_scale * scale));
    return largest;
  }

  CalibrationResult read_calibration_result(const std::filesystem::path &file)
  {
    Json json = read_json_file(file, "the result of a calibration", "run `swimtwin calibrate` again");
    if (json.is_object())
    {
      json.emplace("inertia", Json::array());    // results of earlier versions lack it: they carried none
      json.emplace("refinement", Json::array()); // and were not refined
    }
    CalibrationResult result;
    try
    {
      read_json(json, result);
    }
    catch (const InputError &error)
    {
      throw InputError(fmt::format("{} {}; it is not a calibration.json of this version: run `swimtwin calibrate` "
                                   "again.",
                                   file.string(), error.what()));
    }
    return result;
  }
} // namespace swimtwin
