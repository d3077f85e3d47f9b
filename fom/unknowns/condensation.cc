#include <fom/unknowns/condensation.h>

#include <algorithm>

namespace swimtwin
{
  template <int dim>
  unsigned int Condensation<dim>::add_cell(std::vector<unsigned int> rows, const double weight)
  {
    Cell cell{std::move(rows), {}, {}, pattern_rows_.size(), weight};
    for (const auto row : cell.rows)
      for (const auto *term = map_.begin(row); term != map_.end(row); ++term)
      {
        auto found = std::find(cell.unknowns.begin(), cell.unknowns.end(), term->unknown);
        cell.slot.push_back(found - cell.unknowns.begin());
        if (found == cell.unknowns.end())
          cell.unknowns.push_back(term->unknown);
      }
    for (const auto i : cell.unknowns)
      for (const auto j : cell.unknowns)
      {
        pattern_rows_.push_back(i);
        pattern_columns_.push_back(j);
      }
    cells_.push_back(std::move(cell));
    return cells_.size() - 1;
  }

  template <int dim>
  unsigned int Condensation<dim>::add_entry(const unsigned int row, const unsigned int column)
  {
    entry_position_.push_back(pattern_rows_.size());
    pattern_rows_.push_back(row);
    pattern_columns_.push_back(column);
    return entry_position_.size() - 1;
  }

  template <int dim>
  void Condensation<dim>::lay_out(LinearSystem &system) const
  {
    system.set_pattern(map_.first_owned(), map_.last_owned(), pattern_rows_, pattern_columns_, dim);
  }

  template <int dim>
  void Condensation<dim>::reset()
  {
    values_.assign(pattern_rows_.size(), 0.);
    rhs_.assign(map_.n_unknowns(), 0.);
  }

  template class Condensation<2>;
  template class Condensation<3>;
} // namespace swimtwin
