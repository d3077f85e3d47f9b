#include <fom/unknowns/condensation.h>

#include <tests/fom/random_tensors.h>

#include <deal.II/lac/full_matrix.h>
#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    using namespace dealii;

    /// Two cells of five rows each that share two; rows on the head, tied, imposed and free.
    struct TwoCells
    {
      MotionMap<2>                           map{6, 2, 0.5};
      std::vector<std::vector<unsigned int>> rows = {{0, 1, 2, 3, 6}, {3, 4, 5, 6, 7}};
      std::vector<FullMatrix<double>>        K    = {FullMatrix<double>(5, 5), FullMatrix<double>(5, 5)};
      std::vector<std::vector<double>>       f    = {std::vector<double>(5), std::vector<double>(5)};

      TwoCells()
      {
        RandomNumbers random;
        map.tie_to_head(0, 0, random.vector<2>());
        map.tie_to_head(1, 1, random.vector<2>());
        map.impose(2);
        map.tie(3, {6, 7});
        map.close(std::vector<unsigned int>(8, 0), true, MPI_COMM_WORLD);
        map.set_rotation(random.rotation<2>());
        map.imposed[2] = 1.5;
        for (auto &matrix : K)
          for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j)
              matrix(i, j) = random();
        for (auto &vector : f)
          for (auto &entry : vector)
            entry = random();
      }

      FullMatrix<double> dense_P() const
      {
        FullMatrix<double> P(map.n_rows(), map.n_unknowns());
        for (unsigned int row = 0; row < map.n_rows(); ++row)
          for (const auto *term = map.begin(row); term != map.end(row); ++term)
            P(row, term->unknown) += term->coefficient;
        return P;
      }
      FullMatrix<double> dense_K() const
      {
        FullMatrix<double> A(map.n_rows(), map.n_rows()); // the head's own rows have no cell here
        for (int c = 0; c < 2; ++c)
          for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j)
              A(rows[c][i], rows[c][j]) += K[c](i, j);
        return A;
      }
    };
  } // namespace

  TEST(Condensation, GivesTheDenseTripleProduct)
  {
    TwoCells        cells;
    const auto     &map = cells.map;
    Condensation<2> condensation(map);
    LinearSystem    system(MPI_COMM_WORLD, {});
    for (const auto &rows : cells.rows)
      condensation.add_cell(rows);
    const auto entry = condensation.add_entry(map.first_head_unknown() + 2, map.first_head_unknown() + 2);
    condensation.lay_out(system);
    for (int repetition = 0; repetition < 2; ++repetition) // assembling again starts from zero
    {
      condensation.reset();
      for (unsigned int c = 0; c < 2; ++c)
        condensation.add(c, cells.K[c], cells.f[c]);
      condensation.add_to_entry(entry, 10.);
    }
    system.set_matrix(condensation.values());

    const unsigned int n = map.n_unknowns();
    FullMatrix<double> expected(n, n), KP(map.n_rows(), n);
    const auto         P = cells.dense_P(), K = cells.dense_K();
    K.mmult(KP, P);
    P.Tmmult(expected, KP);
    expected(map.first_head_unknown() + 2, map.first_head_unknown() + 2) += 10.;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        const PetscInt row = i, column = j;
        PetscScalar    value = 0.;
        MatGetValues(system.matrix(), 1, &row, 1, &column, &value); // zero where the pattern has no entry
        EXPECT_NEAR(value, expected(i, j), 1e-13) << i << " " << j;
      }

    // Right-hand side: P^T (f - K imposed).
    std::vector<double> loads(8, 0.), rhs(n, 0.);
    for (int c = 0; c < 2; ++c)
      for (int i = 0; i < 5; ++i)
        loads[cells.rows[c][i]] += cells.f[c][i];
    for (unsigned int row = 0; row < 8; ++row)
      map.add_load(row, loads[row] - K(row, 2) * 1.5, rhs);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_NEAR(condensation.right_hand_side()[i], rhs[i], 1e-13);
  }
} // namespace swimtwin
