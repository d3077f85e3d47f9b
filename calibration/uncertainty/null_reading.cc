#include <calibration/uncertainty/null_reading.h>

#include <rom/swimmer/dense_algebra.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using Weights = std::vector<std::pair<FittedQuantity, double>>;

    struct KnownDirection
    {
      Weights     weights; ///< changes of logarithms that leave every recorded displacement as it is
      const char *reading;
    };

    const std::vector<KnownDirection> &known_directions()
    {
      using enum FittedQuantity;
      static const std::vector<KnownDirection> list = {
          {{{young_modulus, 1.}, {viscosity, 1.}, {magnetization, 1.}},
           "E, mu and M scale together: without inertia only E/mu and M/mu matter; fix one of them, or fit E/mu and "
           "M/mu"},
          {{{young_modulus, 1.}, {viscosity, 1.}, {field_scale, 1.}},
           "E, mu and the field's scale go together: without inertia only their ratios matter; fix one of them, or fit "
           "E/mu"},
          {{{viscosity, 1.}},
           "the viscosity alone changes nothing once E/mu and M/mu are given; fix it: displacements cannot measure it"},
          {{{young_modulus, 1.}, {viscosity, 1.}},
           "E and mu go together when M/mu is given: only E/mu matters; fix one of them, or fit E/mu"},
          {{{magnetization, 1.}, {viscosity, 1.}},
           "M and mu go together when E/mu is given: only M/mu matters; fix one of them, or fit M/mu"},
          {{{field_scale, 1.}, {magnetization, -1.}},
           "the field's scale and M act by their product alone; fix one of them (a Hall probe measures the field)"},
          {{{field_scale, 1.}, {magnetization_over_viscosity, -1.}},
           "the field's scale and M/mu act by their product alone; fix one of them (a Hall probe measures the field)"},
          {{{field_scale, 1.}, {young_modulus_over_viscosity, 0.}, {viscosity, 1.}},
           "the viscosity and the field's scale go together when E/mu is given; fix one of them"},
          {{{geometry_scale, 1.}, {displacement_scale, -1.}},
           "a larger swimmer swims farther in proportion, which the displacements' scale does as well; fix one of them "
           "(a picture measures the swimmer's length)"}};
      return list;
    }

    /// In scaled variables, of unit length; nothing if a parameter it needs is not free.
    std::optional<Eigen::VectorXd> scaled_direction(const KnownDirection &known, const FitInput &input,
                                                    const Eigen::VectorXd &x)
    {
      Eigen::VectorXd direction = Eigen::VectorXd::Zero(input.map.size());
      for (const auto &[quantity, weight] : known.weights)
      {
        const auto &free = input.map.free();
        const auto  found =
            std::find_if(free.begin(), free.end(), [q = quantity](const FreeParameter &f) { return f.quantity == q; });
        if (found == free.end())
          return std::nullopt;
        const int j  = static_cast<int>(found - free.begin());
        direction[j] = weight * input.map.value(j, x[j]) / input.map.value_slope(j, x[j]);
      }
      return direction.normalized();
    }

    std::string plain_reading(const FitInput &input, const Eigen::VectorXd &direction)
    {
      std::vector<std::string> parts;
      const auto               names = input.map.names();
      for (Eigen::Index j = 0; j < direction.size(); ++j)
        if (std::abs(direction[j]) > 1e-4)
          parts.push_back(fmt::format("{} by {:+.3g}", names[static_cast<std::size_t>(j)], direction[j]));
      return fmt::format("the data do not see a change of {}; fix one of them, give it a prior, or observe at other "
                         "frequencies and fields",
                         fmt::join(parts, " with "));
    }

    double strength_along(const Information &information, const Eigen::VectorXd &direction)
    {
      return (information.whitened * direction).norm() / information.singular_values[0];
    }

    bool prior_decides(const Information &information, const Eigen::VectorXd &direction)
    {
      return (information.undecided.transpose() * direction).norm() < 1e-4;
    }
  } // namespace

  std::vector<NullDirection> null_directions(const FitInput &input, const Estimate &estimate)
  {
    constexpr double           found_within = 1e-3; // of a known direction: its part outside the null space
    const Information         &information  = estimate.information;
    Eigen::MatrixXd            rest         = information.null_directions; // what is not explained yet
    std::vector<NullDirection> list;
    const auto                 add = [&](const Eigen::VectorXd &direction, const std::string &reading) {
      list.push_back(
                          {direction, strength_along(information, direction), prior_decides(information, direction), reading});
    };
    const auto remove = [&rest](const Eigen::VectorXd &direction) {
      const Eigen::VectorXd inside = rest.transpose() * direction;
      rest                         = rest * orthogonal_complement(inside);
    };
    for (const KnownDirection &known : known_directions())
      if (const auto direction = scaled_direction(known, input, estimate.x()); direction && rest.cols() > 0)
      {
        const Eigen::MatrixXd &N    = information.null_directions;
        const Eigen::VectorXd  seen = N * (N.transpose() * *direction);
        if ((*direction - seen).norm() > found_within || (rest.transpose() * *direction).norm() < 0.1)
          continue;
        add(seen.normalized(), known.reading);
        remove(seen);
      }
    for (Eigen::Index c = 0; c < rest.cols(); ++c)
      add(rest.col(c), plain_reading(input, rest.col(c)));
    return list;
  }
} // namespace swimtwin
