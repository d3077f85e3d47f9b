// Assembly of P^T A P: cell matrices on nodal values become entries of a system on the unknowns.
#pragma once

#include <fom/algebra/linear_system.h>
#include <fom/unknowns/motion_map.h>

namespace swimtwin
{
  /// Remembers, for a fixed motion map, which unknowns each cell touches and where its entries go, so that assembling
  /// again is arithmetic alone. Cells are added in a fixed order, in which they are assembled ever after.
  template <int dim>
  class Condensation
  {
  public:
    explicit Condensation(const MotionMap<dim> &map) : map_(map) {}

    /// Describe one cell by its rows of the motion map, and how often it counts: a cell may stand for others that do
    /// the same. Returns its number.
    unsigned int add_cell(std::vector<unsigned int> rows, double weight = 1.);
    /// Describe a single entry.
    unsigned int add_entry(unsigned int row, unsigned int column);

    /// Give the pattern to the system. Collective.
    void lay_out(LinearSystem &system) const;

    /// Start a new assembly.
    void reset();
    /// Add P^T K P to the matrix and P^T (f - K imposed) to the right-hand side, times the cell's weight; K(i, j) and
    /// f(i) are called with local rows.
    template <typename Matrix, typename Vector>
    void add(unsigned int cell, const Matrix &K, const Vector &f);
    void add_to_entry(unsigned int entry, double value) { values_[entry_position_[entry]] += value; }

    std::vector<double>       &right_hand_side() { return rhs_; }
    const std::vector<double> &values() const { return values_; }

  private:
    struct Cell
    {
      std::vector<unsigned int> rows;
      std::vector<unsigned int> unknowns;    ///< distinct
      std::vector<unsigned int> slot;        ///< of each term of each row: index into unknowns
      std::size_t               first_value; ///< of its unknowns.size()^2 entries
      double                    weight;
    };
    const MotionMap<dim>    &map_;
    std::vector<Cell>        cells_;
    std::vector<std::size_t> entry_position_;
    std::vector<PetscInt>    pattern_rows_, pattern_columns_;
    std::vector<double>      values_, rhs_;
  };

  template <int dim>
  template <typename Matrix, typename Vector>
  void Condensation<dim>::add(const unsigned int number, const Matrix &K, const Vector &f)
  {
    const Cell        &cell = cells_[number];
    const unsigned int n = cell.rows.size(), m = cell.unknowns.size();
    double            *out    = values_.data() + cell.first_value;
    unsigned int       slot_i = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto *first_i = map_.begin(cell.rows[i]), *last_i = map_.end(cell.rows[i]);
      if (first_i == last_i)
        continue;
      double       load   = f[i];
      unsigned int slot_j = 0;
      for (unsigned int j = 0; j < n; ++j)
      {
        load -= K[i][j] * map_.imposed[cell.rows[j]];
        for (const auto *tj = map_.begin(cell.rows[j]), *last_j = map_.end(cell.rows[j]); tj != last_j; ++tj, ++slot_j)
        {
          const double value = cell.weight * K[i][j] * tj->coefficient;
          unsigned int s     = slot_i;
          for (const auto *ti = first_i; ti != last_i; ++ti, ++s)
            out[cell.slot[s] * m + cell.slot[slot_j]] += ti->coefficient * value;
        }
      }
      for (const auto *ti = first_i; ti != last_i; ++ti, ++slot_i)
        rhs_[ti->unknown] += cell.weight * ti->coefficient * load;
    }
  }
} // namespace swimtwin
