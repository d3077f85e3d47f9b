#include <fom/field_output.h>

#include <datasets/output_folder.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/mapping_fe_field.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <cstdio>
#include <sstream>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// One quadratic mesh with one vector field and, for a fluid, a pressure.
    class VtuMesh
    {
    public:
      VtuMesh(const NodeNumbering<2> &numbering, const std::vector<Point<2>> &positions)
          : dof_handler_(numbering.dof_handler()), positions_(dof_handler_.n_dofs()),
            mapping_(dof_handler_, positions_, vector_components(dof_handler_))
      {
        for (unsigned int node = 0; node < positions.size(); ++node)
          for (int c = 0; c < 2; ++c)
            positions_[numbering.vector_index(node, c)] = positions[node][c];
      }

      void write(const std::filesystem::path &file, const std::string &vector_name, const std::string &scalar_name,
                 const std::vector<double> &values)
      {
        Vector<double>                                                        data(values.begin(), values.end());
        std::vector<std::string>                                              names(2, vector_name);
        std::vector<DataComponentInterpretation::DataComponentInterpretation> meaning(
            2, DataComponentInterpretation::component_is_part_of_vector);
        if (dof_handler_.get_fe().n_components() == 3)
        {
          names.push_back(scalar_name);
          meaning.push_back(DataComponentInterpretation::component_is_scalar);
        }
        DataOut<2>            out;
        DataOutBase::VtkFlags flags;
        flags.write_higher_order_cells = true;
        out.set_flags(flags);
        out.attach_dof_handler(dof_handler_);
        out.add_data_vector(data, names, DataOut<2>::type_dof_data, meaning);
        out.build_patches(mapping_, 2, DataOut<2>::curved_inner_cells);
        std::ostringstream text; // in memory first: a full disk is then noticed, and named, in one place
        out.write_vtu(text);
        write_text_atomically(file, text.str());
      }

    private:
      static ComponentMask vector_components(const DoFHandler<2> &dof_handler)
      {
        std::vector<bool> mask(dof_handler.get_fe().n_components(), true);
        mask.resize(2);
        mask.resize(dof_handler.get_fe().n_components(), false);
        return ComponentMask(mask);
      }

      const DoFHandler<2>                 &dof_handler_;
      Vector<double>                       positions_;
      MappingFEField<2, 2, Vector<double>> mapping_;
    };

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

  void FieldOutput::write_series(const std::string &name, std::vector<std::pair<double, std::string>> &series,
                                 const std::string &file, const double time)
  {
    series.emplace_back(time, file);
    std::ostringstream pvd;
    DataOutBase::write_pvd_record(pvd, series);
    write_text_atomically(folder_ / (name + ".pvd"), pvd.str());
  }

  void FieldOutput::adopt(const unsigned int n_instants, const double interval_s)
  {
    for (auto *series : {&fluid_series_, &tail_series_})
    {
      const std::string name = series == &fluid_series_ ? "fluid-" : "tail-";
      for (unsigned int index = 0; index < n_instants; ++index)
        if (const std::string file = name + file_number(index) + ".vtu"; std::filesystem::exists(folder_ / file))
          series->emplace_back(index * interval_s, file);
      for (unsigned int index = n_instants; std::filesystem::remove(folder_ / (name + file_number(index) + ".vtu"));
           ++index)
        ;
    }
  }

  void FieldOutput::write(const FullOrderModel<2> &model, const unsigned int index)
  {
    const std::string number = file_number(index);
    const double      time   = model.now().time_s;
    if (const auto values = model.fluid_values(); !values.empty())
    {
      std::vector<double> fields = values;
      for (unsigned int v = 0; v < model.fluid()->mesh().n_vertices(); ++v)
        fields[model.fluid()->numbering().pressure_index(v)] *= model.fluid()->pressure_scale();
      const std::string file = "fluid-" + number + ".vtu";
      VtuMesh(model.fluid()->numbering(), model.fluid()->positions())
          .write(folder_ / file, "velocity_m_s", "pressure_Pa", fields);
      write_series("fluid", fluid_series_, file, time);
    }
    if (model.swimmer().has_tail())
    {
      const auto            &mesh = model.swimmer().tail().mesh;
      const NodeNumbering<2> numbering(mesh, false);
      const auto             x = model.swimmer().tail_positions(model.now().configuration);
      std::vector<double>    displacement(numbering.size());
      const auto             rest = model.swimmer().tail_positions(model.swimmer().configuration_at_rest());
      for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
        for (int c = 0; c < 2; ++c)
          displacement[numbering.vector_index(a, c)] = x[a][c] - rest[a][c];
      const std::string file = "tail-" + number + ".vtu";
      VtuMesh(numbering, x).write(folder_ / file, "displacement_m", "", displacement);
      write_series("tail", tail_series_, file, time);
    }
  }
} // namespace swimtwin
