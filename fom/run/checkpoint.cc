#include <fom/run/checkpoint.h>

#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_open.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>
#include <utility>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    const ArrayMeaning number{"1", "state of the run; see docs/file-formats.md"};

    /// Components together; also of points, which are vectors.
    template <typename Vector>
    std::vector<double> flat(const std::vector<Vector> &field)
    {
      std::vector<double> values;
      for (const auto &v : field)
        values.insert(values.end(), v.begin_raw(), v.end_raw());
      return values;
    }

    template <typename Vector>
    std::vector<Vector> vectors(const std::vector<double> &values)
    {
      constexpr int       dim = Vector::dimension;
      std::vector<Vector> field;
      for (std::size_t i = 0; i + dim <= values.size(); i += dim)
      {
        auto &v = field.emplace_back();
        for (int c = 0; c < dim; ++c)
          v[c] = values[i + c];
      }
      return field;
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

    const std::string remedy_for_checkpoint = "start afresh with --force";

    Hdf5Reader open_checkpoint(const std::filesystem::path &path)
    {
      try
      {
        return Hdf5Reader(path);
      }
      catch (const InputError &error)
      {
        std::string cause = error.what();
        cause.pop_back(); // its full stop
        throw InputError(cause + ", or " + remedy_for_checkpoint + ".");
      }
    }

    /// What this version asks of a file that is as it was written: one of another version may hold something else.
    std::vector<double> read_numbers(const Hdf5Reader &file, const std::string &path, const std::size_t n)
    {
      std::vector<double> values = file.read_vector(path);
      if (values.size() != n)
        file.refuse(path, fmt::format("has {} values, and this version needs {}; {}.", values.size(), n,
                                      remedy_for_checkpoint));
      return values;
    }

    Eigen::MatrixXd read_rows(const Hdf5Reader &file, const std::string &path, const Eigen::Index n_columns)
    {
      Eigen::MatrixXd values = file.read_matrix(path);
      if (values.rows() > 0 && values.cols() != n_columns)
        file.refuse(path, fmt::format("has {} columns, and this version needs {}; {}.", values.cols(), n_columns,
                                      remedy_for_checkpoint));
      return values;
    }

    std::vector<unsigned int> read_indices(const Hdf5Reader &file, const std::string &path, const std::size_t end)
    {
      const std::vector<int> values = file.read_int_vector(path);
      for (const int value : values)
        if (value < 0 || static_cast<std::size_t>(value) >= end)
          file.refuse(path, fmt::format("names entry {} of {}; {}.", value, end, remedy_for_checkpoint));
      return indices(values);
    }

    /// Counts and flags are kept as numbers, too.
    template <typename Value>
    void read_value(const Hdf5Reader &file, const std::string &name, Value &value)
    {
      const double number = file.read_number_attribute("/", name);
      const bool   fits =
          std::abs(number) < std::numeric_limits<int>::max() && !(std::is_unsigned_v<Value> && number < 0.);
      if (std::is_integral_v<Value> && !fits)
        file.refuse("/", fmt::format("has {} = {}; {}.", name, number, remedy_for_checkpoint));
      value = static_cast<Value>(number);
    }

    /// The numbers of an attitude in a fixed order.
    template <typename AttitudeType, typename Visitor>
    void for_each_number_of(AttitudeType &attitude, const Visitor &visit)
    {
      if constexpr (std::is_base_of_v<Attitude<2>, std::remove_const_t<AttitudeType>>)
        visit("angle", attitude.angle);
      else
      {
        visit("qw", attitude.quaternion.w());
        visit("qx", attitude.quaternion.x());
        visit("qy", attitude.quaternion.y());
        visit("qz", attitude.quaternion.z());
      }
    }

    /// Time, pose and rates of an instant in a fixed order.
    template <int dim>
    void write_instant(Hdf5Writer &file, const std::string &group, const Instant<dim> &instant)
    {
      const auto &[time, configuration, rates] = instant;
      std::vector<double> numbers              = {time};
      const auto          append = [&](const auto &v) { numbers.insert(numbers.end(), v.begin_raw(), v.end_raw()); };
      append(configuration.pose.center);
      for_each_number_of(configuration.pose, [&](const char *, const double value) { numbers.push_back(value); });
      append(rates.velocity);
      append(rates.omega);
      file.write_vector(group + "/numbers", numbers, number);
      file.write_vector(group + "/shape_m", flat(configuration.shape), number);
      file.write_vector(group + "/shape_rate_m_s", flat(rates.shape_rate), number);
    }

    template <int dim>
    Instant<dim> read_instant(const Hdf5Reader &file, const std::string &group)
    {
      const auto   numbers = read_numbers(file, group + "/numbers", (dim == 2 ? 2 : 5) + 2 * dim + n_rotations<dim>);
      Instant<dim> instant;
      int          next   = 0;
      const auto   number = [&] { return numbers.at(next++); };
      instant.time_s      = number();
      for (int c = 0; c < dim; ++c)
        instant.configuration.pose.center[c] = number();
      for_each_number_of(instant.configuration.pose, [&](const char *, double &value) { value = number(); });
      for (int c = 0; c < dim; ++c)
        instant.rates.velocity[c] = number();
      for (int k = 0; k < n_rotations<dim>; ++k)
        instant.rates.omega[k] = number();
      instant.configuration.shape = vectors<Tensor<1, dim>>(file.read_vector(group + "/shape_m"));
      instant.rates.shape_rate    = vectors<Tensor<1, dim>>(file.read_vector(group + "/shape_rate_m_s"));
      return instant;
    }

    template <int dim>
    void write_fluid_mesh(Hdf5Writer &file, const FluidMeshRecord<dim> &mesh)
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
      if (!mesh.image_of_vertex.empty())
        file.write_vector("/fluid_mesh/image_of_vertex", integers(mesh.image_of_vertex), number);
    }

    template <int dim>
    FluidMeshRecord<dim> read_fluid_mesh(const Hdf5Reader &file)
    {
      FluidMeshRecord<dim> mesh;
      mesh.soup.vertices = vectors<Point<dim>>(file.read_vector("/fluid_mesh/vertices_m"));
      const auto cells   = read_indices(file, "/fluid_mesh/cells", mesh.soup.vertices.size());
      for (std::size_t i = 0; i + dim < cells.size(); i += dim + 1)
        std::copy_n(cells.begin() + i, dim + 1, mesh.soup.cells.emplace_back().begin());
      mesh.nodes         = vectors<Point<dim>>(file.read_vector("/fluid_mesh/nodes_m"));
      mesh.surface_nodes = read_indices(file, "/fluid_mesh/surface_nodes", mesh.nodes.size());
      mesh.wall_nodes    = read_indices(file, "/fluid_mesh/wall_nodes", mesh.nodes.size());
      std::istringstream names(file.read_text("/fluid_mesh/wall_names"));
      for (std::string name; std::getline(names, name);)
        mesh.wall_names.push_back(name);
      if (file.contains("/fluid_mesh/image_of_vertex"))
        mesh.image_of_vertex = indices(file.read_int_vector("/fluid_mesh/image_of_vertex"));
      if (mesh.wall_names.size() != mesh.wall_nodes.size())
        file.refuse("/fluid_mesh/wall_names", fmt::format("has {} names of {} nodes; {}.", mesh.wall_names.size(),
                                                          mesh.wall_nodes.size(), remedy_for_checkpoint));
      return mesh;
    }

    std::vector<std::vector<double>> rows_of(const std::vector<IntervalWork> &works)
    {
      std::vector<std::vector<double>> result;
      for (const auto &work : works)
        result.push_back({work.magnetic_J_m, work.external_J_m, work.dissipated_J_m});
      return result;
    }

    std::vector<IntervalWork> works_of(const std::vector<std::vector<double>> &rows)
    {
      std::vector<IntervalWork> works;
      for (const auto &row : rows)
        works.push_back({row[0], row[1], row[2]});
      return works;
    }

    template <typename Past>
    auto motions_of(Past &past)
    {
      return std::array<std::pair<std::string, decltype(&past.now)>, 2>{
          {{"/fluid_now", &past.now}, {"/fluid_before", &past.before}}};
    }

    /// One list of numbers for both directions: `visit(name, member)`.
    template <typename CheckpointType, typename Visitor>
    void for_each_number(CheckpointType &checkpoint, const Visitor &visit)
    {
      auto &model    = checkpoint.model;
      auto &coupling = model.coupling;
      visit("wall_time_s", checkpoint.wall_time_s);
      visit("cpu_time_s", checkpoint.cpu_time_s);
      visit("grid_step", model.grid_step);
      visit("time_step_before_s", model.time_step_before_s);
      visit("steps_since_remeshing", model.steps_since_remeshing);
      visit("remesh_is_due", model.remesh_is_due);
      auto &pose = model.pose_at_meshing;
      for (unsigned int c = 0; c < std::decay_t<decltype(pose.center)>::dimension; ++c)
        visit(std::string(1, "xyz"[c]) + "_at_meshing_m", pose.center[c]);
      for_each_number_of(pose, [&](const char *name, auto &&value) {
        visit(std::string(name) + "_at_meshing", std::forward<decltype(value)>(value));
      });
      visit("n_steps", model.counts.n_steps);
      visit("n_remeshes", model.counts.n_remeshes);
      visit("n_step_halvings", model.counts.n_step_halvings);
      visit("remeshing_cpu_s", model.counts.remeshing_cpu_s);
      visit("contraction", coupling.contraction);
      visit("contraction_change", coupling.contraction_change);
      visit("contraction_measured_at_step", coupling.contraction_measured_at_step);
      visit("n_coupling_iterations", coupling.counts.n_iterations);
      visit("mesh_motion_cpu_s", coupling.counts.mesh_motion_cpu_s);
      visit("iteration_cpu_s", coupling.counts.iteration_cpu_s);
      visit("tail_cpu_s", coupling.counts.tail_cpu_s);
      const std::pair<const char *, decltype(&coupling.linear_counts)> systems[] = {
          {"", &coupling.linear_counts}, {"tail_", &coupling.tail_linear_counts}};
      for (const auto &[prefix, linear] : systems)
      {
        const std::string name(prefix);
        visit(name + "n_linear_solves", linear->n_solves);
        visit(name + "n_factorizations", linear->n_factorizations);
        visit(name + "n_linear_iterations", linear->n_iterations);
        visit(name + "assembly_cpu_s", linear->assembly_cpu_s);
        visit(name + "factorization_cpu_s", linear->factorization_cpu_s);
        visit(name + "solve_cpu_s", linear->solve_cpu_s);
      }
    }
  } // namespace

  template <int dim>
  void write_checkpoint(const std::filesystem::path &path, const Checkpoint<dim> &checkpoint,
                        const Provenance &provenance)
  {
    Hdf5Writer  file;
    const auto &model = checkpoint.model;
    write_instant(file, "/now", model.now);
    write_instant(file, "/before", model.before);
    file.write_vector("/unknowns", model.coupling.unknowns, number);
    file.write_vector("/unknowns_before", model.coupling.unknowns_before, number);
    if (model.fluid_mesh)
      write_fluid_mesh(file, *model.fluid_mesh);
    file.write_matrix("/trajectory", matrix(checkpoint.rows), number);
    file.write_matrix("/shapes", matrix(checkpoint.shapes), number);
    for (const auto &[name, motion] : motions_of(model.fluid_past))
      if (!motion->positions.empty())
      {
        file.write_vector(name + "/positions_m", flat(motion->positions), number);
        file.write_vector(name + "/velocity_m_s", flat(motion->velocity), number);
      }
    if (model.balance)
    {
      file.write_vector("/powers_W_m",
                        std::vector<double>{model.balance->magnetic, model.balance->gravity, model.balance->wall},
                        number);
      file.write_vector("/surface_force_N_m", model.balance->surface_force, number);
    }
    if (!checkpoint.first_works.empty())
      file.write_matrix("/first_works_J_m", matrix(rows_of(checkpoint.first_works)), number);
    write_plane_flows(file, "/flows", checkpoint.flows);
    for_each_number(checkpoint, [&](const std::string &name, const auto value) {
      file.write_attribute("/", name, static_cast<double>(value));
    });
    file.write_attribute("/", "scene_hash", provenance.scene_hash);
    file.write_attribute("/", "scene_text", provenance.scene_text);
    file.write_attribute("/", "program_version", provenance.program_version);
    file.save(path, Seal::appended);
  }

  template <int dim>
  Checkpoint<dim> read_checkpoint(const std::filesystem::path &path, const Scene &scene)
  {
    const Hdf5Reader file = open_checkpoint(path);
    require_seal(path, remedy_for_checkpoint);
    if (file.read_text_attribute("/", "scene_hash") != scene.hash)
      throw InputError(path.string() +
                       " belongs to another scene or to other --set values: resume with the scene it was "
                       "written for, or start afresh with --force");
    Checkpoint<dim> checkpoint;
    auto           &model = checkpoint.model;
    for_each_number(checkpoint, [&](const std::string &name, auto &value) { read_value(file, name, value); });
    model.now                      = read_instant<dim>(file, "/now");
    model.before                   = read_instant<dim>(file, "/before");
    model.coupling.unknowns        = file.read_vector("/unknowns");
    model.coupling.unknowns_before = file.read_vector("/unknowns_before");
    if (file.contains("/fluid_mesh"))
      model.fluid_mesh = read_fluid_mesh<dim>(file);
    for (const auto &[name, motion] : motions_of(model.fluid_past))
      if (file.contains(name))
        *motion = {vectors<Point<dim>>(file.read_vector(name + "/positions_m")),
                   vectors<Tensor<1, dim>>(file.read_vector(name + "/velocity_m_s"))};
    checkpoint.rows   = rows(read_rows(file, "/trajectory", static_cast<Eigen::Index>(numbers_of({}).size())));
    checkpoint.shapes = rows(file.read_matrix("/shapes"));
    if (file.contains("/powers_W_m"))
    {
      const auto powers = read_numbers(file, "/powers_W_m", 3);
      model.balance.emplace();
      model.balance->magnetic      = powers[0];
      model.balance->gravity       = powers[1];
      model.balance->wall          = powers[2];
      model.balance->surface_force = file.read_vector("/surface_force_N_m");
    }
    if (file.contains("/first_works_J_m"))
      checkpoint.first_works = works_of(rows(read_rows(file, "/first_works_J_m", 3)));
    checkpoint.flows = read_plane_flows(file, "/flows");
    return checkpoint;
  }

  template void          write_checkpoint<2>(const std::filesystem::path &, const Checkpoint<2> &, const Provenance &);
  template void          write_checkpoint<3>(const std::filesystem::path &, const Checkpoint<3> &, const Provenance &);
  template Checkpoint<2> read_checkpoint<2>(const std::filesystem::path &, const Scene &);
  template Checkpoint<3> read_checkpoint<3>(const std::filesystem::path &, const Scene &);
} // namespace swimtwin
