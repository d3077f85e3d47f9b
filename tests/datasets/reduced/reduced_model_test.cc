#include <datasets/reduced/reduced_model.h>

#include <datasets/files/hdf5_file.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <tests/datasets/temporary_folder.h>

#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    const Provenance of_a_training{"swimtwin 0.1.0", "train", "dimension = 2\n", "abc", "2025-01-31T12:00:00Z", 7.};

    ReducedTail example_tail(const int r)
    {
      ReducedTail tail;
      tail.nodes_m         = (Eigen::MatrixXd(6, 2) << 0, 0, 1, 0, 0, 1, .5, 0, .5, .5, 0, .5).finished();
      tail.cells           = (Eigen::MatrixXi(1, 6) << 0, 1, 2, 3, 4, 5).finished();
      tail.modes           = Eigen::MatrixXd::Random(12, r);
      tail.parity          = Eigen::VectorXi::Constant(r, -1);
      tail.before_tip_node = 3;
      tail.tip_node        = 1;
      return tail;
    }

    /// Random numbers of the right sizes, with the exponents of all squares and products.
    ReducedModel random_model(const int r = 3)
    {
      const int    n = r + 3, n_strains = strain_monomial(r, r, 0);
      ReducedModel model;
      model.tail      = example_tail(r);
      const auto gram = [&] {
        const Eigen::MatrixXd B = Eigen::MatrixXd::Random(n_strains, n_strains);
        return Eigen::MatrixXd(B * B.transpose());
      };
      model.elasticity          = {gram(), gram(), 0.4};
      model.magnet              = {0.75e-6, {4e-6, 0.}, Eigen::MatrixXd::Random(2, r)};
      const Eigen::MatrixXd Q   = Eigen::MatrixXd::Random(r, r);
      model.area                = {true, Eigen::VectorXd::Random(r), Q + Q.transpose()};
      auto &resistance          = model.resistance;
      resistance.factor_at_rest = Eigen::MatrixXd(Eigen::MatrixXd::Random(n, n).triangularView<Eigen::StrictlyLower>());
      resistance.factor_at_rest.diagonal().setConstant(2.);
      resistance.coordinate_scale_m     = Eigen::VectorXd::Constant(r, 1e-3);
      resistance.depends_on_angle       = true;
      resistance.angle_scale_rad        = 1.2;
      resistance.exponents              = Eigen::MatrixXi::Identity(r + 1, r + 1);
      resistance.coefficients           = Eigen::MatrixXd::Random(r + 1, n * (n + 1) / 2);
      model.range                       = {{4e4, 3e5}, {1.5, 1.6}, {5e4, 2e5}, {0.1, 3.}, {5e-3, 5e-3}, {5e-3, 6e-3}};
      model.record.singular_values_m    = Eigen::VectorXd::Random(r).cwiseAbs();
      model.record.energy_captured      = 0.99;
      model.record.n_snapshots          = 11;
      model.record.n_resistance_samples = 12;
      model.record.n_held_out_samples   = 13;
      model.record.velocity_error_rms   = 0.1;
      model.record.velocity_error_max   = 0.2;
      model.record.largest_condition    = 30.;
      model.record.cpu_time_s           = 5.;
      model.record.held_out_runs        = {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, {11, 12, 13, 14, 15, 16, 17, 18, 19, 20}};
      model.record.neglects             = {"Inertia: 0.3.", "Walls."};
      model.scene_name                  = "example";
      model.scene_text                  = "dimension = 2\n";
      return model;
    }

    /// Put another number in the place of one that occurs once in the file.
    void replace_number(const std::filesystem::path &file, const double old_value, const double new_value)
    {
      const auto bytes = [](const double value) {
        return std::string(reinterpret_cast<const char *>(&value), sizeof value);
      };
      std::string text = content(file);
      const auto  at   = text.find(bytes(old_value));
      ASSERT_NE(at, std::string::npos);
      text.replace(at, sizeof(double), bytes(new_value));
      std::ofstream(file, std::ios::binary) << text;
    }

    /// The message of the rule that a model breaks.
    std::string broken_rule(const ReducedModel &model)
    {
      const TemporaryFolder folder;
      return message_of<ComputationError>([&] { write_reduced_model(folder.path / "model.h5", model, of_a_training); });
    }
  } // namespace

  TEST(ReducedModel, RoundTripKeepsEveryBit)
  {
    const TemporaryFolder folder;
    const ReducedModel    written = random_model();
    write_reduced_model(folder.path / "model.h5", written, of_a_training);
    const ReducedModel read = read_reduced_model(folder.path / "model.h5");
    EXPECT_EQ(read.tail.nodes_m, written.tail.nodes_m);
    EXPECT_EQ(read.tail.cells, written.tail.cells);
    EXPECT_EQ(read.tail.modes, written.tail.modes);
    EXPECT_EQ(read.tail.parity, written.tail.parity);
    EXPECT_EQ(read.tail.tip_node, 1);
    EXPECT_EQ(read.tail.before_tip_node, 3);
    EXPECT_EQ(read.elasticity.gram_lambda, written.elasticity.gram_lambda);
    EXPECT_EQ(read.elasticity.gram_mu, written.elasticity.gram_mu);
    EXPECT_EQ(read.elasticity.poisson_ratio, 0.4);
    EXPECT_EQ(read.magnet.head_area_m2, written.magnet.head_area_m2);
    EXPECT_EQ(read.magnet.tail_area_m2, written.magnet.tail_area_m2);
    EXPECT_EQ(read.magnet.tail_area_of_mode_m, written.magnet.tail_area_of_mode_m);
    EXPECT_TRUE(read.area.is_kept);
    EXPECT_EQ(read.area.linear_m, written.area.linear_m);
    EXPECT_EQ(read.area.quadratic, written.area.quadratic);
    EXPECT_EQ(read.resistance.factor_at_rest, written.resistance.factor_at_rest);
    EXPECT_EQ(read.resistance.coordinate_scale_m, written.resistance.coordinate_scale_m);
    EXPECT_TRUE(read.resistance.depends_on_angle);
    EXPECT_EQ(read.resistance.angle_scale_rad, 1.2);
    EXPECT_EQ(read.resistance.exponents, written.resistance.exponents);
    EXPECT_EQ(read.resistance.coefficients, written.resistance.coefficients);
    EXPECT_EQ(read.range.young_modulus_Pa.high, 3e5);
    EXPECT_EQ(read.range.by_T.high, 6e-3);
    EXPECT_EQ(read.record.singular_values_m, written.record.singular_values_m);
    EXPECT_EQ(read.record.n_held_out_samples, 13);
    EXPECT_EQ(read.record.largest_condition, 30.);
    ASSERT_EQ(read.record.held_out_runs.size(), 2u);
    EXPECT_EQ(read.record.held_out_runs[1].indicator_m, 20.);
    EXPECT_EQ(read.record.neglects, written.record.neglects);
    EXPECT_EQ(read.scene_name, "example");
    EXPECT_EQ(read.scene_text, written.scene_text);
  }

  // Format version 2: bending coordinates, and the height between walls.
  TEST(ReducedModel, RoundTripKeepsPolynomialsOfShapesAndTheHeight)
  {
    const TemporaryFolder  folder;
    ReducedModel           written    = random_model();
    const ShapePolynomials amplitudes = {Eigen::Vector2d(1e-3, 2e-3),
                                         (Eigen::MatrixXi(3, 2) << 1, 0, 0, 1, 2, 1).finished(),
                                         Eigen::MatrixXd::Random(3, 3)};
    written.tail.amplitudes           = amplitudes;
    written.elasticity = {{}, {}, .4, {amplitudes.scale_m, amplitudes.exponents * 2, Eigen::MatrixXd::Random(3, 1)}};
    auto                   &resistance = written.resistance;
    const ReducedResistance few        = truncated(random_model(), 2).resistance;
    resistance.factor_at_rest          = few.factor_at_rest;
    resistance.coordinate_scale_m      = few.coordinate_scale_m;
    resistance.exponents               = Eigen::MatrixXi::Identity(4, 4);
    resistance.coefficients            = Eigen::MatrixXd::Random(4, 15);
    resistance.depends_on_height       = true;
    resistance.height_scale_m          = 3e-4;
    resistance.usual_by_sine_m         = -2e-3;
    resistance.usual_by_coordinate     = Eigen::Vector2d(.1, -.2);
    written.area                       = {false, Eigen::VectorXd::Zero(3), Eigen::MatrixXd::Zero(3, 3)};
    write_reduced_model(folder.path / "model.h5", written, of_a_training);
    EXPECT_EQ(Hdf5Reader(folder.path / "model.h5").read_number_attribute("/", "format_version"), 2.);
    const ReducedModel read = read_reduced_model(folder.path / "model.h5");
    EXPECT_EQ(read.n_modes(), 2);
    EXPECT_EQ(read.tail.amplitudes.scale_m, amplitudes.scale_m);
    EXPECT_EQ(read.tail.amplitudes.exponents, amplitudes.exponents);
    EXPECT_EQ(read.tail.amplitudes.coefficients, amplitudes.coefficients);
    EXPECT_EQ(read.elasticity.energy.exponents, written.elasticity.energy.exponents);
    EXPECT_EQ(read.elasticity.energy.coefficients, written.elasticity.energy.coefficients);
    EXPECT_TRUE(read.resistance.depends_on_height);
    EXPECT_EQ(read.resistance.height_scale_m, 3e-4);
    EXPECT_EQ(read.resistance.usual_by_sine_m, -2e-3);
    EXPECT_EQ(read.resistance.usual_by_coordinate, resistance.usual_by_coordinate);
    EXPECT_EQ(read.resistance.exponents, resistance.exponents);
  }

  TEST(ReducedModel, RoundTripKeepsWhatTellsTheFitsErrorAndTheTrainingsHistory)
  {
    const TemporaryFolder folder;
    ReducedModel          written                = random_model();
    const Eigen::MatrixXd half                   = Eigen::MatrixXd::Random(4, 21);
    written.resistance.half_fits                 = {half, 2. * half};
    written.record.held_out_runs[1].fit_change_m = 7e-7;
    written.record.history                       = {"4 modes.", "5 modes."};
    written.record.added_runs                    = {2001, 2072};
    write_reduced_model(folder.path / "model.h5", written, of_a_training);
    const ReducedModel read = read_reduced_model(folder.path / "model.h5");
    ASSERT_EQ(read.resistance.half_fits.size(), 2u);
    EXPECT_EQ(read.resistance.half_fits[1], 2. * half);
    EXPECT_EQ(read.record.held_out_runs[1].fit_change_m, 7e-7);
    EXPECT_EQ(read.record.history, written.record.history);
    EXPECT_EQ(read.record.added_runs, written.record.added_runs);
    written.resistance.half_fits.pop_back();
    expect_in(broken_rule(written), "/resistance holds one fit to half of the samples");
  }

  TEST(ReducedModel, RoundTripKeepsARigidSwimmer)
  {
    const TemporaryFolder folder;
    ReducedModel          rigid = truncated(random_model(), 0);
    rigid.area                  = {false, Eigen::VectorXd(0), Eigen::MatrixXd(0, 0)};
    write_reduced_model(folder.path / "model.h5", rigid, of_a_training);
    EXPECT_EQ(read_reduced_model(folder.path / "model.h5").n_modes(), 0);
  }

  TEST(ReducedModel, CarriesProvenance)
  {
    const TemporaryFolder folder;
    write_reduced_model(folder.path / "model.h5", random_model(), of_a_training);
    const Hdf5Reader reader(folder.path / "model.h5");
    EXPECT_EQ(reader.read_text_attribute("/", "scene_hash"), "abc");
    EXPECT_EQ(reader.read_text_attribute("/resistance/coordinate_scale_m", "units"), "m");
  }

  TEST(ReducedModel, RefusesATruncatedFile)
  {
    const TemporaryFolder folder;
    const auto            file = folder.path / "model.h5";
    write_reduced_model(file, random_model(), of_a_training);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    expect_in(message_of<InputError>([&] { read_reduced_model(file); }), "model.h5: it was cut short");
  }

  TEST(ReducedModel, RefusesAForeignFile)
  {
    const TemporaryFolder folder;
    Hdf5Writer            writer;
    writer.write_matrix("/tail/nodes_m", Eigen::MatrixXd(Eigen::MatrixXd::Zero(6, 2)), {"m", "nodes"});
    writer.save(folder.path / "snapshots.h5");
    const std::string message = message_of<InputError>([&] { read_reduced_model(folder.path / "snapshots.h5"); });
    expect_in(message, "snapshots.h5 is an HDF5 file, but not a reduced model");
    expect_in(message, "swimtwin train");
  }

  // Format version 4: a tail of tetrahedra.
  TEST(ReducedModel, RoundTripKeepsSpace)
  {
    const TemporaryFolder folder;
    ReducedModel          written = random_model();
    written.tail.nodes_m          = Eigen::MatrixXd::Random(10, 3);
    written.tail.cells            = Eigen::RowVectorXi::LinSpaced(10, 0, 9);
    written.tail.modes            = Eigen::MatrixXd::Random(30, 3);
    const ShapePolynomials straight{Eigen::Vector3d::Ones(), Eigen::Matrix3i::Identity(), Eigen::Matrix3d::Identity()};
    written.tail.amplitudes = straight;
    written.elasticity      = {{}, {}, .4, {straight.scale_m, straight.exponents * 2, Eigen::MatrixXd::Ones(3, 1)}};
    write_reduced_model(folder.path / "model.h5", written, of_a_training);
    const Hdf5Reader file(folder.path / "model.h5");
    EXPECT_EQ(file.read_number_attribute("/", "format_version"), 4.);
    EXPECT_EQ(file.read_number_attribute("/", "dimension"), 3.);
    const ReducedModel read = read_reduced_model(folder.path / "model.h5");
    EXPECT_EQ(read.dimension(), 3);
    EXPECT_EQ(read.tail.nodes_m, written.tail.nodes_m);
    EXPECT_EQ(read.tail.cells, written.tail.cells);
    EXPECT_EQ(read.tail.modes, written.tail.modes);
    written.tail.cells = Eigen::MatrixXi::Zero(1, 6);
    expect_in(broken_rule(written), "/tail/cells has 1 x 6 values; 1 x 10 are needed");
  }

  TEST(ReducedModel, RefusesAnotherFormatVersion)
  {
    const TemporaryFolder folder;
    Hdf5Writer            writer;
    writer.write_attribute("/", "format", "swimtwin reduced model");
    writer.write_attribute("/", "format_version", 5.);
    writer.save(folder.path / "model.h5");
    const std::string message = message_of<InputError>([&] { read_reduced_model(folder.path / "model.h5"); });
    expect_in(message, "format version 5, and this program reads versions 1 to 4");
    expect_in(message, "train it again");
  }

  TEST(ReducedModel, NamesWhatIsMissing)
  {
    const TemporaryFolder folder;
    Hdf5Writer            writer;
    writer.write_attribute("/", "format", "swimtwin reduced model");
    writer.write_attribute("/", "format_version", 1.);
    writer.save(folder.path / "model.h5");
    expect_in(message_of<InputError>([&] { read_reduced_model(folder.path / "model.h5"); }),
              "model.h5: /scene/name is missing");
  }

  TEST(ReducedModel, IsCheckedWhenRead)
  {
    const TemporaryFolder folder;
    const auto            file             = folder.path / "model.h5";
    ReducedModel          model            = random_model();
    model.resistance.coordinate_scale_m[1] = 0.123456789;
    write_reduced_model(file, model, of_a_training);
    replace_number(file, 0.123456789, std::numeric_limits<double>::quiet_NaN());
    expect_in(message_of<InputError>([&] { read_reduced_model(file); }),
              "model.h5: /resistance/coordinate_scale_m holds a value that is not finite; train the model again");
  }

  TEST(ReducedModel, NamesValuesThatAreNotFinite)
  {
    ReducedModel model                  = random_model();
    model.resistance.coefficients(1, 2) = std::numeric_limits<double>::quiet_NaN();
    expect_in(broken_rule(model), "/resistance/coefficients holds a value that is not finite");
    model                          = random_model();
    model.elasticity.gram_mu(0, 0) = std::numeric_limits<double>::infinity();
    expect_in(broken_rule(model), "/elasticity/gram_mu holds a value that is not finite");
  }

  TEST(ReducedModel, NamesSizesThatDoNotFitTogether)
  {
    ReducedModel model = random_model();
    model.tail.modes.conservativeResize(10, 3);
    expect_in(broken_rule(model), "/tail/modes has 10 x 3 values; 12 x 3 are needed");
    model = random_model();
    model.resistance.coefficients.conservativeResize(4, 20);
    expect_in(broken_rule(model), "/resistance/coefficients has 4 x 20 values; 4 x 21 are needed");
    model                             = random_model();
    model.resistance.depends_on_angle = false;
    expect_in(broken_rule(model), "/resistance/exponents has 4 x 4 values; 4 x 3 are needed");
    model                  = random_model();
    model.tail.cells(0, 0) = 6;
    expect_in(broken_rule(model), "/tail/cells names a node that is not in 0 to 5");
    model               = random_model();
    model.tail.tip_node = -1;
    expect_in(broken_rule(model), "/tail/tip_nodes names a node");
  }

  TEST(ReducedModel, NamesValuesThatMakeNoSense)
  {
    ReducedModel model                    = random_model();
    model.resistance.factor_at_rest(1, 1) = 0.;
    expect_in(broken_rule(model), "/resistance/factor_at_rest is not lower triangular with a positive diagonal");
    model                                  = random_model();
    model.resistance.coordinate_scale_m[0] = -1.;
    expect_in(broken_rule(model), "/resistance/coordinate_scale_m holds a number that is not positive");
    model                          = random_model();
    model.elasticity.poisson_ratio = 0.5;
    expect_in(broken_rule(model), "/elasticity has poisson_ratio = 0.5; it must lie between -1 and 0.5");
    model = random_model();
    model.elasticity.gram_lambda(0, 1) += 1.;
    expect_in(broken_rule(model), "/elasticity/gram_lambda is not symmetric");
    model                = random_model();
    model.tail.parity[1] = 0;
    expect_in(broken_rule(model), "/tail/parity holds a number that is neither 1 nor -1");
    model                    = random_model();
    model.range.frequency_Hz = {3., 0.1};
    expect_in(broken_rule(model), "/range/frequency_Hz holds 3 to 0.1");
  }

  TEST(ReducedModel, SaturationIsSmoothAndBounded)
  {
    EXPECT_EQ(saturated(0.3), 0.3);
    EXPECT_EQ(saturated(1.), 1.);
    EXPECT_LE(saturated(1e6), 1.1);
    for (const double rho : {0.5, 1., 1.001, 1.05, 1.3})
    {
      constexpr double h = 1e-6;
      EXPECT_NEAR(saturated_slope(rho), (saturated(rho + h) - saturated(rho - h)) / (2. * h), 1e-8);
    }
    EXPECT_NEAR(saturated_slope(1. + 1e-5), 1., 1e-7); // the second derivative is continuous too
  }

  TEST(ReducedModel, TruncatedKeepsWhatBelongsToTheFirstModes)
  {
    const ReducedModel all = random_model(), few = truncated(all, 2);
    EXPECT_EQ(few.n_modes(), 2);
    EXPECT_EQ(few.tail.modes, all.tail.modes.leftCols(2));
    EXPECT_EQ(few.elasticity.gram_mu(strain_monomial(2, 1, 0), 1), all.elasticity.gram_mu(strain_monomial(3, 1, 0), 1));
    EXPECT_EQ(few.resistance.exponents, (Eigen::MatrixXi(3, 3) << 1, 0, 0, 0, 1, 0, 0, 0, 1).finished());
    EXPECT_EQ(few.resistance.coefficients.row(2), all.resistance.coefficients.row(3).head(15));
    EXPECT_EQ(truncated(all, 3).elasticity.gram_mu, all.elasticity.gram_mu);
    expect_in(message_of<InputError>([&] { truncated(all, 4); }), "4 modes were asked of a reduced model that has 3");
  }

  TEST(ReducedModel, TruncatedLetsGoOfAnAreaThatNoModeIsLeftToKeep)
  {
    ReducedModel model  = random_model();
    model.area.linear_m = Eigen::Vector3d(0., 0., 1e-3);
    EXPECT_FALSE(truncated(model, 2).area.is_kept);
    EXPECT_TRUE(truncated(model, 3).area.is_kept);
  }

  namespace
  {
    ReducedModel inertial_model()
    {
      ReducedModel    model = random_model();
      constexpr int   n = 6, n_pairs = 21, n_features = 4;
      Eigen::MatrixXd factor   = Eigen::MatrixXd::Identity(n, n);
      const auto      material = [&] {
        return InertiaPolynomials{factor, Eigen::MatrixXd::Random(n_features, n_pairs),
                                  Eigen::MatrixXd::Random(n_features, n * n_pairs)};
      };
      model.inertia = {Eigen::MatrixXi::Identity(n_features, n_features), material(), material(), 1e-6, 2e-13};
      return model;
    }
  } // namespace

  TEST(ReducedModel, KeepsItsInertiaInVersionThree)
  {
    const TemporaryFolder folder;
    const ReducedModel    written = inertial_model();
    write_reduced_model(folder.path / "model.h5", written, of_a_training);
    EXPECT_EQ(Hdf5Reader(folder.path / "model.h5").read_number_attribute("/", "format_version"), 3.);
    const ReducedInertia read = read_reduced_model(folder.path / "model.h5").inertia;
    EXPECT_EQ(read.exponents, written.inertia.exponents);
    EXPECT_EQ(read.fluid.factor_at_rest, written.inertia.fluid.factor_at_rest);
    EXPECT_EQ(read.fluid.mass, written.inertia.fluid.mass);
    EXPECT_EQ(read.fluid.quadratic, written.inertia.fluid.quadratic);
    EXPECT_EQ(read.tail.mass, written.inertia.tail.mass);
    EXPECT_EQ(read.tail.quadratic, written.inertia.tail.quadratic);
    EXPECT_EQ(read.head_area_m2, 1e-6);
    EXPECT_EQ(read.head_second_moment_m4, 2e-13);
  }

  TEST(ReducedModel, InertiaOfAnotherSizeIsRefused)
  {
    ReducedModel model = inertial_model();
    model.inertia.tail.quadratic.conservativeResize(4, 7);
    EXPECT_NE(broken_rule(model).find("/inertia/tail_quadratic has 4 x 7 values; 4 x 126 are needed."),
              std::string::npos);
    model                                    = inertial_model();
    model.inertia.fluid.factor_at_rest(2, 2) = -1.;
    EXPECT_NE(broken_rule(model).find("/inertia/fluid_factor_at_rest is not lower triangular"), std::string::npos);
    model                      = inertial_model();
    model.inertia.head_area_m2 = -1.;
    EXPECT_NE(broken_rule(model).find("head_area_m2 = -1; it must not be negative"), std::string::npos);
  }
} // namespace swimtwin
