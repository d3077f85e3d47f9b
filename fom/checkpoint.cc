#include <fom/checkpoint.h>

#include <datasets/error.h>
#include <datasets/hdf5_file.h>

#include <sstream>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    const ArrayMeaning number{"1", "state of the run; see docs/file-formats.md"};

    std::vector<double> flat(const NodalField<2> &field)
    {
      std::vector<double> values;
      for (const auto &v : field)
        values.insert(values.end(), {v[0], v[1]});
      return values;
    }

    NodalField<2> nodal(const std::vector<double> &values)
    {
      NodalField<2> field;
      for (unsigned int i = 0; i + 1 < values.size(); i += 2)
        field.push_back(Tensor<1, 2>({values[i], values[i + 1]}));
      return field;
    }

    std::vector<double> flat(const std::vector<Point<2>> &points)
    {
      std::vector<double> values;
      for (const auto &x : points)
        values.insert(values.end(), {x[0], x[1]});
      return values;
    }

    std::vector<Point<2>> points(const std::vector<double> &values)
    {
      std::vector<Point<2>> result;
      for (unsigned int i = 0; i + 1 < values.size(); i += 2)
        result.emplace_back(values[i], values[i + 1]);
      return result;
    }

    std::vector<int> integers(const std::vector<unsigned int> &values)
    {
      return {values.begin(), values.end()};
    }

    std::vector<unsigned int> indices(const std::vector<int> &values)
    {
      return {values.begin(), values.end()};
    }

    Eigen::MatrixXd matrix(const std::vector<std::vector<double>> &rows)
    {
      Eigen::MatrixXd m(rows.size(), rows.empty() ? 0 : rows.front().size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        m.row(i) = Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), rows[i].size());
      return m;
    }

    std::vector<std::vector<double>> rows(const Eigen::MatrixXd &m)
    {
      std::vector<std::vector<double>> result;
      for (Eigen::Index i = 0; i < m.rows(); ++i)
      {
        const Eigen::VectorXd row = m.row(i);
        result.emplace_back(row.data(), row.data() + row.size());
      }
      return result;
    }

    /// Time, pose and rates of an instant in a fixed order.
    void write_instant(Hdf5Writer &file, const std::string &group, const Instant<2> &instant)
    {
      const auto &[time, configuration, rates] = instant;
      const std::vector<double> numbers        = {time,
                                                  configuration.pose.center[0],
                                                  configuration.pose.center[1],
                                                  configuration.pose.angle,
                                                  rates.velocity[0],
                                                  rates.velocity[1],
                                                  rates.omega[0]};
      file.write_vector(group + "/numbers", numbers, number);
      file.write_vector(group + "/shape_m", flat(configuration.shape), number);
      file.write_vector(group + "/shape_rate_m_s", flat(rates.shape_rate), number);
    }

    Instant<2> read_instant(const Hdf5Reader &file, const std::string &group)
    {
      const auto numbers = file.read_vector(group + "/numbers");
      Instant<2> instant;
      instant.time_s                    = numbers.at(0);
      instant.configuration.pose.center = Point<2>(numbers.at(1), numbers.at(2));
      instant.configuration.pose.angle  = numbers.at(3);
      instant.rates.velocity            = Tensor<1, 2>({numbers.at(4), numbers.at(5)});
      instant.rates.omega[0]            = numbers.at(6);
      instant.configuration.shape       = nodal(file.read_vector(group + "/shape_m"));
      instant.rates.shape_rate          = nodal(file.read_vector(group + "/shape_rate_m_s"));
      return instant;
    }

    void write_fluid_mesh(Hdf5Writer &file, const FluidMeshRecord<2> &mesh)
    {
      std::vector<int> cells;
      for (const auto &cell : mesh.soup.cells)
        cells.insert(cells.end(), cell.begin(), cell.end());
      std::string names;
      for (const auto &name : mesh.wall_names)
        names += name + "\n";
      file.write_vector("/fluid_mesh/vertices_m", flat(mesh.soup.vertices), number);
      file.write_vector("/fluid_mesh/cells", cells, number);
      file.write_vector("/fluid_mesh/nodes_m", flat(mesh.nodes), number);
      file.write_vector("/fluid_mesh/surface_nodes", integers(mesh.surface_nodes), number);
      file.write_vector("/fluid_mesh/wall_nodes", integers(mesh.wall_nodes), number);
      file.write_text("/fluid_mesh/wall_names", names, number);
    }

    FluidMeshRecord<2> read_fluid_mesh(const Hdf5Reader &file)
    {
      FluidMeshRecord<2> mesh;
      mesh.soup.vertices = points(file.read_vector("/fluid_mesh/vertices_m"));
      const auto cells   = file.read_int_vector("/fluid_mesh/cells");
      for (unsigned int i = 0; i + 2 < cells.size(); i += 3)
        mesh.soup.cells.push_back({unsigned(cells[i]), unsigned(cells[i + 1]), unsigned(cells[i + 2])});
      mesh.nodes         = points(file.read_vector("/fluid_mesh/nodes_m"));
      mesh.surface_nodes = indices(file.read_int_vector("/fluid_mesh/surface_nodes"));
      mesh.wall_nodes    = indices(file.read_int_vector("/fluid_mesh/wall_nodes"));
      std::istringstream names(file.read_text("/fluid_mesh/wall_names"));
      for (std::string name; std::getline(names, name);)
        mesh.wall_names.push_back(name);
      return mesh;
    }
  } // namespace

  void write_checkpoint(const std::filesystem::path &path, const Checkpoint &checkpoint, const Provenance &provenance)
  {
    Hdf5Writer  file;
    const auto &model  = checkpoint.model;
    const auto &counts = model.counts;
    write_instant(file, "/now", model.now);
    write_instant(file, "/before", model.before);
    const std::vector<double> numbers = {model.time_step_before_s,
                                         model.pose_at_meshing.center[0],
                                         model.pose_at_meshing.center[1],
                                         model.pose_at_meshing.angle,
                                         model.contraction_value,
                                         checkpoint.wall_time_s,
                                         checkpoint.cpu_time_s,
                                         counts.mesh_motion_cpu_s,
                                         counts.remeshing_cpu_s,
                                         counts.coupling_cpu_s,
                                         model.linear_counts.assembly_cpu_s,
                                         model.linear_counts.factorization_cpu_s,
                                         model.linear_counts.solve_cpu_s};
    const std::vector<int>    integer = {model.grid_step,
                                         model.steps_since_remeshing,
                                         model.contraction_measured_at_step,
                                         counts.n_steps,
                                         counts.n_coupling_iterations,
                                         counts.n_remeshes,
                                         counts.n_step_halvings,
                                         model.linear_counts.n_solves,
                                         model.linear_counts.n_factorizations,
                                         model.linear_counts.n_iterations,
                                         int(model.remesh_is_due)};
    file.write_vector("/numbers", numbers, number);
    file.write_vector("/integers", integer, number);
    file.write_vector("/unknowns", model.unknowns, number);
    file.write_vector("/unknowns_before", model.unknowns_before, number);
    if (model.fluid_mesh)
      write_fluid_mesh(file, *model.fluid_mesh);
    file.write_matrix("/trajectory", matrix(checkpoint.rows), number);
    file.write_matrix("/shapes", matrix(checkpoint.shapes), number);
    file.write_attribute("/", "scene_hash", provenance.scene_hash);
    file.write_attribute("/", "scene_text", provenance.scene_text);
    file.write_attribute("/", "program_version", provenance.program_version);
    file.save(path);
  }

  Checkpoint read_checkpoint(const std::filesystem::path &path, const Scene &scene)
  {
    const Hdf5Reader file(path);
    if (file.read_text_attribute("/", "scene_hash") != scene.hash)
      throw InputError(path.string() +
                       " belongs to another scene or to other --set values: resume with the scene it was "
                       "written for, or start afresh with --force");
    Checkpoint checkpoint;
    auto      &model                   = checkpoint.model;
    model.now                          = read_instant(file, "/now");
    model.before                       = read_instant(file, "/before");
    const auto number                  = file.read_vector("/numbers");
    const auto count                   = file.read_int_vector("/integers");
    model.time_step_before_s           = number.at(0);
    model.pose_at_meshing.center       = Point<2>(number.at(1), number.at(2));
    model.pose_at_meshing.angle        = number.at(3);
    model.contraction_value            = number.at(4);
    checkpoint.wall_time_s             = number.at(5);
    checkpoint.cpu_time_s              = number.at(6);
    model.grid_step                    = count.at(0);
    model.steps_since_remeshing        = count.at(1);
    model.contraction_measured_at_step = count.at(2);
    model.remesh_is_due                = count.at(10) != 0;
    model.counts = {count.at(3), count.at(4), count.at(5), count.at(6), number.at(7), number.at(8), number.at(9)};
    model.linear_counts   = {count.at(7), count.at(8), count.at(9), number.at(10), number.at(11), number.at(12)};
    model.unknowns        = file.read_vector("/unknowns");
    model.unknowns_before = file.read_vector("/unknowns_before");
    if (file.contains("/fluid_mesh"))
      model.fluid_mesh = read_fluid_mesh(file);
    checkpoint.rows   = rows(file.read_matrix("/trajectory"));
    checkpoint.shapes = rows(file.read_matrix("/shapes"));
    return checkpoint;
  }
} // namespace swimtwin
