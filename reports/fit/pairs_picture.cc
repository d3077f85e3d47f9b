#include <reports/fit/pairs_picture.h>

#include <reports/fit/calibration_scripts.h>
#include <reports/fit/parameter_axis.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    /// A free parameter, its samples (one column of the bootstrap) and its axis, in the shown unit.
    struct ShownParameter
    {
      CalibratedParameter parameter;
      ShownQuantity       quantity;
      Eigen::VectorXd     samples;
      Span                span;
      Eigen::Index        column      = 0;
      double              estimate    = 0.;
      double              linear_unit = 1.; ///< of the scaled variable, for a parameter that is not positive

      /// Where a step of the scaled variable leads.
      double moved(const double step) const
      {
        return parameter.logarithmic ? estimate * std::exp(step) : estimate + linear_unit * step;
      }
    };

    ShownParameter shown_parameter(const CalibrationResult &result, const CalibratedParameter &parameter,
                                   const Eigen::Index column)
    {
      ShownParameter shown{parameter, shown_quantity(parameter.name, parameter.value), {}, {}, column};
      shown.samples  = shown.quantity.factor * result.bootstrap.col(column);
      shown.estimate = shown.quantity.factor * parameter.value;
      if (parameter.standard_error && column < result.covariance.rows())
        shown.linear_unit =
            shown.quantity.factor * *parameter.standard_error / std::sqrt(result.covariance(column, column));
      shown.span = {shown.estimate, shown.estimate};
      for (const double value : shown.samples)
        shown.span.include(value);
      shown.span = widened(shown.span, 0.05);
      return shown;
    }

    /// The parameters that the columns of the bootstrap stand for (the noise level is free, but not one of them) and
    /// that the data decide: estimates of the others scatter only across what the data cannot see.
    std::vector<ShownParameter> sampled_parameters(const CalibrationResult &result)
    {
      std::vector<ShownParameter> shown;
      Eigen::Index                column = 0;
      for (const CalibratedParameter &parameter : result.parameters)
        if (parameter.role == ParameterRole::free && parameter.name != "noise_scale" &&
            column < result.bootstrap.cols())
        {
          if (!parameter.undetermined)
            shown.push_back(shown_parameter(result, parameter, column));
          ++column;
        }
      return shown;
    }

    /// Where there is little room.
    std::string short_label(const ShownQuantity &quantity)
    {
      constexpr std::string_view word  = "displacement";
      std::string                label = quantity.label();
      return label.starts_with(word) ? "displ." + label.substr(word.size()) : label;
    }

    void add_samples(GnuplotPicture &picture, const std::vector<ShownParameter> &parameters)
    {
      picture.table.begin_block("bootstrap estimates, one column per parameter");
      for (Eigen::Index i = 0; i < parameters.front().samples.size(); ++i)
      {
        std::vector<double> row;
        for (const ShownParameter &parameter : parameters)
          row.push_back(parameter.samples[i]);
        picture.table.add_row(row);
      }
    }

    void add_histogram(GnuplotPicture &picture, const Eigen::VectorXd &values, const Span &span)
    {
      const int        n_bins = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(values.size()))), 8, 30);
      const double     width  = (span.high - span.low) / n_bins;
      std::vector<int> counts(static_cast<std::size_t>(n_bins));
      for (const double value : values)
        if (std::isfinite(value))
          ++counts[static_cast<std::size_t>(std::clamp(static_cast<int>((value - span.low) / width), 0, n_bins - 1))];
      picture.table.begin_block("histogram: middle, count");
      for (int i = 0; i < n_bins; ++i)
        picture.table.add_row({span.low + (i + 0.5) * width, static_cast<double>(counts[static_cast<std::size_t>(i)])});
    }

    /// In scaled variables the region of level p is an ellipse with squared radius -2 ln(1 - p).
    void add_ellipse(GnuplotPicture &picture, const CalibrationResult &result, const ShownParameter &a,
                     const ShownParameter &b)
    {
      picture.table.begin_block("ellipse of the curvature");
      const std::array<Eigen::Index, 2> pair{a.column, b.column};
      Eigen::Matrix2d                   covariance = Eigen::Matrix2d::Constant(std::nan(""));
      if (result.covariance.rows() > pair[1])
        covariance = result.covariance(pair, pair);
      const Eigen::LLT<Eigen::Matrix2d> factor(covariance);
      if (!covariance.allFinite() || factor.info() != Eigen::Success)
        return picture.table.add_row({std::nan(""), std::nan("")});
      const Eigen::Matrix2d lower    = std::sqrt(-2. * std::log(1. - result.level)) * Eigen::Matrix2d(factor.matrixL());
      constexpr int         n_points = 120;
      for (int i = 0; i <= n_points; ++i)
      {
        const double          angle = 2. * std::numbers::pi * i / n_points;
        const Eigen::Vector2d step  = lower * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        picture.table.add_row({a.moved(step[0]), b.moved(step[1])});
      }
    }
  } // namespace

  bool has_pairs(const CalibrationResult &result)
  {
    return result.bootstrap.rows() > 1 && sampled_parameters(result).size() > 1;
  }

  GnuplotPicture pairs_picture(const CalibrationResult &result)
  {
    GnuplotPicture picture =
        titled_picture("pairs", calibration_scripts::pairs, "Estimates from repeated data",
                       fmt::format("{} bootstrap samples; orange: the estimate and the {} region of the curvature",
                                   result.bootstrap.rows(), level_text(result.level)));
    const std::vector<ShownParameter> parameters = sampled_parameters(result);
    const std::size_t                 n          = parameters.size();
    picture.set("n_parameters", static_cast<double>(n));
    for (std::size_t k = 0; k < n; ++k)
    {
      set_parameter_axis(picture, k, parameters[k].quantity, parameters[k].span, n > 3 ? 3. : 5.);
      picture.set_text(fmt::format("short_{}", k), short_label(parameters[k].quantity));
      picture.set(fmt::format("estimate_{}", k), parameters[k].estimate);
    }
    add_samples(picture, parameters);
    for (const ShownParameter &parameter : parameters)
      add_histogram(picture, parameter.samples, parameter.span);
    for (std::size_t b = 1; b < n; ++b)
      for (std::size_t a = 0; a < b; ++a)
        add_ellipse(picture, result, parameters[a], parameters[b]);
    return picture;
  }
} // namespace swimtwin
