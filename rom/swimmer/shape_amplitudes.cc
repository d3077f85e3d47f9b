#include <rom/swimmer/shape_amplitudes.h>

namespace swimtwin
{
  namespace
  {
    constexpr int max_products = max_modes * (max_modes + 1) / 2;
    using ProductVector        = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_products, 1>;
  } // namespace

  ShapeAmplitudes::ShapeAmplitudes(const ReducedTail &tail) : r_(tail.n_coordinates()), followers_(tail.followers)
  {
    if (!tail.amplitudes.are_given())
      return;
    polynomials_.emplace(tail.amplitudes, tail.coordinate_parity());
    for (int k = 0; k < r_; ++k)
      derivatives_.emplace_back(derivative_of(tail.amplitudes, k), tail.coordinate_parity());
  }

  AmplitudeVector ShapeAmplitudes::value(const ShapeVector &q) const
  {
    if (polynomials_)
      return polynomials_->value(q);
    AmplitudeVector p(size());
    p.head(r_) = q;
    if (followers_.rows() == 0)
      return p;
    ProductVector products(followers_.cols());
    for (int i = 0, k = 0; i < r_; ++i)
      for (int j = 0; j <= i; ++j, ++k)
        products[k] = q[i] * q[j];
    p.tail(followers_.rows()).noalias() = followers_ * products;
    return p;
  }

  AmplitudeMatrix ShapeAmplitudes::slopes(const ShapeVector &q) const
  {
    if (polynomials_)
      return polynomials_->slopes(q);
    AmplitudeMatrix J = AmplitudeMatrix::Zero(size(), r_);
    J.topRows(r_).setIdentity();
    if (followers_.rows() == 0)
      return J;
    for (int i = 0, k = 0; i < r_; ++i)
      for (int j = 0; j <= i; ++j, ++k)
      {
        J.col(i).tail(followers_.rows()) += q[j] * followers_.col(k);
        J.col(j).tail(followers_.rows()) += q[i] * followers_.col(k);
      }
    return J;
  }

  ShapeVector ShapeAmplitudes::pull_back(const ShapeVector &q, const AmplitudeVector &by_amplitudes) const
  {
    if (polynomials_)
      return polynomials_->slopes(q).transpose() * by_amplitudes;
    ShapeVector by_q = by_amplitudes.head(r_);
    if (followers_.rows() == 0)
      return by_q;
    ProductVector by_products(followers_.cols());
    by_products.noalias() = followers_.transpose() * by_amplitudes.tail(followers_.rows());
    for (int i = 0, k = 0; i < r_; ++i)
      for (int j = 0; j <= i; ++j, ++k)
      {
        by_q[i] += by_products[k] * q[j];
        by_q[j] += by_products[k] * q[i];
      }
    return by_q;
  }

  ShapeMatrix ShapeAmplitudes::curvature(const ShapeVector &q, const AmplitudeVector &weights) const
  {
    ShapeMatrix H = ShapeMatrix::Zero(r_, r_);
    if (polynomials_)
    {
      for (int k = 0; k < r_; ++k)
        H.row(k).noalias() = weights.transpose() * derivatives_[static_cast<std::size_t>(k)].slopes(q);
      return H;
    }
    if (followers_.rows() == 0)
      return H;
    for (int i = 0, k = 0; i < r_; ++i)
      for (int j = 0; j <= i; ++j, ++k)
      {
        const double c = weights.tail(followers_.rows()).dot(followers_.col(k));
        H(i, j) += c;
        H(j, i) += c;
      }
    return H;
  }
} // namespace swimtwin
