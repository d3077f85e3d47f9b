#include <fom/factors/turned_axes.h>

#include <cmath>

namespace swimtwin
{
  void TurnedAxes::set_pairs(std::vector<Pair> pairs, const PetscInt first_row)
  {
    for (Pair &pair : pairs)
      for (PetscInt &unknown : pair)
        unknown -= first_row;
    pairs_ = std::move(pairs);
    angles_.assign(pairs_.size(), 0.);
    note_factors();
  }

  void TurnedAxes::turn(const Vec vector, const double sign) const
  {
    double *values;
    VecGetArray(vector, &values);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
    {
      const auto [x, y]  = pairs_[i];
      const double angle = sign * (angles_[i] - angles_of_factors_[i]), c = std::cos(angle), s = std::sin(angle);
      const double along_x = values[x];
      values[x]            = c * along_x - s * values[y];
      values[y]            = s * along_x + c * values[y];
    }
    VecRestoreArray(vector, &values);
  }
} // namespace swimtwin
