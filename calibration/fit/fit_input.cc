#include <calibration/fit/fit_input.h>

namespace swimtwin
{
  void FitInput::show(const std::string &what, const double done) const
  {
    if (on_progress)
      on_progress(what, done);
  }

  GroupBox groups_within_bounds(const FitInput &input)
  {
    return input.map.group_box(MotionGroups(input.model), input.map.lower(), input.map.upper());
  }

  std::unique_ptr<ExactDisplacements> exact_displacements(const FitInput &input, const double relative_tolerance,
                                                          const int n_threads)
  {
    return std::make_unique<ExactDisplacements>(
        input.model, input.data.conditions,
        ExactOptions{.relative_tolerance = relative_tolerance, .n_threads = n_threads, .by = input.map.needed()});
  }

  std::shared_ptr<DisplacementTable> tabulated_displacements(const FitInput &input, const GroupBox &box,
                                                             const TableOptions &options, long &n_runs)
  {
    std::string failure;
    auto        table = DisplacementTable::make(input.model, input.data.conditions, box, options, failure);
    if (table)
      n_runs += table->n_runs();
    return table;
  }
} // namespace swimtwin
