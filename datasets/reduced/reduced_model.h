// The trained reduced swimmer as a file: what is needed to move it, to draw it, and to know when to trust it.
#pragma once

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  struct Provenance;

  /// Polynomials of the coordinates: value_k = sum_m coefficients(m, k) prod_i (q_i / scale_i)^exponents(m, i).
  struct ShapePolynomials
  {
    Eigen::VectorXd scale_m;      ///< r
    Eigen::MatrixXi exponents;    ///< one monomial per row, n x r
    Eigen::MatrixXd coefficients; ///< n x number of values

    bool are_given() const { return exponents.rows() > 0; }
  };

  /// Modes of the tail: d(X; q) = sum_k p_k(q) mode_k(X) in the head's frame. The amplitudes p (m) are the r
  /// coordinates q, then those of s followers, p_{r+k} = sum_{j <= i} followers(k, i (i + 1) / 2 + j) q_i q_j: a tail
  /// that bends shortens. Modes are orthonormal in the mean over the tail, (1/A) int mode_i . mode_j dX = delta_ij
  /// among coordinates and among followers, so that an amplitude is a root mean square displacement. Each has a parity
  /// under the mirror y -> -y: +1 if it keeps a symmetric tail symmetric, -1 if it bends it.
  ///
  /// Where `amplitudes` are given, no coordinate is the amplitude of a mode: coordinates are bending angles times the
  /// tail's length (m), all odd under the mirror, and p(q) are these polynomials. There are no followers then.
  struct ReducedTail
  {
    Eigen::MatrixXd nodes_m;    ///< n_nodes x dimension, reference configuration, origin at the head's centre
    Eigen::MatrixXi cells;      ///< n_cells x 6: three vertices, then midpoints of edges 01, 12, 20; in space n_cells x
                                ///< 10: four vertices, then midpoints of edges 01, 12, 20, 03, 13, 23
    Eigen::MatrixXd  modes;     ///< dimension n_nodes x (r + s), components interleaved (x0, y0, ...), zero on the head
    Eigen::MatrixXd  followers; ///< s x r (r + 1) / 2, in 1/m
    Eigen::VectorXi  parity;    ///< r + s
    int              tip_node = 0, before_tip_node = 0; ///< on the axis: the tip, and the middle of the last edge
    ShapePolynomials amplitudes = {};

    int dimension() const { return static_cast<int>(nodes_m.cols()); }
    /// How far a node moves in the plane of motion per amplitude, 2 x (r + s).
    Eigen::Matrix2Xd modes_in_plane(const Eigen::Index node) const { return modes.middleRows<2>(dimension() * node); }
    int              n_amplitudes() const { return static_cast<int>(modes.cols()); }
    int              n_coordinates() const
    {
      return amplitudes.are_given() ? static_cast<int>(amplitudes.exponents.cols())
                                    : n_amplitudes() - static_cast<int>(followers.rows());
    }
    Eigen::VectorXi coordinate_parity() const
    {
      return amplitudes.are_given() ? Eigen::VectorXi(Eigen::VectorXi::Constant(n_coordinates(), -1))
                                    : Eigen::VectorXi(parity.head(n_coordinates()));
    }
  };

  /// St Venant-Kirchhoff energy (J per metre of depth; in two dimensions alone) of the modes, exact: the strain is
  /// quadratic in the R = r + s amplitudes, so W = m^T (lambda G_lambda + mu_s G_mu) m with the monomials m = (p_1 ..
  /// p_R, p_1 p_1, p_2 p_1, p_2 p_2, p_3 p_1, ...), of degree 4 in p, and of degree 8 in q if there are followers.
  /// Where `energy` is given, W / E is that one polynomial (m^2, in space m^3), of any law, and there are no Gram
  /// matrices.
  struct ReducedElasticity
  {
    Eigen::MatrixXd  gram_lambda, gram_mu; ///< symmetric, m^2 times powers of 1/m
    double           poisson_ratio = 0.;
    ShapePolynomials energy        = {};
  };

  /// Index of p_i p_j (j <= i) among the strain monomials of R modes; linear ones come first.
  constexpr int strain_monomial(const int R, const int i, const int j)
  {
    return R + i * (i + 1) / 2 + j;
  }

  /// Moment per unit depth (A) in the head's frame: head_area_m2 M_head e_x, and for a magnetised tail
  /// M_tail (area_rest + sum_k p_k area_of_mode_k). The potential of both in a field is -B . R m. In space areas are
  /// volumes (m^3), and moments those of the body (A m^2); so it is with whatever is per unit depth below.
  struct ReducedMagnet
  {
    double          head_area_m2 = 0.;
    Eigen::Vector2d tail_area_m2 = Eigen::Vector2d::Zero();
    Eigen::MatrixXd tail_area_of_mode_m; ///< 2 x (r + s)
  };

  /// In a domain closed by walls the body keeps its area: linear . p + p^T quadratic p = 0, if the coordinates alone
  /// could change it. Followers that were fitted to bodies that keep their area leave nothing to keep.
  struct ReducedArea
  {
    bool            is_kept = false;
    Eigen::VectorXd linear_m;  ///< r + s
    Eigen::MatrixXd quadratic; ///< (r + s) x (r + s), symmetric
  };

  /// Resistance (unit viscosity, per unit depth) of the generalised velocities (R^T dx/dt, omega, dq/dt), n = r + 3:
  ///
  ///   R = L L^T, L = L_0 C(z), C lower triangular, C_ii = exp(p_ii(z)), C_ij = p_ij(z),
  ///
  /// with polynomials p in z = (q_1 / scale_1, ..., q_r / scale_r [, angle / angle_scale]). It is positive definite for
  /// every z. Outside the trained region |z_q| <= 1 (and |angle| <= angle_scale) the polynomials are evaluated at the
  /// point that `saturated` pulls back to it.
  ///
  /// Between walls the height matters as well: the last coordinate is then (y - a sin(angle) - b . q) / height_scale,
  /// how far the head's centre is above where it usually is at this angle and shape. All factors keep their leading
  /// blocks when the last modes are left out.
  struct ReducedResistance
  {
    Eigen::MatrixXd factor_at_rest;     ///< L_0, n x n, lower triangular
    Eigen::VectorXd coordinate_scale_m; ///< r
    bool            depends_on_angle = false;
    double          angle_scale_rad  = 1.;
    Eigen::MatrixXi exponents;    ///< n_features x (r, then the angle, then the height, if it depends on them)
    Eigen::MatrixXd coefficients; ///< n_features x n (n + 1) / 2; entry (i, j), j <= i, is column i (i + 1) / 2 + j
    /// The same, fitted to either half of the samples alone: how they differ tells how well the fit is known. Two, or
    /// none in files of before.
    std::vector<Eigen::MatrixXd> half_fits = {};

    bool            depends_on_height   = false;
    double          height_scale_m      = 1.;
    double          usual_by_sine_m     = 0.; ///< a
    Eigen::VectorXd usual_by_coordinate = {}; ///< b, r; empty without the height

    int n_pose_coordinates() const { return depends_on_angle + depends_on_height; }
  };

  /// Inertia of one material at unit density, per unit depth: with velocities xi it answers by the force
  ///
  ///   M dxi/dt + 1/2 dM/dt xi + (xi . N_i xi)_i,   xi_i N_i,jk summed over the permutations of i, j, k is zero,
  ///
  /// so that its power is the rate of the kinetic energy xi . M xi / 2. M = L L^T with L = L_0 C(z) like the
  /// resistance, positive definite for every z; z are the variables of the resistance, and one monomial is one row.
  struct InertiaPolynomials
  {
    Eigen::MatrixXd factor_at_rest; ///< L_0, n x n, lower triangular
    Eigen::MatrixXd mass;           ///< of C, columns as those of the resistance's coefficients, log on the diagonal
    Eigen::MatrixXd quadratic; ///< column i n (n + 1) / 2 + j (j + 1) / 2 + k: coefficient of xi_j xi_k, k <= j, in i

    bool are_given() const { return mass.size() > 0; }
  };

  /// Of the fluid as the Stokes flows carry it (right to first order in its density) and of the body. The head is rigid
  /// and moves about its own centre. Absent where it was not trained.
  struct ReducedInertia
  {
    Eigen::MatrixXi    exponents; ///< n_features x coordinates of the resistance
    InertiaPolynomials fluid, tail;
    double             head_area_m2 = 0., head_second_moment_m4 = 0.;

    bool is_given() const { return exponents.rows() > 0; }
  };

  /// Where radius rho >= 0 is evaluated: rho itself up to 1, then smoothly (twice differentiable) towards 1.1.
  double saturated(double rho);
  double saturated_slope(double rho); ///< its derivative
  double saturated_curvature(double rho);

  struct Interval
  {
    double low = 0., high = 0.;
    bool   contains(const double value) const { return value >= low && value <= high; }
    bool   operator==(const Interval &) const = default;
  };

  /// Where the model was trained.
  struct TrainedRange
  {
    Interval young_modulus_Pa, viscosity_Pa_s, magnetization_A_m, frequency_Hz, bx_T, by_T;
    bool     operator==(const TrainedRange &) const = default;
  };

  /// A run of the full-order model that was not used in training, and the reduced model's answer.
  struct HeldOutRun
  {
    double young_modulus_Pa = 0., viscosity_Pa_s = 0., magnetization_A_m = 0., frequency_Hz = 0., bx_T = 0., by_T = 0.;
    double displacement_m         = 0.; ///< of the third period, full-order
    double displacement_error_m   = 0.; ///< estimated, of the full-order run
    double reduced_displacement_m = 0., indicator_m = 0.;
    double fit_change_m = 0.; ///< what fits to half of the samples change in it
  };

  /// What was measured when the model was trained.
  struct TrainingRecord
  {
    Eigen::VectorXd          singular_values_m;    ///< of the snapshots, all that were computed
    double                   energy_captured = 0.; ///< sum of squares of the kept ones over that of all
    int                      n_snapshots = 0, n_resistance_samples = 0, n_held_out_samples = 0;
    double                   velocity_error_rms = 0., velocity_error_max = 0.; ///< at held-out shapes, relative
    double                   largest_condition = 0.; ///< of R scaled by its diagonal at rest, over the samples
    double                   cpu_time_s        = 0.;
    double                   target            = 0.; ///< relative error that was aimed at; 0: it was not written down
    std::vector<HeldOutRun>  held_out_runs;
    std::vector<std::string> neglects;   ///< physics that the model leaves out, one sentence each, with its size
    std::vector<int>         added_runs; ///< numbers of the full-order runs that were added to those of the design
    std::vector<std::string> history;    ///< how training came to its model and what it spent, one sentence each
  };

  struct ReducedModel
  {
    /// The newest; 1 knows no polynomials of shapes, 2 no inertia, 3 no space.
    static constexpr int format_version = 4;

    ReducedTail       tail;
    ReducedElasticity elasticity;
    ReducedMagnet     magnet;
    ReducedArea       area;
    ReducedResistance resistance;
    ReducedInertia    inertia = {};
    TrainedRange      range;
    TrainingRecord    record;
    std::string       scene_name, scene_text; ///< the scene it was trained on: nominal parameters, field, time

    int dimension() const { return tail.dimension(); }
    /// Coordinates q: each is the amplitude of a mode of its own.
    int n_modes() const { return tail.n_coordinates(); }
  };

  /// The model of the first n_modes coordinates alone, with all followers: the same projection on a smaller space.
  /// InputError if there are not as many.
  ReducedModel truncated(const ReducedModel &model, int n_modes);

  /// Layout: docs/file-formats.md. Throws ComputationError for a model that read_reduced_model would refuse.
  void write_reduced_model(const std::filesystem::path &file, const ReducedModel &model, const Provenance &provenance);
  /// Throws InputError that names the file and what is wrong: truncated, foreign, another format version, sizes that do
  /// not fit together, values that are not finite.
  ReducedModel read_reduced_model(const std::filesystem::path &file);
} // namespace swimtwin
