#include <datasets/run/work_balance.h>
#include <datasets/system/error.h>
#include <datasets/text/csv_table.h>
#include <datasets/text/csv_writer.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <variant>

namespace swimtwin
{
  namespace
  {
    struct Column
    {
      const char                                                                        *name;
      std::variant<double TrajectoryRow::*, int TrajectoryRow::*, bool TrajectoryRow::*> member;
      enum class Place {
        everywhere,
        everywhere_now,   ///< may be missing in tables of earlier versions
        where_stabilized, ///< written if a row has it
        in_space,
        out_of_plane ///< in space, where motions leave the plane of x and y
      } place = Place::everywhere;
    };
    constexpr auto everywhere_now = Column::Place::everywhere_now, where_stabilized = Column::Place::where_stabilized,
                   in_space = Column::Place::in_space, out_of_plane = Column::Place::out_of_plane;

    const std::array<Column, 39> columns{{
        {"time_s", &TrajectoryRow::time_s},
        {"head_x_m", &TrajectoryRow::head_x_m},
        {"head_y_m", &TrajectoryRow::head_y_m},
        {"head_angle_rad", &TrajectoryRow::head_angle_rad},
        {"tail_tip_x_m", &TrajectoryRow::tail_tip_x_m},
        {"tail_tip_y_m", &TrajectoryRow::tail_tip_y_m},
        {"tail_angle_rad", &TrajectoryRow::tail_angle_rad},
        {"bx_T", &TrajectoryRow::bx_T},
        {"by_T", &TrajectoryRow::by_T},
        {"magnetic_power_W_m", &TrajectoryRow::magnetic_power_W_m},
        {"external_power_W_m", &TrajectoryRow::external_power_W_m},
        {"dissipation_W_m", &TrajectoryRow::dissipation_W_m},
        {"elastic_energy_J_m", &TrajectoryRow::elastic_energy_J_m},
        {"kinetic_energy_J_m", &TrajectoryRow::kinetic_energy_J_m, everywhere_now},
        {"kinetic_outflow_W_m", &TrajectoryRow::kinetic_outflow_W_m, everywhere_now},
        {"kinetic_growth_W_m", &TrajectoryRow::kinetic_growth_W_m, everywhere_now},
        {"stabilization_W_m", &TrajectoryRow::stabilization_W_m, where_stabilized},
        {"head_force_x_N_m", &TrajectoryRow::head_force_x_N_m},
        {"head_force_y_N_m", &TrajectoryRow::head_force_y_N_m},
        {"head_torque_N", &TrajectoryRow::head_torque_N},
        {"fluid_force_x_N_m", &TrajectoryRow::fluid_force_x_N_m, everywhere_now},
        {"fluid_force_y_N_m", &TrajectoryRow::fluid_force_y_N_m, everywhere_now},
        {"fluid_torque_N", &TrajectoryRow::fluid_torque_N, everywhere_now},
        {"coupling_iterations", &TrajectoryRow::coupling_iterations},
        {"n_unknowns", &TrajectoryRow::n_unknowns},
        {"remeshed", &TrajectoryRow::remeshed},
        {"head_z_m", &TrajectoryRow::head_z_m, in_space},
        {"tail_tip_z_m", &TrajectoryRow::tail_tip_z_m, in_space},
        {"head_qw", &TrajectoryRow::head_qw, in_space},
        {"head_qx", &TrajectoryRow::head_qx, in_space},
        {"head_qy", &TrajectoryRow::head_qy, in_space},
        {"head_qz", &TrajectoryRow::head_qz, in_space},
        {"bz_T", &TrajectoryRow::bz_T, out_of_plane},
        {"head_force_z_N", &TrajectoryRow::head_force_z_N, out_of_plane},
        {"head_torque_x_N_m", &TrajectoryRow::head_torque_x_N_m, out_of_plane},
        {"head_torque_y_N_m", &TrajectoryRow::head_torque_y_N_m, out_of_plane},
        {"fluid_force_z_N", &TrajectoryRow::fluid_force_z_N, out_of_plane},
        {"fluid_torque_x_N_m", &TrajectoryRow::fluid_torque_x_N_m, out_of_plane},
        {"fluid_torque_y_N_m", &TrajectoryRow::fluid_torque_y_N_m, out_of_plane},
    }};

    bool is_spatial(const Column &column)
    {
      return column.place == in_space || column.place == out_of_plane;
    }

    bool leaves_plane(const Trajectory &trajectory)
    {
      constexpr double round_off = 1e-8; // of the motion in the plane
      double           along = 0., across = 0.;
      for (const TrajectoryRow &row : trajectory)
      {
        along  = std::max({along, std::abs(row.tail_tip_x_m), std::abs(row.tail_tip_y_m), std::abs(row.head_x_m)});
        across = std::max({across, std::abs(row.tail_tip_z_m), std::abs(row.head_z_m)});
      }
      return across > round_off * along ||
             std::any_of(trajectory.begin(), trajectory.end(), [](const TrajectoryRow &row) { return row.bz_T != 0.; });
    }

    bool is_stabilized(const Trajectory &trajectory)
    {
      return std::any_of(trajectory.begin(), trajectory.end(),
                         [](const TrajectoryRow &row) { return row.stabilization_W_m != 0.; });
    }

