// Fluid and tail fields for ParaView.
#pragma once

#include <fom/full_order_model.h>

#include <filesystem>

namespace swimtwin
{
  /// Writes fluid-NNNN.vtu (velocity_m_s, pressure_Pa) and tail-NNNN.vtu (displacement_m in the laboratory) with
  /// quadratic cells into a folder, and fluid.pvd, tail.pvd that name them with their times.
  class FieldOutput
  {
  public:
    explicit FieldOutput(std::filesystem::path folder);

    /// Collective; rank 0 writes. The fluid is left out where its velocities belong to a mesh that is gone.
    void write(const FullOrderModel<2> &model);

  private:
    void write_series(const std::string &name, std::vector<std::pair<double, std::string>> &series,
                      const std::string &file, double time);

    std::filesystem::path                       folder_;
    std::vector<std::pair<double, std::string>> fluid_series_, tail_series_;
    unsigned int                                n_written_ = 0;
  };
} // namespace swimtwin
