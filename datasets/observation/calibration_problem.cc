#include <datasets/observation/calibration_problem.h>
#include <datasets/system/error.h>
#include <datasets/system/nearest_name.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  namespace
  {
    struct Entry
    {
      FittedQuantity quantity;
      const char    *key, *unit;
      bool           positive = true;
    };

    const std::vector<Entry> &entries()
    {
      using enum FittedQuantity;
      static const std::vector<Entry> list = {
          {young_modulus_over_viscosity, "young_modulus_over_viscosity_1_s", "1/s"},
          {magnetization_over_viscosity, "magnetization_over_viscosity_A_m_Pa_s", "A/(m Pa s)"},
          {young_modulus, "young_modulus_Pa", "Pa"},
          {viscosity, "viscosity_Pa_s", "Pa s"},
          {magnetization, "magnetization_A_m", "A/m"},
          {field_scale, "field_scale", ""},
          {geometry_scale, "geometry_scale", ""},
          {displacement_scale, "displacement_scale", ""},
          {displacement_offset, "displacement_offset_m", "m", false},
          {noise_scale, "noise_scale", ""}};
      return list;
    }

    using LossName = std::pair<std::string_view, LossKind>;
    constexpr std::array<LossName, 4>                          loss_names{{{"least-squares", LossKind::least_squares},
                                                                           {"huber", LossKind::huber},
                                                                           {"pseudo-huber", LossKind::pseudo_huber},
                                                                           {"cauchy", LossKind::cauchy}}};
    constexpr std::array<std::pair<std::string_view, bool>, 2> scale_names{{{"log", true}, {"linear", false}}};

    constexpr Range level_range{0.5, 1., false, true, "be at least 0.5 and less than 1"};
    constexpr Range error_range{0., 0.5, false, false, "lie between 0 and 0.5"};

    /// One [parameters.KEY], whether it is free or given.
    class ParameterReader
    {
    public:
      ParameterReader(const TomlDocument &document, const Entry &entry)
          : document_(document), entry_(entry), path_(fmt::format("parameters.{}", entry.key))
      {
      }

      void read(CalibrationProblem &problem)
      {
        TomlTable        table(document_, path_);
        const NumberRule number{entry_.unit, entry_.positive ? positive : any_number};
        FreeParameter    free;
        free.quantity    = entry_.quantity;
        free.logarithmic = entry_.positive;
        std::array<double, 2> bounds{};
        std::optional<double> value, mean, deviation;
        table.number("value", number, value);
        table.pair("bounds", {entry_.unit}, bounds);
        table.choice("scale", Need::optional, scale_names, free.logarithmic);
        table.number("start", number, free.start);
        table.number("prior_mean", number, mean);
        table.number("prior_standard_deviation", {entry_.unit, positive}, deviation);
        table.finish();
        if (value.has_value() == table.has("bounds"))
          refuse("", "needs either bounds = [low, high], which makes it free, or value = number, which fixes it.");
        if (value)
          return give(*value, table, problem);
        std::tie(free.lower, free.upper) = std::pair(bounds[0], bounds[1]);
        add_prior(mean, deviation, free);
        check(free);
        problem.free.push_back(free);
      }

    private:
      [[noreturn]] void refuse(const char *key, const std::string &rule) const { document_.refuse(path_, key, rule); }

      void give(const double value, const TomlTable &table, CalibrationProblem &problem) const
      {
        for (const char *key : {"scale", "start", "prior_mean", "prior_standard_deviation"})
          if (table.has(key))
            refuse(key, "says how to fit what value = ... fixes; leave one of them out.");
        if (entry_.quantity == FittedQuantity::noise_scale && value != 1.)
          refuse("value", "scales the stated sigma without the data having said so; change sigma_m in the data, or "
                          "give bounds to have it fitted.");
        problem.given.push_back({entry_.quantity, value});
      }

      void add_prior(const std::optional<double> &mean, const std::optional<double> &deviation,
                     FreeParameter &free) const
      {
        if (mean.has_value() != deviation.has_value())
          refuse(mean ? "prior_mean" : "prior_standard_deviation",
                 "is half a prior; give both prior_mean and prior_standard_deviation.");
        if (mean)
          free.prior = GaussianPrior{*mean, *deviation};
      }

      void check(const FreeParameter &free) const
      {
        if (!(free.lower < free.upper))
          refuse("bounds", "leave nothing between them; give [low, high] with low < high.");
        if (free.logarithmic && !entry_.positive)
          refuse("scale", "cannot be: this entry may be negative; use \"linear\".");
        if (entry_.positive && free.lower <= 0.)
          refuse("bounds", fmt::format("reach down to {}, and only positive values are possible; raise the lower one.",
                                       free.lower));
        if (free.start && (*free.start < free.lower || *free.start > free.upper))
          refuse("start", fmt::format("lies outside the bounds [{}, {}]; move one of them.", free.lower, free.upper));
        if (entry_.quantity == FittedQuantity::noise_scale && (free.start || free.prior))
          refuse(free.start ? "start" : "prior_mean", "has no meaning: the noise level follows from the residuals; "
                                                      "leave it out.");
      }

      const TomlDocument &document_;
      const Entry        &entry_;
      std::string         path_;
    };

    std::string line_of(const TomlDocument &document, const FittedQuantity quantity)
    {
      return document.where(fmt::format("parameters.{}", key_of(quantity)));
    }

    bool is_named(const CalibrationProblem &problem, const FittedQuantity quantity)
    {
      const auto same = [quantity](const auto &parameter) { return parameter.quantity == quantity; };
      return std::any_of(problem.free.begin(), problem.free.end(), same) ||
             std::any_of(problem.given.begin(), problem.given.end(), same);
    }

    /// A ratio and what it is made of cannot both be said.
    void check_ratios(const TomlDocument &document, const CalibrationProblem &problem)
    {
      using enum FittedQuantity;
      for (const auto &[ratio, part] : {std::pair(young_modulus_over_viscosity, young_modulus),
                                        std::pair(magnetization_over_viscosity, magnetization)})
        if (is_named(problem, ratio) && is_named(problem, part))
          throw InputError(fmt::format("{}: {} follows from {} and the viscosity; leave one of the two out.",
                                       line_of(document, part), key_of(part), key_of(ratio)));
    }

    void read_parameters(const TomlDocument &document, CalibrationProblem &problem)
    {
      TomlTable table(document, "parameters");
      for (const Entry &entry : entries())
        table.table(entry.key);
      table.finish();
      for (const Entry &entry : entries())
        if (table.has(entry.key))
          ParameterReader(document, entry).read(problem);
      check_ratios(document, problem);
      const auto is_swimmers = [](const FreeParameter &p) { return p.quantity != FittedQuantity::noise_scale; };
      if (std::none_of(problem.free.begin(), problem.free.end(), is_swimmers))
        throw InputError(fmt::format("{}: nothing is free; give at least one [parameters.KEY] with bounds, such as "
                                     "[parameters.young_modulus_over_viscosity_1_s].",
                                     document.where("parameters")));
    }

    void read_data(const TomlDocument &document, const std::filesystem::path &folder, CalibrationProblem &problem)
    {
      const toml::node *node = document.find("data");
      if (node == nullptr)
        return;
      if (node->is_string())
        return problem.data.push_back(folder / *node->value<std::string>());
      const toml::array *list = node->as_array();
      if (list == nullptr || !list->is_homogeneous(toml::node_type::string))
        document.refuse("", "data", "has the wrong type; a list of files [\"a.csv\", \"b.csv\"] is needed.");
      for (const toml::node &file : *list)
        problem.data.push_back(folder / *file.value<std::string>());
    }

    void read_loss(const TomlDocument &document, CalibrationProblem &problem)
    {
      TomlTable table(document, "loss");
      table.choice("kind", Need::optional, loss_names, problem.loss);
      table.number("width_sigmas", {"sigma", positive}, problem.loss_width);
      table.finish();
    }

    void read_fit(const TomlDocument &document, CalibrationProblem &problem)
    {
      TomlTable table(document, "fit");
      table.integer("starts", {"", at_least_one}, problem.n_starts);
      table.integer("seed", {"", not_negative}, problem.seed);
      table.integer("max_evaluations", {"", at_least_one}, problem.max_evaluations);
      table.word("method", Need::optional, calibration_methods(), problem.method);
      table.flag("allow_untrained", problem.allow_untrained);
      table.finish();
    }

    void read_uncertainty(const TomlDocument &document, CalibrationProblem &problem)
    {
      TomlTable table(document, "uncertainty");
      table.number("level", {"", level_range}, problem.level);
      table.flag("profiles", problem.profiles);
      table.integer("bootstrap_samples", {"", not_negative}, problem.n_bootstrap_samples);
      table.number("model_error", {"", error_range}, problem.model_error);
      table.finish();
    }

    void read_next(const TomlDocument &document, CalibrationProblem &problem)
    {
      TomlTable table(document, "next");
      table.text("parameter", problem.next_parameter);
      table.number("lowest_frequency_Hz", {"Hz", positive}, problem.lowest_frequency_Hz);
      table.number("highest_frequency_Hz", {"Hz", positive}, problem.highest_frequency_Hz);
      table.finish();
      if (problem.lowest_frequency_Hz && problem.highest_frequency_Hz &&
          *problem.lowest_frequency_Hz >= *problem.highest_frequency_Hz)
        document.refuse("next", "lowest_frequency_Hz", "is not below highest_frequency_Hz; swap or move them.");
      std::vector<std::string> names;
      for (const FreeParameter &free : problem.free)
        if (free.quantity != FittedQuantity::noise_scale)
          names.push_back(key_of(free.quantity));
      const std::string &name = problem.next_parameter;
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
        document.refuse("next", "parameter",
                        fmt::format("is not a free parameter; the nearest is {} (one of {}).",
                                    nearest_name(name, names), fmt::join(names, ", ")));
    }
  } // namespace

  const std::vector<std::string> &calibration_methods()
  {
    static const std::vector<std::string> names = {"lbfgs",  "mma",   "ccsaq",       "slsqp", "cobyla",
                                                   "bobyqa", "sbplx", "nelder-mead", "isres"};
    return names;
  }

  std::string key_of(const FittedQuantity quantity)
  {
    return std::find_if(entries().begin(), entries().end(), [&](const Entry &e) { return e.quantity == quantity; })
        ->key;
  }

  const std::vector<FittedQuantity> &all_fitted_quantities()
  {
    static const std::vector<FittedQuantity> all = [] {
      std::vector<FittedQuantity> list;
      for (const Entry &entry : entries())
        list.push_back(entry.quantity);
      return list;
    }();
    return all;
  }

  std::string to_string(const LossKind kind)
  {
    return std::string(
        std::find_if(loss_names.begin(), loss_names.end(), [&](const LossName &n) { return n.second == kind; })->first);
  }

  CalibrationProblem parse_calibration_problem(const std::string_view text, const std::string &name,
                                               const std::filesystem::path &folder)
  {
    const TomlDocument document(text, name, {});
    TomlTable          top(document, "");
    for (const char *known : {"data", "parameters", "loss", "fit", "uncertainty", "next"})
      top.table(known);
    top.finish();
    CalibrationProblem problem;
    problem.text = text;
    read_data(document, folder, problem);
    read_parameters(document, problem);
    read_loss(document, problem);
    read_fit(document, problem);
    read_uncertainty(document, problem);
    read_next(document, problem);
    return problem;
  }

  CalibrationProblem read_calibration_problem(const std::filesystem::path &file)
  {
    return parse_calibration_problem(read_decoded_text(file, "the problem"), file.string(), file.parent_path());
  }
} // namespace swimtwin
