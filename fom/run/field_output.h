// Fluid and tail fields for ParaView.
#pragma once

#include <fom/step/full_order_model.h>

#include <filesystem>

namespace swimtwin
{
  /// What there is to see at one instant. All but the swimmer's own may be missing.
  template <int dim>
  struct FieldInstant
  {
    double                    time_s = 0.;
    const Swimmer<dim>       &swimmer;
    const Configuration<dim> &configuration;
    const Rates<dim>         &rates;
    const FluidDomain<dim>   *fluid        = nullptr;
    std::vector<double>       fluid_values = {}; ///< of the fluid's rows; empty: the fluid is left out
  };

  /// The model's present instant. Without the fluid at the start, before anything was solved.
  template <int dim>
  FieldInstant<dim> instant_of(const FullOrderModel<dim> &model);

  /// Writes fluid-NNNN.vtu (velocity_m_s, pressure_Pa) and tail-NNNN.vtu (displacement_m in the laboratory) with
  /// quadratic cells into a folder, and fluid.pvd, tail.pvd that name them with their times. In space also
  /// body-NNNN.vtu, body.pvd (the surface of head and tail) and view.py, which shows all of it in ParaView.
  class FieldOutput
  {
  public:
    explicit FieldOutput(std::filesystem::path folder);

    /// Instant number `index`; one rank can do it without the others.
    template <int dim>
    void write(const FieldInstant<dim> &instant, unsigned int index);

    /// After a resume: the instants before `n_instants`, `interval_s` apart, are there already; what an interrupted run
    /// wrote after them is removed.
    void adopt(unsigned int n_instants, double interval_s);

  private:
    using Series = std::vector<std::pair<double, std::string>>; // times and files

    void write_body(const FieldInstant<3> &instant, const std::string &number);
    /// `name`.pvd.
    void write_list(const std::string &name, const Series &series) const;

    std::filesystem::path folder_;
    Series                fluid_series_, tail_series_, body_series_;
  };
} // namespace swimtwin
