// Factors of a matrix whose vectors have turned since: used in the axes that they were made in.
#pragma once

#include <petscvec.h>

#include <array>
#include <vector>

namespace swimtwin
{
  /// Pairs of unknowns that are one vector's components along x and y. Where a body turns, the matrix of old, seen in
  /// axes that turn with it, is near the new one for much longer than in those of the laboratory.
  class TurnedAxes
  {
  public:
    using Pair = std::array<PetscInt, 2>; ///< unknowns of this rank

    void set_pairs(std::vector<Pair> pairs, PetscInt first_row);
    /// By how much (rad) the axes of each pair are turned now, from wherever they are counted.
    void set_angles(std::vector<double> angles) { angles_ = std::move(angles); }
    /// Factors are made now.
    void note_factors() { angles_of_factors_ = angles_; }

    /// From the laboratory's axes as they are to those that the factors know, and back.
    void to_factors(Vec vector) const { turn(vector, -1.); }
    void from_factors(Vec vector) const { turn(vector, 1.); }

  private:
    void turn(Vec vector, double sign) const;

    std::vector<Pair>   pairs_; ///< by place on this rank
    std::vector<double> angles_, angles_of_factors_;
  };
} // namespace swimtwin
