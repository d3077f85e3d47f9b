#include <tests/calibration/synthetic_curve.h>

#include <tests/places.h>

#include <cmath>
#include <random>

namespace swimtwin
{
  const ReducedModel &reference_model()
  {
    static const ReducedModel model = read_reduced_model(std::string(places::models) + "/reference-2d.h5");
    return model;
  }

  const CalibrationModel &reference_swimmer()
  {
    static const CalibrationModel model(reference_model());
    return model;
  }

  CalibratedSwimmer known_swimmer()
  {
    CalibratedSwimmer swimmer = reference_swimmer().nominal;
    swimmer.young_modulus_Pa  = 8e4;
    swimmer.magnetization_A_m = 1.3e5;
    return swimmer;
  }

  ObservationSet exact_curve(const int n, const CalibratedSwimmer &swimmer, const std::optional<int> period)
  {
    ObservationSet set;
    set.name   = "synthetic";
    set.period = period;
    set.field  = FieldProgram::sinusoidal(5e-3, 5e-3, 1.);
    for (int i = 0; i < n; ++i)
    {
      Observation point;
      point.frequency_Hz = 0.12 * std::pow(2. / 0.12, i / (n - 1.));
      set.points.push_back(point);
    }
    ExactDisplacements    exact(reference_swimmer(), calibration_data({set}).conditions,
                                {.relative_tolerance = 1e-9, .n_threads = 2, .by = {}});
    const Eigen::VectorXd motion = exact.evaluate(swimmer, false).value_m;
    for (int i = 0; i < n; ++i)
    {
      Observation &point = set.points[static_cast<std::size_t>(i)];
      point.displacement_m =
          swimmer.displacement_offset_m + swimmer.displacement_scale * swimmer.geometry_scale * motion[i];
      point.sigma_m = 0.02 * std::abs(motion[i]);
    }
    return set;
  }

  ObservationSet noisy_curve(const ObservationSet &exact, const unsigned int seed)
  {
    ObservationSet                   set = exact;
    std::mt19937_64                  engine(seed);
    std::normal_distribution<double> normal;
    for (Observation &point : set.points)
      point.displacement_m += point.sigma_m * normal(engine);
    return set;
  }

  FreeParameter free_parameter(const FittedQuantity quantity, const double lower, const double upper,
                               const bool logarithmic)
  {
    FreeParameter free;
    free.quantity    = quantity;
    free.lower       = lower;
    free.upper       = upper;
    free.logarithmic = logarithmic;
    return free;
  }

  CalibrationProblem two_ratios()
  {
    CalibrationProblem problem;
    problem.free        = {free_parameter(FittedQuantity::young_modulus_over_viscosity, 3.7e4, 7e4),
                           free_parameter(FittedQuantity::magnetization_over_viscosity, 6.5e4, 1.15e5)};
    problem.model_error = 0.;
    problem.n_starts    = 8;
    return problem;
  }

  CalibrationProblem everything_free()
  {
    using enum FittedQuantity;
    CalibrationProblem problem;
    problem.free          = {free_parameter(young_modulus_over_viscosity, 1e4, 1e6), free_parameter(viscosity, 1., 2.),
                             free_parameter(magnetization, 5e4, 3e5, false),         free_parameter(field_scale, 0.5, 2.),
                             free_parameter(geometry_scale, 0.5, 2., false),         free_parameter(displacement_scale, 0.5, 2.),
                             free_parameter(displacement_offset, -1e-4, 1e-4, false)};
    problem.free[1].prior = GaussianPrior{1.5, 0.1};
    problem.free[6].prior = GaussianPrior{1e-6, 1e-5};
    return problem;
  }

  Eigen::VectorXd somewhere(const ParameterMap &map, const int n_components)
  {
    Eigen::VectorXd unknowns(map.size() + n_components);
    const double    values[] = {5.5e4, 1.45, 1.25e5, 1.04, 0.97, 1.02, 2e-6};
    for (int j = 0; j < map.size(); ++j)
      unknowns[j] = map.scaled(j, values[j]);
    unknowns.tail(n_components).setLinSpaced(-0.6, 0.8);
    return unknowns;
  }

  Setting::Setting(CalibrationProblem own_problem, std::vector<ObservationSet> own_sets)
      : problem(std::move(own_problem)), sets(std::move(own_sets)), data(calibration_data(sets)),
        map(problem, reference_swimmer().nominal, data.largest_m()),
        input{reference_swimmer(), reference_model(), problem, data, map, 2, {}}
  {
  }

  Eigen::VectorXd Setting::truth() const
  {
    Eigen::VectorXd x(map.size());
    for (int j = 0; j < map.size(); ++j)
      x[j] = map.scaled(j, value_of(map.free()[static_cast<std::size_t>(j)].quantity, known_swimmer()));
    return x;
  }

  std::shared_ptr<DisplacementTable> Setting::table(const double half_width) const
  {
    static std::map<std::pair<int, double>, std::shared_ptr<DisplacementTable>> made;
    auto                                                                       &table = made[{data.n(), half_width}];
    if (!table)
    {
      const Eigen::VectorXd centre = MotionGroups(reference_swimmer()).values(known_swimmer());
      std::string           failure;
      table = DisplacementTable::make(
          reference_swimmer(), data.conditions, {centre.array() - half_width, centre.array() + half_width},
          {.relative_tolerance = 1e-8, .interpolation_error = 1e-5, .n_threads = 2}, failure);
      EXPECT_EQ(failure, "");
    }
    return table->copy();
  }
} // namespace swimtwin
