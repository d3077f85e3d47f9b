#include <control/goal/goal_entries.h>
#include <control/goal/goal_file.h>
#include <datasets/system/error.h>
#include <datasets/text/text_decoding.h>
#include <datasets/text/toml_table.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    constexpr Range  at_least_one{1., infinity, false, false, "be at least 1"};
    constexpr Range  fraction{0., 1., false, true, "be at least 0 and below 1"};
    constexpr double degree = std::numbers::pi / 180.;

    constexpr std::array<std::pair<std::string_view, FieldFamily>, 3> families = {
        {{"general", FieldFamily::general},
         {"symmetric", FieldFamily::symmetric},
         {"sinusoid", FieldFamily::sinusoid}}};

    void read_objective(const TomlDocument &document, SwimmingGoal &goal)
    {
      TomlTable table(document, "objective");
      for (const StrokeTerm term : all_stroke_terms)
      {
        double weight = 0.;
        table.number(to_string(term), {"", not_negative}, weight);
        if (weight > 0.)
          goal.weights[term] = weight;
      }
      const double head_first_deg = goal.heading_rad / degree + 180.;
      double       direction_deg  = head_first_deg;
      table.number("direction_deg", {"degrees", any_number}, direction_deg);
      table.finish();
      goal.field.turn_rad = std::remainder(direction_deg - head_first_deg, 360.) * degree;
      if (goal.weights.empty())
        document.refuse("objective", "mean_speed",
                        "is missing, and so is every other term; give at least one a positive weight.");
    }

    void read_field(const TomlDocument &document, const ReducedModel &model, GoalFile &file)
    {
      TomlTable table(document, "field");
      table.integer("harmonics", {"", at_least_one}, file.goal.n_harmonics);
      table.choice("family", Need::optional, families, file.goal.family);
      file.goal.frequency_Hz = model.range.frequency_Hz;
      table.number("frequency_low_Hz", {"Hz", positive}, file.goal.frequency_Hz.low);
      table.number("frequency_high_Hz", {"Hz", positive}, file.goal.frequency_Hz.high);
      table.number("sample_rate_Hz", {"Hz", positive}, file.sample_rate_Hz);
      std::string program;
      table.text("program", program);
      file.program = program;
      table.number("period_s", {"s", positive}, file.program_period_s);
      table.finish();
      const Interval &f = file.goal.frequency_Hz;
      if (f.low > f.high)
        document.refuse("field", table.has("frequency_low_Hz") ? "frequency_low_Hz" : "frequency_high_Hz",
                        fmt::format("leaves no frequency: from {:.4g} to {:.4g} Hz (the model was trained from {:.4g} "
                                    "to {:.4g} Hz).",
                                    f.low, f.high, model.range.frequency_Hz.low, model.range.frequency_Hz.high));
    }

    void read_limits(const TomlDocument &document, SwimmingGoal &goal)
    {
      TomlTable    table(document, "limits");
      double       heading_deg = infinity;
      FieldLimits &field       = goal.field;
      read_field_limits(table, field);
      table.number("largest_multiplier", {"", positive}, goal.motion.largest_multiplier);
      table.number("heading_deviation_deg", {"degrees", positive}, heading_deg);
      table.number("tail_strain", {"", positive}, goal.motion.tail_strain);
      table.number("shape_radius", {"trained radii", positive}, goal.motion.shape_radius);
      table.finish();
      goal.motion.heading_deviation_rad = heading_deg * degree;
      if (!std::isfinite(largest_magnitude_T(field)))
        document.refuse("limits", "magnitude_T",
                        "is missing, and nothing else bounds the field; give it, or bx_T and by_T, or coil_1_A_T, "
                        "coil_2_A_T and coil_current_A.");
    }

    /// All of them, or only those without gradients.
    std::vector<std::string> methods_with_constraints(const bool gradients)
    {
      std::vector<std::string> names;
      for (const SearchMethod method : all_search_methods())
        if (takes_constraints(method) && (gradients || !uses_gradients(method)))
          names.push_back(to_string(method));
      return names;
    }

    void read_search(const TomlDocument &document, FieldPlanOptions &options)
    {
      TomlTable   table(document, "search");
      std::string method = to_string(options.search.search.method), without = to_string(options.gradient_free);
      int         seed = static_cast<int>(options.seed);
      table.word("method", Need::optional, methods_with_constraints(true), method);
      table.integer("starts", {"", not_negative}, options.n_starts);
      table.integer("max_evaluations", {"", at_least_one}, options.search.search.max_evaluations);
      table.integer("seed", {"", not_negative}, seed);
      table.word("gradient_free_method", Need::optional, methods_with_constraints(false), without);
      table.number("gradient_free_budget", {"", not_negative}, options.gradient_free_budget);
      table.finish();
      options.seed                 = static_cast<unsigned long>(seed);
      options.search.search.seed   = options.seed;
      options.search.search.method = search_method(method);
      options.gradient_free        = search_method(without);
    }

    void read_robust(const TomlDocument &document, const std::filesystem::path &folder, SwimmingGoal &goal)
    {
      TomlTable table(document, "robust");
      if (!table.present())
        return;
      std::string calibration;
      table.text("calibration", calibration);
      table.number("left_out", {"", fraction}, goal.robust.left_out);
      table.integer("members", {"", at_least_one}, goal.robust.n_members);
      table.finish();
      if (calibration.empty())
        document.refuse("robust", "calibration", "is missing; give the calibration.json whose sample to plan for.");
      goal.robust.calibration = folder / calibration;
    }

    SwimmingGoal goal_of(const ReducedModel &model)
    {
      const Scene  scene = parse_scene(model.scene_text, model.scene_name + ".toml");
      SwimmingGoal goal;
      goal.swimmer     = swimmer_parameters(scene);
      goal.heading_rad = scene.head.angle_rad;
      return goal;
    }
  } // namespace

  GoalFile read_goal(const std::filesystem::path &path, const ReducedModel &model)
  {
    GoalFile file;
    file.text = read_decoded_text(path, "the goal");
    file.goal = goal_of(model);
    const TomlDocument document(file.text, path.string(), {});
    TomlTable          root(document, "");
    for (const char *table : {"objective", "swimmer", "field", "limits", "search", "robust"})
      root.table(table);
    root.finish();
    read_objective(document, file.goal);
    read_swimmer(document, "swimmer", file.goal.swimmer);
    read_field(document, model, file);
    read_limits(document, file.goal);
    read_search(document, file.options);
    read_robust(document, path.parent_path(), file.goal);
    if (!file.program.empty())
      file.program = path.parent_path() / file.program;
    return file;
  }
} // namespace swimtwin
