#include <fom/algebra/block_preconditioner.h>

#include <fom/factors/petsc_error.h>

#include <string>
#include <utility>

namespace swimtwin
{
  namespace
  {
    constexpr std::array  components{UnknownKind::velocity_x, UnknownKind::velocity_y, UnknownKind::velocity_z};
    constexpr const char *prefix = "swimtwin_velocity_";

    /// A cycle of BoomerAMG for one component of a velocity; in space more strong couplings are too many.
    void choose_multigrid(const KSP ksp, const PC pc)
    {
      for (const auto &[name, value] : {std::pair{"strong_threshold", "0.5"}, std::pair{"agg_nl", "1"}})
        check_petsc(
            PetscOptionsSetValue(nullptr, (std::string("-") + prefix + "pc_hypre_boomeramg_" + name).c_str(), value),
            "chose multigrid");
      check_petsc(KSPSetOptionsPrefix(ksp, prefix), "chose multigrid");
      check_petsc(PCSetType(pc, PCHYPRE), "chose multigrid");
      check_petsc(PCHYPRESetType(pc, "boomeramg"), "chose multigrid");
      check_petsc(PCSetFromOptions(pc), "chose multigrid");
    }

    void choose_factors(const PC pc, const bool symmetric)
    {
      check_petsc(PCSetType(pc, symmetric ? PCCHOLESKY : PCLU), "chose factors");
      check_petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), "chose factors");
    }
  } // namespace

  BlockPreconditioner::BlockPreconditioner(const MPI_Comm communicator, const PetscInt first_row,
                                           const std::vector<UnknownKind> &kinds)
      : communicator_(communicator)
  {
    std::array<std::vector<PetscInt>, n_unknown_kinds> rows;
    for (std::size_t i = 0; i < kinds.size(); ++i)
      rows[static_cast<std::size_t>(kinds[i])].push_back(first_row + static_cast<PetscInt>(i));
    for (int k = 0; k < n_unknown_kinds; ++k)
    {
      const auto &own   = rows[static_cast<std::size_t>(k)];
      PetscInt    total = static_cast<PetscInt>(own.size());
      MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPIU_INT, MPI_SUM, communicator_);
      if (total > 0)
        check_petsc(ISCreateGeneral(communicator_, static_cast<PetscInt>(own.size()), own.data(), PETSC_COPY_VALUES,
                                    &blocks_[static_cast<std::size_t>(k)].unknowns),
                    "sorted unknowns");
    }
  }

  BlockPreconditioner::~BlockPreconditioner()
  {
    for (auto &row : couplings_)
      for (auto &matrix : row)
        MatDestroy(&matrix);
    for (auto &b : blocks_)
    {
      KSPDestroy(&b.inverse);
      VecScatterDestroy(&b.scatter);
      for (Vec *vector : {&b.load, &b.value, &b.remainder})
        VecDestroy(vector);
      ISDestroy(&b.unknowns);
    }
    VecDestroy(&pressure_mass_);
  }

  Mat &BlockPreconditioner::coupling(const UnknownKind row, const UnknownKind column)
  {
    return couplings_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }

  void BlockPreconditioner::take_submatrices(const Mat matrix)
  {
    const MatReuse reuse = is_laid_out_ ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX;
    const auto     take  = [&](const UnknownKind row, const UnknownKind column) {
      if (!block(row).is_empty() && !block(column).is_empty())
        check_petsc(
                 MatCreateSubMatrix(matrix, block(row).unknowns, block(column).unknowns, reuse, &coupling(row, column)),
                 "took a matrix apart");
    };
    for (const auto c : components)
    {
      take(c, c);
      take(c, UnknownKind::body);
      take(UnknownKind::body, c);
      take(c, UnknownKind::pressure);
    }
    take(UnknownKind::body, UnknownKind::body);
    take(UnknownKind::body, UnknownKind::pressure);
  }

  void BlockPreconditioner::lay_out(const Vec whole)
  {
    for (auto &b : blocks_)
      if (!b.is_empty())
      {
        PetscInt n;
        check_petsc(ISGetLocalSize(b.unknowns, &n), "made vectors");
        check_petsc(VecCreateMPI(communicator_, n, PETSC_DETERMINE, &b.load), "made vectors");
        check_petsc(VecDuplicate(b.load, &b.value), "made vectors");
        check_petsc(VecDuplicate(b.load, &b.remainder), "made vectors");
        check_petsc(VecScatterCreate(whole, b.unknowns, b.load, nullptr, &b.scatter), "made vectors");
      }
    check_petsc(VecDuplicate(block(UnknownKind::pressure).load, &pressure_mass_), "made vectors");
    is_laid_out_ = true;
  }

  PC BlockPreconditioner::inverse_of(Block &b, const Mat matrix)
  {
    PC pc;
    if (!b.inverse)
    {
      check_petsc(KSPCreate(communicator_, &b.inverse), "made a solver");
      check_petsc(KSPSetType(b.inverse, KSPPREONLY), "made a solver");
    }
    check_petsc(KSPGetPC(b.inverse, &pc), "made a solver");
    check_petsc(KSPSetOperators(b.inverse, matrix, matrix), "made a solver");
    return pc;
  }

  bool BlockPreconditioner::set_up(const Mat matrix, const Vec masses, const bool symmetric)
  {
    take_submatrices(matrix);
    if (!is_laid_out_)
      lay_out(masses);
    Block &p = block(UnknownKind::pressure), &body = block(UnknownKind::body);
    check_petsc(VecScatterBegin(p.scatter, masses, pressure_mass_, INSERT_VALUES, SCATTER_FORWARD), "took masses");
    check_petsc(VecScatterEnd(p.scatter, masses, pressure_mass_, INSERT_VALUES, SCATTER_FORWARD), "took masses");
    for (const auto c : components)
      if (Block &u = block(c); !u.is_empty())
      {
        choose_multigrid(u.inverse, inverse_of(u, coupling(c, c)));
        check_petsc(KSPSetUp(u.inverse), "set up multigrid");
      }
    if (body.is_empty())
      return true;
    const PC       pc = inverse_of(body, coupling(UnknownKind::body, UnknownKind::body));
    PCFailedReason failure;
    choose_factors(pc, symmetric);
    check_petsc(KSPSetUp(body.inverse), "factorised");
    check_petsc(PCGetFailedReason(pc, &failure), "factorised");
    return failure == PC_NOERROR;
  }

  void BlockPreconditioner::apply(const Vec x, const Vec y)
  {
    const auto take_off = [this](const UnknownKind row, const UnknownKind column, Vec target) {
      if (!block(column).is_empty())
      {
        check_petsc(MatMult(coupling(row, column), block(column).value, block(row).value), "applied blocks");
        check_petsc(VecAXPY(target, -1., block(row).value), "applied blocks");
      }
    };
    for (auto &b : blocks_)
      if (!b.is_empty())
      {
        check_petsc(VecScatterBegin(b.scatter, x, b.load, INSERT_VALUES, SCATTER_FORWARD), "applied blocks");
        check_petsc(VecScatterEnd(b.scatter, x, b.load, INSERT_VALUES, SCATTER_FORWARD), "applied blocks");
      }
    Block &p = block(UnknownKind::pressure), &body = block(UnknownKind::body);
    check_petsc(VecPointwiseDivide(p.value, p.load, pressure_mass_), "applied blocks");
    check_petsc(VecScale(p.value, -1.), "applied blocks");
    if (!body.is_empty())
      take_off(UnknownKind::body, UnknownKind::pressure, body.load);
    for (const auto c : components)
      if (Block &u = block(c); !u.is_empty())
      {
        take_off(c, UnknownKind::pressure, u.load);
        check_petsc(KSPSolve(u.inverse, u.load, u.value), "applied blocks");
      }
    if (!body.is_empty())
    {
      for (const auto c : components)
        take_off(UnknownKind::body, c, body.load);
      check_petsc(KSPSolve(body.inverse, body.load, body.value), "applied blocks");
      for (const auto c : components)
        if (Block &u = block(c); !u.is_empty())
        {
          check_petsc(MatMult(coupling(c, UnknownKind::body), body.value, u.remainder), "applied blocks");
          check_petsc(VecAYPX(u.remainder, -1., u.load), "applied blocks");
          check_petsc(KSPSolve(u.inverse, u.remainder, u.value), "applied blocks");
        }
    }
    for (auto &b : blocks_)
      if (!b.is_empty())
      {
        check_petsc(VecScatterBegin(b.scatter, b.value, y, INSERT_VALUES, SCATTER_REVERSE), "applied blocks");
        check_petsc(VecScatterEnd(b.scatter, b.value, y, INSERT_VALUES, SCATTER_REVERSE), "applied blocks");
      }
  }
} // namespace swimtwin
