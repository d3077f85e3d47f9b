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
    struct NodalData
    {
      std::string                            vector_name;
      const std::function<Tensor<1, 2>(int)> vector;
      std::string                            scalar_name; ///< empty: no scalar
      const std::function<double(int)>       scalar;      ///< at vertices; it is linear
    };

    /// A quadratic triangle in deal.II's form for output: rows of data are field components, then coordinates. Every
    /// rank has the whole mesh and the whole solution, so that one can write without the others.
    DataOutBase::Patch<2> make_patch(const std::array<unsigned int, n_cell_nodes<2>> &nodes,
                                     const std::vector<Point<2>> &positions, const NodalData &data)
    {
      const unsigned int    n_rows = data.scalar_name.empty() ? 4 : 5;
      DataOutBase::Patch<2> patch;
      patch.reference_cell       = ReferenceCells::Triangle;
      patch.n_subdivisions       = 2;
      patch.points_are_available = true;
      patch.data.reinit(n_rows, n_cell_nodes<2>);
      for (unsigned int v = 0; v < 3; ++v)
        patch.vertices[v] = positions[nodes[v]];
      for (unsigned int a = 0; a < n_cell_nodes<2>; ++a)
      {
        const Tensor<1, 2> vector = data.vector(nodes[a]);
        for (unsigned int c = 0; c < 2; ++c)
        {
          patch.data(c, a)              = vector[c];
          patch.data(n_rows - 2 + c, a) = positions[nodes[a]][c];
        }
        if (!data.scalar_name.empty()) // mid-edge nodes 3, 4, 5 follow the vertices 0, 1, 2
          patch.data(2, a) =
              a < 3 ? data.scalar(nodes[a]) : .5 * (data.scalar(nodes[a - 3]) + data.scalar(nodes[(a - 2) % 3]));
      }
      return patch;
    }

    void write_vtu(const std::filesystem::path &file, const SimplexMesh<2> &mesh,
                   const std::vector<Point<2>> &positions, const NodalData &data)
    {
      std::vector<DataOutBase::Patch<2>> patches;
      for (const auto &cell : mesh.cells)
      {
        patches.push_back(make_patch(cell, positions, data));
        patches.back().patch_index = patches.size() - 1;
      }
      std::vector<std::string> names{data.vector_name, data.vector_name, data.scalar_name};
      names.resize(data.scalar_name.empty() ? 2 : 3);
      DataOutBase::VtkFlags flags;
      flags.write_higher_order_cells = true;
      std::ostringstream text; // in memory first: a full disk is then noticed, and named, in one place
      DataOutBase::write_vtu<2, 2>(patches, names,
                                   {{0, 1, data.vector_name, DataComponentInterpretation::component_is_part_of_vector}},
                                   flags, text);
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

  FieldInstant instant_of(const FullOrderModel<2> &model)
  {
    return {model.now().time_s, model.swimmer(), model.now().configuration, model.fluid(),
            model.coupling().fluid_values()};
  }

  void FieldOutput::write(const FieldInstant &instant, const unsigned int index)
  {
    const std::string number = file_number(index);
    if (const auto &values = instant.fluid_values; !values.empty())
    {
      const FluidDomain<2> &fluid     = *instant.fluid;
      const auto           &numbering = fluid.numbering();
      const std::string     file      = "fluid-" + number + ".vtu";
      write_vtu(
          folder_ / file, fluid.mesh(), fluid.positions(),
          {"velocity_m_s",
           [&](const int node) {
             return Tensor<1, 2>({values[numbering.vector_index(node, 0)], values[numbering.vector_index(node, 1)]});
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
      write_vtu(folder_ / file, instant.swimmer.tail().mesh, x,
                {"displacement_m", [&](const int node) { return x[node] - rest[node]; }, "", {}});
      tail_series_.emplace_back(instant.time_s, file);
      write_list("tail", tail_series_);
    }
  }
} // namespace swimtwin
