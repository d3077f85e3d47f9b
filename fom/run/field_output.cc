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
    template <int dim>
    DataOutBase::Patch<dim> make_patch(const CellNodes<dim> &nodes, const std::vector<Point<dim>> &positions,
                                       const NodalData<dim> &data)
    {
      const unsigned int      n_rows = data.scalar_name.empty() ? 2 * dim : 2 * dim + 1;
      DataOutBase::Patch<dim> patch;
      patch.reference_cell       = dim == 2 ? ReferenceCells::Triangle : ReferenceCells::Tetrahedron;
      patch.n_subdivisions       = 2;
      patch.points_are_available = true;
      patch.data.reinit(n_rows, n_cell_nodes<dim>);
      for (unsigned int v = 0; v <= dim; ++v)
        patch.vertices[v] = positions[nodes[v]];
      for (unsigned int a = 0; a < n_cell_nodes<dim>; ++a)
      {
        const Tensor<1, dim> vector = data.vector(nodes[a]);
        for (int c = 0; c < dim; ++c)
        {
          patch.data(c, a)                = vector[c];
          patch.data(n_rows - dim + c, a) = positions[nodes[a]][c];
        }
        if (!data.scalar_name.empty())
          patch.data(dim, a) = .5 * (data.scalar(nodes[ends<dim>(a)[0]]) + data.scalar(nodes[ends<dim>(a)[1]]));
      }
      return patch;
    }

    template <int dim>
    void write_vtu(const std::filesystem::path &file, const SimplexMesh<dim> &mesh,
                   const std::vector<Point<dim>> &positions, const NodalData<dim> &data)
    {
      std::vector<DataOutBase::Patch<dim>> patches;
      for (const auto &cell : mesh.cells)
      {
        patches.push_back(make_patch<dim>(cell, positions, data));
        patches.back().patch_index = patches.size() - 1;
      }
      std::vector<std::string> names(dim, data.vector_name);
      if (!data.scalar_name.empty())
        names.push_back(data.scalar_name);
      DataOutBase::VtkFlags flags;
      flags.write_higher_order_cells = true;
      std::ostringstream text; // in memory first: a full disk is then noticed, and named, in one place
      DataOutBase::write_vtu<dim, dim>(
          patches, names,
          {{0, unsigned(dim - 1), data.vector_name, DataComponentInterpretation::component_is_part_of_vector}}, flags,
          text);
      write_text_atomically(file, text.str());
    }

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
    for (const auto &[name, series] : {std::pair("fluid", &fluid_series_), std::pair("tail", &tail_series_)})
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
    return {model.now().time_s, model.swimmer(), model.now().configuration, model.fluid(),
            model.coupling().fluid_values()};
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
      write_vtu<dim>(
          folder_ / file, fluid.mesh(), fluid.positions(),
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
      write_vtu<dim>(folder_ / file, instant.swimmer.tail().mesh, x,
                     {"displacement_m", [&](const int node) { return x[node] - rest[node]; }, "", {}});
      tail_series_.emplace_back(instant.time_s, file);
      write_list("tail", tail_series_);
    }
  }

  template FieldInstant<2> instant_of<2>(const FullOrderModel<2> &);
  template FieldInstant<3> instant_of<3>(const FullOrderModel<3> &);
  template void            FieldOutput::write<2>(const FieldInstant<2> &, unsigned int);
  template void            FieldOutput::write<3>(const FieldInstant<3> &, unsigned int);
} // namespace swimtwin
