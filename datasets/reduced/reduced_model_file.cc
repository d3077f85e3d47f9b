#include <datasets/files/hdf5_file.h>
#include <datasets/files/hdf5_provenance.h>
#include <datasets/reduced/reduced_model.h>
#include <datasets/reduced/reduced_model_rules.h>
#include <datasets/reduced/training_record_file.h>
#include <datasets/system/error.h>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr const char *format_name = "swimtwin reduced model";

    constexpr std::array half_fit_paths{"/resistance/half_fit_1", "/resistance/half_fit_2"};

    /// One visitor for both directions.
    template <typename Range, typename Visitor>
    void for_each_interval(Range &range, const Visitor &visit)
    {
      visit("/range/young_modulus_Pa", "Pa", range.young_modulus_Pa);
      visit("/range/viscosity_Pa_s", "Pa s", range.viscosity_Pa_s);
      visit("/range/magnetization_A_m", "A/m", range.magnetization_A_m);
      visit("/range/frequency_Hz", "Hz", range.frequency_Hz);
      visit("/range/bx_T", "T", range.bx_T);
      visit("/range/by_T", "T", range.by_T);
    }

    void write_polynomials(Hdf5Writer &writer, const std::string &path, const ShapePolynomials &polynomials,
                           const ArrayMeaning &coefficients)
    {
      writer.write_vector(path + "_scale_m", polynomials.scale_m, {"m", "of the coordinates in the monomials"});
      writer.write_matrix(path + "_exponents", polynomials.exponents,
                          {"1", "one monomial per row: exponents of the scaled coordinates"});
      writer.write_matrix(path + "_coefficients", polynomials.coefficients, coefficients);
    }

    /// Of what is per unit depth in two dimensions and whole in space.
    std::string metres(const int dimension, const int power)
    {
      return fmt::format("m^{}", dimension == 3 ? power + 1 : power);
    }

    void write_tail(Hdf5Writer &writer, const ReducedTail &tail)
    {
      writer.write_matrix(
          "/tail/nodes_m", tail.nodes_m,
          {"m", "nodes of the quadratic tail mesh, reference configuration, origin at the head's centre"});
      writer.write_matrix("/tail/cells", tail.cells,
                          {"1", tail.dimension() == 3
                                    ? "nodes of each tetrahedron: four vertices, then midpoints of edges 01, 12, 20, "
                                      "03, 13, 23"
                                    : "nodes of each triangle: three vertices, then midpoints of edges 01, 12, 20"});
      writer.write_matrix("/tail/modes", tail.modes,
                          {"1", "one mode per column, interleaved components, orthonormal in the mean over the tail"});
      if (tail.followers.rows() > 0)
        writer.write_matrix(
            "/tail/followers", tail.followers,
            {"1/m", "amplitudes of the last modes: coefficients of q_i q_j, j <= i, at i (i + 1) / 2 + j"});
      if (tail.amplitudes.are_given())
        write_polynomials(writer, "/tail/amplitude", tail.amplitudes,
                          {"m", "amplitude of each mode (columns) by bending angles times the tail's length"});
      writer.write_vector("/tail/parity", tail.parity, {"1", "1: keeps a symmetric tail symmetric, -1: bends it"});
      writer.write_vector("/tail/tip_nodes", std::array{tail.before_tip_node, tail.tip_node},
                          {"1", "on the axis: the middle of the last edge, and the tip"});
    }

    void write_gram_matrices(Hdf5Writer &writer, const ReducedElasticity &elasticity)
    {
      const std::string gram = "energy m^T G m of the strain monomials m = (p_i, p_i p_j with j <= i), unit ";
      writer.write_matrix("/elasticity/gram_lambda", elasticity.gram_lambda, {"m^2 / m^degree", gram + "lambda"});
      writer.write_matrix("/elasticity/gram_mu", elasticity.gram_mu, {"m^2 / m^degree", gram + "shear modulus"});
    }

    void write_elasticity(Hdf5Writer &writer, const ReducedElasticity &elasticity, const int dimension)
    {
      if (elasticity.energy.are_given())
        write_polynomials(writer, "/elasticity/energy", elasticity.energy,
                          {metres(dimension, 2), "elastic energy over Young's modulus"});
      else
        write_gram_matrices(writer, elasticity);
      writer.write_attribute("/elasticity", "poisson_ratio", elasticity.poisson_ratio);
    }

    void write_magnet(Hdf5Writer &writer, const ReducedMagnet &magnet, const int dimension)
    {
      writer.write_vector("/magnet/tail_area_m2", Eigen::VectorXd(magnet.tail_area_m2),
                          {metres(dimension, 2), "moment of the tail at rest over its magnetization"});
      writer.write_matrix("/magnet/tail_area_of_mode_m", magnet.tail_area_of_mode_m,
                          {metres(dimension, 1), "its derivative by each mode's amplitude, one mode per column"});
      writer.write_attribute("/magnet", "head_area_m2", magnet.head_area_m2);
    }

    void write_area(Hdf5Writer &writer, const ReducedArea &area)
    {
      writer.write_vector("/area/linear_m", area.linear_m, {"m", "linear part of the tail's change of area"});
      writer.write_matrix("/area/quadratic", area.quadratic, {"1", "quadratic part of the tail's change of area"});
      writer.write_attribute("/area", "is_kept", area.is_kept ? 1. : 0.);
    }

    void write_resistance(Hdf5Writer &writer, const ReducedResistance &resistance, const int dimension)
    {
      writer.write_matrix("/resistance/factor_at_rest", resistance.factor_at_rest,
                          {dimension == 3 ? "m^(1/2 or 3/2)" : "m^(0 or 1)",
                           "L_0 of R = L_0 C C^T L_0^T, unit viscosity, in two dimensions per unit depth; Ux, Uy, "
                           "omega, modes"});
      writer.write_vector("/resistance/coordinate_scale_m", resistance.coordinate_scale_m,
                          {"m", "of each mode's coordinate in the polynomials"});
      writer.write_matrix("/resistance/exponents", resistance.exponents,
                          {"1", "one monomial per row: exponents of the modes' coordinates [and of the angle]"});
      writer.write_matrix(
          "/resistance/coefficients", resistance.coefficients,
          {"1", "one monomial per row; column i (i + 1) / 2 + j is entry (i, j) of C, log on the diagonal"});
      for (std::size_t k = 0; k < resistance.half_fits.size(); ++k)
        writer.write_matrix(half_fit_paths.at(k), resistance.half_fits[k],
                            {"1", "the same, fitted to one half of the samples"});
      writer.write_attribute("/resistance", "depends_on_angle", resistance.depends_on_angle ? 1. : 0.);
      writer.write_attribute("/resistance", "angle_scale_rad", resistance.angle_scale_rad);
      if (!resistance.depends_on_height)
        return;
      writer.write_vector("/resistance/usual_by_coordinate", resistance.usual_by_coordinate,
                          {"1", "usual height of the head's centre per coordinate, beside that per sine of its angle"});
      writer.write_attribute("/resistance", "usual_by_sine_m", resistance.usual_by_sine_m);
      writer.write_attribute("/resistance", "height_scale_m", resistance.height_scale_m);
    }

    void write_inertia(Hdf5Writer &writer, const ReducedInertia &inertia, const int dimension)
    {
      if (!inertia.is_given())
        return;
      writer.write_matrix("/inertia/exponents", inertia.exponents,
                          {"1", "one monomial per row: exponents of the resistance's variables"});
      for (const auto &[name, material] :
           {std::pair<std::string, const InertiaPolynomials &>{"fluid", inertia.fluid}, {"tail", inertia.tail}})
      {
        writer.write_matrix("/inertia/" + name + "_factor_at_rest", material.factor_at_rest,
                            {dimension == 3 ? "m^(3/2) to m^(5/2)" : "m to m^2",
                             "L_0 of M = L_0 C C^T L_0^T at unit density, in two dimensions per unit depth"});
        writer.write_matrix(
            "/inertia/" + name + "_mass", material.mass,
            {"1", "one monomial per row; column i (i + 1) / 2 + j is entry (i, j) of C, log on the diagonal"});
        writer.write_matrix("/inertia/" + name + "_quadratic", material.quadratic,
                            {dimension == 3 ? "m^3 to m^5 (per m)" : "m^2 to m^4 (per m)",
                             "force i by velocities j and k, k <= j, at i n (n + 1) / 2 + j (j + 1) / 2 + k, beside "
                             "half of dM/dt; unit density"});
      }
      writer.write_attribute("/inertia", "head_area_m2", inertia.head_area_m2);
      writer.write_attribute("/inertia", "head_second_moment_m4", inertia.head_second_moment_m4);
    }

    /// The oldest one that has what the model has.
    int format_version_of(const ReducedModel &model)
    {
      constexpr int with_polynomials = 2, with_inertia = 3;
      if (model.dimension() == 3)
        return ReducedModel::format_version;
      if (model.inertia.is_given())
        return with_inertia;
      return model.tail.amplitudes.are_given() || model.resistance.depends_on_height ? with_polynomials : 1;
    }

    void require_format(const Hdf5Reader &reader, const std::filesystem::path &file)
    {
      if (!reader.has_attribute("/", "format") || reader.read_text_attribute("/", "format") != format_name)
        throw InputError(fmt::format(
            "{} is an HDF5 file, but not a reduced model; give one that `swimtwin train` made.", file.string()));
      const double version = reader.read_number_attribute("/", "format_version");
      if (!(version >= 1 && version <= ReducedModel::format_version && version == std::floor(version)))
        throw InputError(
            fmt::format("{} is a reduced model of format version {}, and this program reads versions 1 to {}; "
                        "train it again with this program, or use the one that made it.",
                        file.string(), version, ReducedModel::format_version));
    }

    Eigen::VectorXd read_column(const Hdf5Reader &reader, const std::string &path)
    {
      const std::vector<double> values = reader.read_vector(path);
      return Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
    }

    template <std::size_t size, typename Scalar>
    std::array<Scalar, size> exactly(const Hdf5Reader &reader, const std::string &path,
                                     const std::vector<Scalar> &values)
    {
      std::array<Scalar, size> array{};
      if (values.size() != size)
        reader.refuse(path, fmt::format("has {} values; {} are needed.", values.size(), size));
      std::copy(values.begin(), values.end(), array.begin());
      return array;
    }

    ShapePolynomials read_polynomials(const Hdf5Reader &reader, const std::string &path)
    {
      if (!reader.contains(path + "_exponents"))
        return {};
      return {read_column(reader, path + "_scale_m"), reader.read_int_matrix(path + "_exponents"),
              reader.read_matrix(path + "_coefficients")};
    }

    ReducedElasticity read_elasticity(const Hdf5Reader &reader)
    {
      ReducedElasticity elasticity;
      elasticity.poisson_ratio = reader.read_number_attribute("/elasticity", "poisson_ratio");
      elasticity.energy        = read_polynomials(reader, "/elasticity/energy");
      if (elasticity.energy.are_given())
        return elasticity;
      elasticity.gram_lambda = reader.read_matrix("/elasticity/gram_lambda");
      elasticity.gram_mu     = reader.read_matrix("/elasticity/gram_mu");
      return elasticity;
    }

    ReducedTail read_tail(const Hdf5Reader &reader)
    {
      ReducedTail tail;
      tail.nodes_m = reader.read_matrix("/tail/nodes_m");
      tail.cells   = reader.read_int_matrix("/tail/cells");
      tail.modes   = reader.read_matrix("/tail/modes");
      if (reader.contains("/tail/followers"))
        tail.followers = reader.read_matrix("/tail/followers");
      tail.amplitudes               = read_polynomials(reader, "/tail/amplitude");
      const std::vector<int> parity = reader.read_int_vector("/tail/parity");
      tail.parity                   = Eigen::VectorXi::Map(parity.data(), static_cast<Eigen::Index>(parity.size()));
      const std::string path        = "/tail/tip_nodes";
      const auto [before_tip, tip]  = exactly<2>(reader, path, reader.read_int_vector(path));
      tail.before_tip_node          = before_tip;
      tail.tip_node                 = tip;
      return tail;
    }

    ReducedMagnet read_magnet(const Hdf5Reader &reader)
    {
      const std::string path = "/magnet/tail_area_m2";
      const auto [x, y]      = exactly<2>(reader, path, reader.read_vector(path));
      return {reader.read_number_attribute("/magnet", "head_area_m2"),
              {x, y},
              reader.read_matrix("/magnet/tail_area_of_mode_m")};
    }

    ReducedResistance read_resistance(const Hdf5Reader &reader)
    {
      ReducedResistance resistance{reader.read_matrix("/resistance/factor_at_rest"),
                                   read_column(reader, "/resistance/coordinate_scale_m"),
                                   reader.read_number_attribute("/resistance", "depends_on_angle") != 0.,
                                   reader.read_number_attribute("/resistance", "angle_scale_rad"),
                                   reader.read_int_matrix("/resistance/exponents"),
                                   reader.read_matrix("/resistance/coefficients")};
      for (const char *path : half_fit_paths)
        if (reader.contains(path))
          resistance.half_fits.push_back(reader.read_matrix(path));
      resistance.depends_on_height = reader.contains("/resistance/usual_by_coordinate");
      if (!resistance.depends_on_height)
        return resistance;
      resistance.usual_by_coordinate = read_column(reader, "/resistance/usual_by_coordinate");
      resistance.usual_by_sine_m     = reader.read_number_attribute("/resistance", "usual_by_sine_m");
      resistance.height_scale_m      = reader.read_number_attribute("/resistance", "height_scale_m");
      return resistance;
    }

    ReducedInertia read_inertia(const Hdf5Reader &reader)
    {
      if (!reader.contains("/inertia/exponents"))
        return {};
      const auto material = [&](const std::string &name) {
        return InertiaPolynomials{reader.read_matrix("/inertia/" + name + "_factor_at_rest"),
                                  reader.read_matrix("/inertia/" + name + "_mass"),
                                  reader.read_matrix("/inertia/" + name + "_quadratic")};
      };
      return {reader.read_int_matrix("/inertia/exponents"), material("fluid"), material("tail"),
              reader.read_number_attribute("/inertia", "head_area_m2"),
              reader.read_number_attribute("/inertia", "head_second_moment_m4")};
    }

    TrainedRange read_range(const Hdf5Reader &reader)
    {
      TrainedRange range;
      for_each_interval(range, [&](const char *path, const char * /*units*/, Interval &interval) {
        const auto [low, high] = exactly<2>(reader, path, reader.read_vector(path));
        interval               = {low, high};
      });
      return range;
    }

  } // namespace

  void write_reduced_model(const std::filesystem::path &file, const ReducedModel &model, const Provenance &provenance)
  {
    if (const ModelProblem problem = find_problem(model); !problem.path.empty())
      throw ComputationError(fmt::format("cannot write {}: {} {}", file.string(), problem.path, problem.sentence));
    Hdf5Writer writer;
    writer.write_attribute("/", "format", format_name);
    writer.write_attribute("/", "format_version", format_version_of(model));
    write_provenance(writer, provenance);
    writer.write_attribute("/", "dimension", model.dimension());
    writer.write_text("/scene/name", model.scene_name, {"1", "name of the scene that the model was trained on"});
    writer.write_text("/scene/text", model.scene_text, {"1", "that scene (TOML): nominal parameters, field, time"});
    write_tail(writer, model.tail);
    write_elasticity(writer, model.elasticity, model.dimension());
    write_magnet(writer, model.magnet, model.dimension());
    write_area(writer, model.area);
    write_resistance(writer, model.resistance, model.dimension());
    write_inertia(writer, model.inertia, model.dimension());
    for_each_interval(model.range, [&](const char *path, const char *units, const Interval &interval) {
      writer.write_vector(path, std::array{interval.low, interval.high},
                          {units, "lowest and highest value in training"});
    });
    write_training_record(writer, model.record);
    writer.save(file);
  }

  ReducedModel read_reduced_model(const std::filesystem::path &file)
  {
    const Hdf5Reader reader(file);
    require_format(reader, file);
    ReducedModel model;
    model.scene_name = reader.read_text("/scene/name");
    model.scene_text = reader.read_text("/scene/text");
    model.tail       = read_tail(reader);
    model.elasticity = read_elasticity(reader);
    model.magnet     = read_magnet(reader);
    model.area       = {reader.read_number_attribute("/area", "is_kept") != 0., read_column(reader, "/area/linear_m"),
                        reader.read_matrix("/area/quadratic")};
    model.resistance = read_resistance(reader);
    model.inertia    = read_inertia(reader);
    model.range      = read_range(reader);
    model.record     = read_training_record(reader);
    if (reader.has_attribute("/", "dimension") && reader.read_number_attribute("/", "dimension") != model.dimension())
      reader.refuse("/tail/nodes_m",
                    fmt::format("has {} columns, and the file says another dimension.", model.dimension()));
    if (const ModelProblem problem = find_problem(model); !problem.path.empty())
      reader.refuse(problem.path, problem.sentence);
    return model;
  }
} // namespace swimtwin
