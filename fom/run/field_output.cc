#include <fom/run/field_output.h>

#include <datasets/files/output_folder.h>

#include <deal.II/base/data_out_base.h>
#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <sstream>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// A field to write, at every node of a mesh.
    template <int dim>
    struct NodalData
    {
      std::string                              vector_name;
      const std::function<Tensor<1, dim>(int)> vector;
      std::string                              scalar_name; ///< empty: no scalar
      const std::function<double(int)>         scalar;      ///< at vertices; it is linear
    };

    /// Vertices whose mean a node of a cell has in a linear field: itself, or the ends of its edge.
    constexpr int ends_of_node[10][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1},
                                         {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    template <int dim>
    const int *ends(const unsigned int node)
    {
      return ends_of_node[node <= dim ? node : node + 3 - dim];
    }

    /// A quadratic simplex in deal.II's form for output: rows of data are field components, then coordinates. Every
    /// rank has the whole mesh and the whole solution, so that one can write without the others.
    template <int dim, int spacedim>
    DataOutBase::Patch<dim, spacedim> make_patch(const CellNodes<dim>               &nodes,
                                                 const std::vector<Point<spacedim>> &positions,
                                                 const NodalData<spacedim>          &data)
    {
      const unsigned int                n_rows = data.scalar_name.empty() ? 2 * spacedim : 2 * spacedim + 1;
      DataOutBase::Patch<dim, spacedim> patch;
      patch.reference_cell       = dim == 2 ? ReferenceCells::Triangle : ReferenceCells::Tetrahedron;
      patch.n_subdivisions       = 2;
      patch.points_are_available = true;
      patch.data.reinit(n_rows, n_cell_nodes<dim>);
      for (unsigned int v = 0; v <= dim; ++v)
        patch.vertices[v] = positions[nodes[v]];
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      {
        const Tensor<1, spacedim> vector = data.vector(nodes[a]);
        for (int c = 0; c < spacedim; ++c)
        {
          patch.data(c, a)                     = vector[c];
          patch.data(n_rows - spacedim + c, a) = positions[nodes[a]][c];
        }
        if (!data.scalar_name.empty())
          patch.data(spacedim, a) = .5 * (data.scalar(nodes[ends<dim>(a)[0]]) + data.scalar(nodes[ends<dim>(a)[1]]));
      }
      return patch;
    }

    /// `cells`: quadratic simplices, also faces in space.
    template <int dim, int spacedim>
    void write_vtu(const std::filesystem::path &file, const std::vector<CellNodes<dim>> &cells,
                   const std::vector<Point<spacedim>> &positions, const NodalData<spacedim> &data)
    {
      std::vector<DataOutBase::Patch<dim, spacedim>> patches;
      for (const auto &cell : cells)
      {
        patches.push_back(make_patch<dim, spacedim>(cell, positions, data));
        patches.back().patch_index = patches.size() - 1;
      }
      std::vector<std::string> names(spacedim, data.vector_name);
      if (!data.scalar_name.empty())
        names.push_back(data.scalar_name);
      DataOutBase::VtkFlags flags;
      flags.write_higher_order_cells = dim == 2; // deal.II 9.4.1 then leaves tetrahedra without types and offsets
      std::ostringstream text; // in memory first: a full disk is then noticed, and named, in one place
      DataOutBase::write_vtu<dim, spacedim>(
          patches, names,
          {{0, unsigned(spacedim - 1), data.vector_name, DataComponentInterpretation::component_is_part_of_vector}},
          flags, text);
      write_text_atomically(file, text.str());
    }

    /// Of ParaView, which knows the folder of a script on its command line only.
    const std::string view_script = R"py(# The swimmer and the flow in its plane of motion: paraview --script=view.py
# (or, in ParaView: View, Python Shell, Run Script; from this folder).
import os
from paraview.simple import *

folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()


def series(name):
    file = os.path.join(folder, name + ".pvd")
    return PVDReader(registrationName=name, FileName=file) if os.path.exists(file) else None


view = GetActiveViewOrCreate("RenderView")
body, fluid = series("body"), series("fluid")

shown = Show(body, view)
shown.NonlinearSubdivisionLevel = 2  # elements are curved
shown.AmbientColor = shown.DiffuseColor = [0.82, 0.40, 0.17]
shown.Specular = 0.3

if fluid is not None:
    walls = Show(ExtractSurface(registrationName="walls", Input=fluid), view)
    walls.AmbientColor = walls.DiffuseColor = [0.6, 0.6, 0.6]
    walls.Opacity = 0.08
    plane = Slice(registrationName="plane of motion", Input=fluid)
    plane.SliceType = "Plane"
    plane.SliceType.Origin = [0.0, 0.0, 0.0]
    plane.SliceType.Normal = [0.0, 0.0, 1.0]
    flow = Show(plane, view)
    ColorBy(flow, ("POINTS", "velocity_m_s", "Magnitude"))
    flow.RescaleTransferFunctionToDataRange(True)
    flow.SetScalarBarVisibility(view, True)
    flow.Opacity = 0.7

GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
low_x, high_x, low_y, high_y, low_z, high_z = body.GetDataInformation().GetBounds()
center = [(low_x + high_x) / 2, (low_y + high_y) / 2, (low_z + high_z) / 2]
distance = 3 * max(high_x - low_x, high_y - low_y)
view.CameraFocalPoint = center
view.CameraPosition = [center[0] - 0.3 * distance, center[1] - 0.6 * distance, center[2] + 0.75 * distance]
view.CameraViewUp = [0.0, 0.5, 0.5]
Render()
)py";

    std::string file_number(const unsigned int index)
    {
      char number[16];
      std::snprintf(number, sizeof number, "%04u", index);
      return number;
    }
  } // namespace

  FieldOutput::FieldOutput(std::filesystem::path folder) : folder_(std::move(folder))
  {
    std::filesystem::create_directories(folder_);
  }

  void FieldOutput::write_list(const std::string &name, const Series &series) const
  {
    std::ostringstream pvd;
    DataOutBase::write_pvd_record(pvd, series);
    write_text_atomically(folder_ / (name + ".pvd"), pvd.str());
  }

  void FieldOutput::adopt(const unsigned int n_instants, const double interval_s)
  {
    for (const auto &[name, series] :
         {std::pair("fluid", &fluid_series_), std::pair("tail", &tail_series_), std::pair("body", &body_series_)})
    {
      const auto file_of = [name = name](const unsigned int index) {
        return fmt::format("{}-{}.vtu", name, file_number(index));
      };
      for (unsigned int index = 0; index < n_instants; ++index)
        if (std::filesystem::exists(folder_ / file_of(index)))
          series->emplace_back(index * interval_s, file_of(index));
      if (std::filesystem::exists(folder_ / (std::string(name) + ".pvd")))
        write_list(name, *series); // before the files that it must not name any more are gone
      for (unsigned int index = n_instants; std::filesystem::remove(folder_ / file_of(index)); ++index)
        ;
    }
  }

  template <int dim>
  FieldInstant<dim> instant_of(const FullOrderModel<dim> &model)
  {
    const auto &[time_s, configuration, rates] = model.now();
    return {time_s, model.swimmer(), configuration, rates, model.fluid(), model.coupling().fluid_values()};
  }

  template <int dim>
  void FieldOutput::write(const FieldInstant<dim> &instant, const unsigned int index)
  {
    const std::string number = file_number(index);
    if (const auto &values = instant.fluid_values; !values.empty())
    {
      const FluidDomain<dim> &fluid     = *instant.fluid;
      const auto             &numbering = fluid.numbering();
      const std::string       file      = "fluid-" + number + ".vtu";
      write_vtu<dim, dim>(
          folder_ / file, fluid.mesh().cells, fluid.positions(),
          {"velocity_m_s",
           [&](const int node) {
             Tensor<1, dim> u;
             for (int c = 0; c < dim; ++c)
               u[c] = values[numbering.vector_index(node, c)];
             return u;
           },
           "pressure_Pa",
           [&](const int vertex) { return fluid.pressure_scale() * values[numbering.pressure_index(vertex)]; }});
      fluid_series_.emplace_back(instant.time_s, file);
      write_list("fluid", fluid_series_);
    }
    if (instant.swimmer.has_tail())
    {
      const auto        x    = instant.swimmer.tail_positions(instant.configuration);
      const auto        rest = instant.swimmer.tail_positions(instant.swimmer.configuration_at_rest());
      const std::string file = "tail-" + number + ".vtu";
      write_vtu<dim, dim>(folder_ / file, instant.swimmer.tail().mesh.cells, x,
                          {"displacement_m", [&](const int node) { return x[node] - rest[node]; }, "", {}});
      tail_series_.emplace_back(instant.time_s, file);
      write_list("tail", tail_series_);
    }
    if constexpr (dim == 3)
      write_body(instant, number);
  }

  void FieldOutput::write_body(const FieldInstant<3> &instant, const std::string &number)
  {
    const auto        x    = instant.swimmer.surface(instant.configuration);
    const auto        rest = instant.swimmer.surface(instant.swimmer.configuration_at_rest());
    const std::string file = "body-" + number + ".vtu";
    write_vtu<2, 3>(folder_ / file, instant.swimmer.body().surface.faces, x,
                    {"displacement_m", [&](const int node) { return x[node] - rest[node]; }, "", {}});
    body_series_.emplace_back(instant.time_s, file);
    write_list("body", body_series_);
    if (body_series_.size() == 1)
      write_text_atomically(folder_ / "view.py", view_script);
  }

  template FieldInstant<2> instant_of<2>(const FullOrderModel<2> &);
  template FieldInstant<3> instant_of<3>(const FullOrderModel<3> &);
  template void            FieldOutput::write<2>(const FieldInstant<2> &, unsigned int);
  template void            FieldOutput::write<3>(const FieldInstant<3> &, unsigned int);
} // namespace swimtwin
