#include <twin/run/twin_rows.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    std::string cell(const double value)
    {
      return std::isfinite(value) ? fmt::format("{}", value) : "";
    }

    /// Of the head's position and angle; empty where they were not seen. The larger of two deviations.
    void add_innovations(const EstimateRecord &r, std::vector<std::string> &cells)
    {
      std::array<double, 5> values{};
      values.fill(std::nan(""));
      for (const Innovation &i : r.innovations)
        if (i.kind == head_position)
        {
          values[0] = i.residual[0];
          values[1] = i.residual[1];
          values[2] = std::max(i.standard_deviation[0], i.standard_deviation[1]);
        }
        else if (i.kind == head_angle)
        {
          values[3] = i.residual[0];
          values[4] = i.standard_deviation[0];
        }
      for (const double value : values)
        cells.push_back(cell(value));
    }
  } // namespace

  std::vector<TableColumn> estimate_columns(const TwinSession &session)
  {
    const SwimmerTwin       &twin    = session.twin();
    std::vector<TableColumn> columns = {{"time_s", {"s", "instant of the estimate, by the frames' stamps"}},
                                        {"x_m", {"m", "centre of the head"}},
                                        {"y_m", {"m", "centre of the head"}},
                                        {"angle_rad", {"rad", "of the head's axis, from the x axis"}},
                                        {"x_sd_m", {"m", "standard deviation of x_m"}},
                                        {"y_sd_m", {"m", "standard deviation of y_m"}},
                                        {"angle_sd_rad", {"rad", "standard deviation of angle_rad"}}};
    for (int i = 1; i <= twin.swimmer().n_modes(); ++i)
      columns.push_back({fmt::format("shape_{}_m", i), {"m", "amplitude of a mode of the tail's shape"}});
    const Belief nothing = Belief::independent(Eigen::VectorXd::Zero(twin.layout().n_states()),
                                               Eigen::VectorXd::Ones(twin.layout().n_states()));
    for (const NamedParameter &p : named_parameters(twin, nothing))
    {
      columns.push_back({p.name, {p.units, "parameter as estimated"}});
      columns.push_back({"sd_of_" + p.name, {p.units, "its standard deviation"}});
    }
    for (const TableColumn &column :
         std::initializer_list<TableColumn>{{"innovation_x_m", {"m", "position seen less expected"}},
                                            {"innovation_y_m", {"m", "position seen less expected"}},
                                            {"innovation_sd_m", {"m", "larger of the two deviations expected"}},
                                            {"innovation_angle_rad", {"rad", "angle seen less expected"}},
                                            {"innovation_angle_sd_rad", {"rad", "deviation expected"}},
                                            {"significance", {"1", "probability of innovations at least that far off"}},
                                            {"trust", {"1", "0 to 1: consistency, region and sight"}},
                                            {flags_column, {"", "alarms that are on"}},
                                            {"line", {"1", "of the input that led to the estimate; 0: none"}}})
      columns.push_back(column);
    return columns;
  }

  std::string header_of(const std::vector<TableColumn> &columns)
  {
    std::vector<std::string> names(columns.size());
    std::transform(columns.begin(), columns.end(), names.begin(),
                   [](const TableColumn &column) { return column.name; });
    return fmt::format("{}", fmt::join(names, ","));
  }

  std::string estimate_row(const TwinSession &session, const EstimateRecord &r)
  {
    const Belief            &b     = r.belief;
    std::vector<std::string> cells = {cell(r.time_s)};
    for (int i = 0; i < 3; ++i)
      cells.push_back(cell(b.mean[i]));
    for (int i = 0; i < 3; ++i)
      cells.push_back(cell(b.standard_deviation(i)));
    for (int i = 0; i < session.twin().swimmer().n_modes(); ++i)
      cells.push_back(cell(b.mean[3 + i]));
    for (const NamedParameter &p : named_parameters(session.twin(), b))
    {
      cells.push_back(cell(p.value));
      cells.push_back(cell(p.standard_deviation));
    }
    add_innovations(r, cells);
    return fmt::format("{},{},{},{},{}", fmt::join(cells, ","), cell(r.significance), cell(r.trust),
                       fmt::join(r.flags, ";"), r.line);
  }

  std::string decision_row(const PlayRecord &r)
  {
    const bool is_led             = r.phase == SteeringPhase::following || r.phase == SteeringPhase::arrived,
               is_seen            = is_led || r.phase == SteeringPhase::warming;
    const double          none    = std::nan("");
    const auto            seen    = [&](const double value) { return cell(is_seen ? value : none); };
    const auto            led     = [&](const double value) { return cell(is_led ? value : none); };
    const Eigen::Vector2d first_T = r.samples.front().field_T;
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", cell(r.decided_s), to_string(r.phase),
                       seen(r.mean_m.x()), seen(r.mean_m.y()), led(r.path_m.x()), led(r.path_m.y()), led(r.arc_m),
                       led((r.mean_m - r.path_m).norm()), led(r.doubt_m), cell(first_T.x()), cell(first_T.y()),
                       cell(r.took_s), r.is_late ? 0 : 1);
  }
} // namespace swimtwin
