#include <rom/training/relaxed_tail.h>

#include <fom/elastic/nodal_vector.h>
#include <rom/swimmer/dense_algebra.h>

#include <cmath>

namespace swimtwin
{
  RelaxedTail::RelaxedTail(const Swimmer<2> &swimmer, const BendingCoordinates &coordinates)
      : swimmer_(swimmer), coordinates_(coordinates)
  {
  }

  RelaxedTail::Assembly RelaxedTail::assemble(const Eigen::VectorXd &displacement,
                                              const Eigen::VectorXd &multipliers) const
  {
    const auto         &mesh  = swimmer_.tail().mesh;
    const double        E     = swimmer_.scene().tail->young_modulus_Pa;
    const NodalField<2> field = nodal_field<2>(displacement);
    const Eigen::Index  n = displacement.size(), r = coordinates_.n_coordinates();
    Assembly            result{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, r), Eigen::VectorXd::Zero(r), {}};
    std::vector<Eigen::Triplet<double>> entries;
    const auto                          is_free = [&](const unsigned int node) { return !swimmer_.is_clamped(node); };

    ElasticTail<2>::CellForce   force;
    ElasticTail<2>::CellTangent tangent;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      swimmer_.elasticity().cell_force_and_tangent(c, field, force, tangent);
      for (unsigned int i = 0; i < force.size(); ++i)
      {
        const unsigned int a = mesh.cells[c][i / 2];
        result.force[2 * a + i % 2] += is_free(a) ? force[i] / E : 0.;
        for (unsigned int j = 0; j < force.size(); ++j)
          if (const unsigned int b = mesh.cells[c][j / 2]; is_free(a) && is_free(b))
            entries.emplace_back(2 * a + i % 2, 2 * b + j % 2, tangent[i][j] / E);
      }
    }

    const Eigen::VectorXd angles = coordinates_.rotations(displacement);
    for (std::size_t p = 0; p < coordinates_.points().size(); ++p)
    {
      const auto                        &point = coordinates_.points()[p];
      BendingCoordinates::NodeDerivative d;
      for (int a = 0; a < 6; ++a)
        d.segment<2>(2 * a) = displacement.segment<2>(2 * point.nodes[a]);
      // phi = Im log(s + i t): its derivatives are those of an analytic function.
      const double                             s = 2. + point.trace.dot(d), t = point.spin.dot(d), size = s * s + t * t;
      const double                             re = (s * s - t * t) / (size * size), im = 2. * s * t / (size * size);
      const auto                              &u = point.trace, &v = point.spin;
      const BendingCoordinates::NodeDerivative slope = (s * v - t * u) / size;
      const Eigen::Matrix<double, 12, 12>      bend =
          -(re * (u * v.transpose() + v * u.transpose()) - im * (u * u.transpose() - v * v.transpose()));
      const Eigen::VectorXd share = coordinates_.share(p);
      result.q += angles[static_cast<Eigen::Index>(p)] * share;
      const double weight = multipliers.dot(share);
      for (int i = 0; i < 12; ++i)
      {
        const unsigned int a = point.nodes[i / 2];
        if (!is_free(a))
          continue;
        result.constraints.row(2 * a + i % 2) += slope[i] * share.transpose();
        for (int j = 0; j < 12; ++j)
          if (const unsigned int b = point.nodes[j / 2]; is_free(b))
            entries.emplace_back(2 * a + i % 2, 2 * b + j % 2, -weight * bend(i, j));
      }
    }
    for (unsigned int a = 0; a < mesh.n_nodes(); ++a)
      if (!is_free(a))
        for (unsigned int i = 0; i < 2; ++i)
          entries.emplace_back(2 * a + i, 2 * a + i, 1.);
    result.tangent.resize(n, n);
    result.tangent.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  bool RelaxedTail::relax(const Eigen::VectorXd &q, RelaxedShape &shape)
  {
    constexpr int    n_iterations = 25;
    constexpr double tolerance    = 1e-9;
    const double     length       = coordinates_.length_m();
    for (int k = 0; k < n_iterations; ++k)
    {
      const Assembly at = assemble(shape.displacement, shape.slope_m);
      if (!is_analysed_)
        solver_.analyzePattern(at.tangent);
      is_analysed_ = true;
      solver_.factorize(at.tangent);
      if (solver_.info() != Eigen::Success)
        return false;
      const Eigen::VectorXd residual = at.force - at.constraints * shape.slope_m;
      const Eigen::VectorXd free     = solver_.solve(residual);
      const Eigen::MatrixXd held     = solver_.solve(at.constraints);
      const Eigen::MatrixXd S        = at.constraints.transpose() * held;
      const Eigen::VectorXd change   = solve_by_lu<Eigen::VectorXd>(S, q - at.q + at.constraints.transpose() * free);
      const Eigen::VectorXd step     = held * change - free;
      if (!step.allFinite())
        return false;
      shape.displacement += step;
      shape.slope_m += change;
      if (step.cwiseAbs().maxCoeff() < tolerance * length)
        return !swimmer_.elasticity().is_inverted(nodal_field<2>(shape.displacement));
    }
    return false;
  }

  std::vector<RelaxedShape> RelaxedTail::on_the_way_to(const Eigen::VectorXd &q, const int n)
  {
    const double              E = swimmer_.scene().tail->young_modulus_Pa;
    std::vector<RelaxedShape> shapes;
    RelaxedShape shape{Eigen::VectorXd::Zero(q.size()), Eigen::VectorXd::Zero(2 * swimmer_.tail().mesh.n_nodes()), 0.,
                       Eigen::VectorXd::Zero(q.size())};
    RelaxedShape before = shape;
    for (int k = 1; k <= n; ++k)
    {
      RelaxedShape next = shape;
      next.q            = q * k / n;
      if (k > 1)
      {
        next.displacement += shape.displacement - before.displacement;
        next.slope_m += shape.slope_m - before.slope_m;
      }
      if (!relax(next.q, next))
        break;
      next.energy_m2 = swimmer_.elasticity().energy(nodal_field<2>(next.displacement)) / E;
      before         = shape;
      shape          = next;
      shapes.push_back(next);
    }
    return shapes;
  }
} // namespace swimtwin
