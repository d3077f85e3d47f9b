#include <rom/training/basis_builder.h>

#include <rom/swimmer/dense_algebra.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    /// A bending mode of the snapshots that holds less than this share of the first one's amplitude is noise of their
    /// meshes and steps.
    constexpr double noise = 1e-5;
    /// Coordinates count as exercised up to at least this share of the largest one.
    constexpr double smallest_share = 0.004;

    double mean_square(const Eigen::MatrixXd &fields, const Eigen::SparseMatrix<double> &product)
    {
      return fields.cwiseProduct(product * fields).sum() / static_cast<double>(fields.cols());
    }
  } // namespace

  BasisBuilder::BasisBuilder(const TailSpace &space, const TailStiffness &stiffness, const MPI_Comm communicator)
      : space_(space), stiffness_(stiffness), communicator_(communicator), odd_(space.mean_product, communicator),
        even_(space.mean_product, communicator)
  {
  }

  void BasisBuilder::add(const SnapshotSet &set, const std::string &origin)
  {
    space_.require_same_mesh(set, origin);
    const Eigen::MatrixXd X = set.tail_displacement_m.transpose(), mirror = space_.mirrored(X);
    odd_.add((X - mirror) / 2.);
    even_.add((X + mirror) / 2.);
    snapshots_.push_back(X);
  }

  Eigen::MatrixXd BasisBuilder::snapshots() const
  {
    Eigen::MatrixXd X(space_.nodes_m.size(), n_snapshots());
    Eigen::Index    first = 0;
    for (const auto &part : snapshots_)
    {
      X.middleCols(first, part.cols()) = part;
      first += part.cols();
    }
    return X;
  }

  void BasisBuilder::choose_coordinates(TailBasis &basis, const int n) const
  {
    const Pod    odd     = odd_.compute(n);
    Eigen::Index n_clear = 0;
    while (n_clear < odd.modes.cols() && odd.singular_values(n_clear) > noise * odd.singular_values(0))
      ++n_clear;
    basis.coordinates = (odd.modes.leftCols(n_clear) - space_.mirrored(odd.modes.leftCols(n_clear))) / 2.;
    if (n_clear == n)
      return;
    const Eigen::MatrixXd elastic = stiffness_.bending_modes(n);
    for (Eigen::Index j = 0; j < elastic.cols() && basis.n_coordinates() < n; ++j)
      if (const Eigen::VectorXd left = space_.orthogonal_part(basis.coordinates, elastic.col(j));
          space_.norm(left) > 1e-3)
        append_column(basis.coordinates, left / space_.norm(left));
  }

  Eigen::VectorXd BasisBuilder::coordinate_sizes(const Eigen::MatrixXd &q) const
  {
    // Without snapshots: bent by a tenth of its length, higher modes less.
    const double    length = space_.nodes_m.cwiseAbs().maxCoeff();
    Eigen::VectorXd sizes  = Eigen::VectorXd::Zero(q.rows());
    if (q.cols() > 0)
      sizes = q.cwiseAbs().rowwise().maxCoeff();
    else
      for (Eigen::Index i = 0; i < sizes.size(); ++i)
        sizes(i) = .1 * length / static_cast<double>((i + 1) * (i + 1));
    return sizes.cwiseMax(smallest_share * sizes.maxCoeff());
  }

  Eigen::MatrixXd BasisBuilder::shortenings(const TailBasis &basis) const
  {
    const int       r = basis.n_coordinates();
    Eigen::MatrixXd fields(basis.coordinates.rows(), r * (r + 1) / 2);
    for (int i = 0, pair = 0; i < r; ++i)
      for (int j = 0; j <= i; ++j, ++pair)
        fields.col(pair) =
            (i == j ? 1. : 2.) * stiffness_.shortening(basis.coordinates.col(i), basis.coordinates.col(j));
    return fields;
  }

  void BasisBuilder::choose_followers(TailBasis &basis, const Eigen::MatrixXd &X, const int n) const
  {
    // A product that the snapshots exercise less than this share of the region's size keeps the elastic tail's answer.
    constexpr double      told  = 0.02;
    const Eigen::MatrixXd q     = space_.amplitudes(basis.coordinates, X);
    const Eigen::VectorXd sizes = products(coordinate_sizes(q));
    const Eigen::MatrixXd prior = shortenings(basis);

    PodBuilder even(space_.mean_product, communicator_);
    even.add((X + space_.mirrored(X)) / 2.);
    even.add(prior * sizes.asDiagonal()); // as if every product had been seen once, at its full size
    const Pod pod   = even.compute(n);
    basis.followers = (pod.modes + space_.mirrored(pod.modes)) / 2.;

    const Eigen::MatrixXd expected = space_.amplitudes(basis.followers, prior) * sizes.asDiagonal();
    const Eigen::Index    m = X.cols(), n_pairs = sizes.size();
    Eigen::MatrixXd       z(m + n_pairs, n_pairs), data(m + n_pairs, basis.n_followers());
    for (Eigen::Index k = 0; k < m; ++k)
      z.row(k) = products(q.col(k)).cwiseQuotient(sizes).transpose();
    const double weight   = told * std::sqrt(std::max<double>(m, 1.));
    z.bottomRows(n_pairs) = weight * Eigen::MatrixXd::Identity(n_pairs, n_pairs);
    data << space_.amplitudes(basis.followers, X).transpose(), weight * expected.transpose();
    const Eigen::MatrixXd scaled = solve_by_qr(z, data).transpose();
    basis.quadratic              = scaled * sizes.cwiseInverse().asDiagonal();
  }

  void BasisBuilder::record_quality(TailBasis &basis, const Eigen::MatrixXd &X) const
  {
    if (X.cols() == 0)
      return;
    const Eigen::MatrixXd q         = space_.amplitudes(basis.coordinates, X);
    Eigen::MatrixXd       left_over = X;
    for (Eigen::Index k = 0; k < X.cols(); ++k)
      left_over.col(k) -= basis.displacement(q.col(k));
    basis.projection_error_m = std::sqrt(mean_square(left_over, space_.mean_product));
    basis.energy_captured    = 1. - std::pow(basis.projection_error_m, 2) / mean_square(X, space_.mean_product);
    const Pod odd = odd_.compute(0), even = even_.compute(0);
    basis.singular_values.resize(odd.singular_values.size() + even.singular_values.size());
    basis.singular_values << odd.singular_values, even.singular_values;
    std::sort(basis.singular_values.begin(), basis.singular_values.end(), std::greater<>());
  }

  TailBasis BasisBuilder::compute(const int n_coordinates, const int n_followers) const
  {
    const Eigen::MatrixXd X = snapshots();
    TailBasis             basis;
    choose_coordinates(basis, n_coordinates);
    choose_followers(basis, X, n_followers);
    record_quality(basis, X);
    return basis;
  }
} // namespace swimtwin