    /// The name of a column in three dimensions: forces, powers and energies are whole, not per depth.
    std::string name_in_space(const Column &column)
    {
      const std::string name = column.name;
      if (is_spatial(column))
        return name;
      if (name.ends_with("torque_N"))
        return name + "_m";
      for (const char *unit : {"_W_m", "_J_m", "_N_m"})
        if (name.ends_with(unit))
          return name.substr(0, name.size() - 2);
      return name;
    }

    double value_of(const TrajectoryRow &row, const Column &column)
    {
      return std::visit([&](const auto member) { return static_cast<double>(row.*member); }, column.member);
    }

    void set_value(TrajectoryRow &row, const Column &column, const double value)
    {
      std::visit(
          [&](const auto member) {
            using Type = std::remove_reference_t<decltype(row.*member)>;
            if constexpr (std::is_same_v<Type, bool>)
              row.*member = value != 0.;
            else
              row.*member = static_cast<Type>(value);
          },
          column.member);
    }

    void require_finite_numbers(const std::filesystem::path &file, const Trajectory &trajectory)
    {
      for (const TrajectoryRow &row : trajectory)
        for (const Column &column : columns)
          if (!std::isfinite(value_of(row, column)))
            throw ComputationError(fmt::format("cannot write {}: {} at time {} s is not a finite number", file.string(),
                                               column.name, row.time_s));
    }
  } // namespace

  std::vector<double> numbers_of(const TrajectoryRow &row)
  {
    std::vector<double> numbers;
    for (const Column &column : columns)
      numbers.push_back(value_of(row, column));
    return numbers;
  }

  TrajectoryRow row_of(const std::vector<double> &numbers)
  {
    TrajectoryRow row;
    for (std::size_t i = 0; i < columns.size(); ++i)
      set_value(row, columns[i], numbers.at(i));
    return row;
  }

  std::vector<std::size_t> period_borders(const Trajectory &trajectory, const double period_s)
  {
    constexpr double         tolerance = 1e-9;
    std::vector<std::size_t> borders;
    for (std::size_t i = 0; i < trajectory.size(); ++i)
    {
      const double periods = (trajectory[i].time_s - trajectory.front().time_s) / period_s;
      const double next    = static_cast<double>(borders.size());
      if (std::abs(periods - next) <= tolerance * std::max(1., next))
        borders.push_back(i);
      else if (periods > next)
        throw InputError(
            fmt::format("the trajectory has no row at the end of period {} ({} s)", borders.size(), next * period_s));
    }
    return borders;
  }

  void summarize_motion(const Trajectory &trajectory, const double period_s, const double initial_angle_rad,
                        const std::vector<WorkBalance> &periods, RunSummary &summary)
  {
    const double                   dx = -std::cos(initial_angle_rad), dy = -std::sin(initial_angle_rad);
    const std::vector<std::size_t> borders = period_borders(trajectory, period_s);
    summary.displacement_per_period_m.clear();
    for (std::size_t k = 1; k < borders.size(); ++k)
    {
      const TrajectoryRow &start = trajectory[borders[k - 1]], &end = trajectory[borders[k]];
      summary.displacement_per_period_m.push_back(dx * (end.head_x_m - start.head_x_m) +
                                                  dy * (end.head_y_m - start.head_y_m));
    }
    summary.net_displacement_m = summary.power_imbalance = summary.worst_power_imbalance = std::nullopt;
    summary.work_of_last_period                                                          = std::nullopt;
    if (periods.empty())
      return;
    summary.net_displacement_m  = summary.displacement_per_period_m.back();
    summary.work_of_last_period = periods.back();
    summary.power_imbalance     = periods.back().imbalance();
    if (const auto worst = worst_period(periods))
      summary.worst_power_imbalance = periods[*worst].imbalance();
  }

  void summarize_motion(const Trajectory &trajectory, const double period_s, const double initial_angle_rad,
                        RunSummary &summary)
  {
    summarize_motion(trajectory, period_s, initial_angle_rad, work_balance_per_period(trajectory, period_s), summary);
  }

  void write_trajectory_csv(const std::filesystem::path &file, const Trajectory &trajectory, const int dimension)
  {
    require_finite_numbers(file, trajectory);
    std::vector<CsvColumn<TrajectoryRow>> cells;
    const bool is_planar = !leaves_plane(trajectory), has_stabilization = is_stabilized(trajectory);
    for (const Column &column : columns)
      if (!(dimension == 2 && is_spatial(column)) && !(is_planar && column.place == out_of_plane) &&
          (has_stabilization || column.place != where_stabilized))
        cells.push_back({dimension == 3 ? name_in_space(column) : column.name,
                         [&column](const TrajectoryRow &row) { return value_of(row, column); }});
    csv_table(cells, trajectory).save(file);
  }

  Trajectory read_trajectory_csv(const std::filesystem::path &file)
  {
    const CsvTable table = CsvTable::read(file);
    Trajectory     trajectory(table.n_rows());
    for (const Column &column : columns)
    {
      const std::string whole    = name_in_space(column);
      const bool        is_whole = !table.has_column(column.name) && table.has_column(whole);
      if (column.place != Column::Place::everywhere && !is_whole && !table.has_column(column.name))
        continue;
      const std::vector<double> values = table.column(is_whole ? whole : column.name);
      for (std::size_t i = 0; i < values.size(); ++i)
        set_value(trajectory[i], column, values[i]);
    }
    return trajectory;
  }
} // namespace swimtwin
