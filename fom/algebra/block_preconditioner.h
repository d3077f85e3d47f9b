// A preconditioner for a fluid with a body in it, made of what the unknowns are.
#pragma once

#include <petscksp.h>

#include <array>
#include <vector>

namespace swimtwin
{
  /// What an unknown is: a component of the fluid's velocity, the body's own (its surface, its inside, the head), or a
  /// pressure. The order is that of the blocks.
  enum class UnknownKind : unsigned char { velocity_x, velocity_y, velocity_z, body, pressure };
  constexpr int n_unknown_kinds = 5;

  /// For [A B^T; B 0] with velocities and pressures, block triangular from above (docs/equations.md, section 7).
  /// Pressures: the diagonal of their mass matrix over the viscosity, for the Schur complement. Velocities: one
  /// symmetric sweep between the fluid's, each component of which gets a cycle of algebraic multigrid, and the body's,
  /// which are solved for, so that no stiffness stops it.
  class BlockPreconditioner
  {
  public:
    /// Unknowns of this rank, [first_row, first_row + kinds.size()).
    BlockPreconditioner(MPI_Comm communicator, PetscInt first_row, const std::vector<UnknownKind> &kinds);
    ~BlockPreconditioner();
    BlockPreconditioner(const BlockPreconditioner &)            = delete;
    BlockPreconditioner &operator=(const BlockPreconditioner &) = delete;

    /// For the matrix as it is and masses of all unknowns, over the viscosity (those of velocities do not matter).
    /// False if the body's block, symmetric or not, could not be factorised. Collective; throws ComputationError.
    bool set_up(Mat matrix, Vec masses, bool symmetric);

    void apply(Vec x, Vec y);

  private:
    struct Block
    {
      IS         unknowns  = nullptr; ///< null where the system has none of its kind
      Vec        load      = nullptr;
      Vec        value     = nullptr;
      Vec        remainder = nullptr;
      VecScatter scatter   = nullptr;
      KSP        inverse   = nullptr; ///< an application of it

      bool is_empty() const { return unknowns == nullptr; }
    };
    Block &block(const UnknownKind kind) { return blocks_[static_cast<std::size_t>(kind)]; }
    /// The coupling that is used between two blocks.
    Mat &coupling(UnknownKind row, UnknownKind column);
    void take_submatrices(Mat matrix);
    PC   inverse_of(Block &block, Mat matrix);
    void lay_out(Vec whole);

    MPI_Comm                                                      communicator_;
    std::array<Block, n_unknown_kinds>                            blocks_;
    std::array<std::array<Mat, n_unknown_kinds>, n_unknown_kinds> couplings_{};
    Vec                                                           pressure_mass_ = nullptr;
    bool                                                          is_laid_out_   = false;
  };
} // namespace swimtwin
