#include <rom/integration/prescribed_gait.h>

#include <rom/integration/sundials_handles.h>

#include <fmt/format.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace swimtwin
{
  namespace
  {
    struct GaitEquations
    {
      const ReducedSwimmer &swimmer;
      const Gait           &gait;
      SwimmerState          state;
      ResistanceFactor      resistance;
    };

    int on_pose_rate(const realtype phase, N_Vector pose, N_Vector rate, void *data)
    {
      auto &[swimmer, gait, state, resistance] = *static_cast<GaitEquations *>(data);
      state << sundials::values(pose), gait.shape_m(phase);
      const Eigen::Vector3d head = swimmer.head_velocity(state, gait.rate_m(phase), 0., 1., resistance);
      sundials::values(rate) << Eigen::Rotation2Dd(state[2]) * head.head<2>(), head[2];
      return head.allFinite() ? 0 : 1;
    }

    void release_fixed_point(SUNNonlinearSolver solver)
    {
      SUNNonlinSolFree(solver);
    }
    using FixedPoint =
        std::unique_ptr<_generic_SUNNonlinearSolver, sundials::Release<SUNNonlinearSolver, release_fixed_point>>;
  } // namespace

  GaitRun follow_gait(const ReducedSwimmer &swimmer, const Gait &gait, const double angle_rad, const int n_periods,
                      const double relative_tolerance)
  {
    constexpr double           max_step_periods = 0.02;
    constexpr long             max_steps        = 1'000'000;
    GaitEquations              equations{swimmer, gait, state_at_rest(swimmer), swimmer.resistance().make_factor()};
    const sundials::Context    context = sundials::make_context();
    const sundials::Vector     pose(sundials::made(N_VNew_Serial(3, context.get())));
    const sundials::Vector     tolerance(sundials::made(N_VClone(pose.get())));
    const FixedPoint           solver(sundials::made(SUNNonlinSol_FixedPoint(pose.get(), 0, context.get())));
    const sundials::Integrator integrator(sundials::made(CVodeCreate(CV_ADAMS, context.get())));
    void *const                cv = integrator.get();
    sundials::values(pose.get()) << 0., 0., angle_rad;
    sundials::values(tolerance.get()) << swimmer.length_m() * relative_tolerance,
        swimmer.length_m() * relative_tolerance, relative_tolerance;
    CVodeSetErrHandlerFn(cv, sundials::ignore_message, nullptr);
    sundials::require_memory(CVodeInit(cv, on_pose_rate, 0., pose.get()));
    CVodeSetUserData(cv, &equations);
    sundials::require_memory(CVodeSVtolerances(cv, relative_tolerance, tolerance.get()));
    sundials::require_memory(CVodeSetNonlinearSolver(cv, solver.get()));
    CVodeSetMaxStep(cv, max_step_periods);
    CVodeSetMaxNumSteps(cv, max_steps);

    GaitRun run;
    run.at_period_end.emplace_back(sundials::values(pose.get()));
    for (int period = 1; period <= n_periods; ++period)
    {
      double reached = 0.;
      CVodeSetStopTime(cv, period);
      if (const int flag = CVode(cv, period, pose.get(), &reached, CV_NORMAL); flag < 0)
      {
        run.failure = fmt::format("the gait was followed for {:.4g} periods only: CVODES reports {}", reached, flag);
        return run;
      }
      run.at_period_end.emplace_back(sundials::values(pose.get()));
    }
    run.completed = true;
    return run;
  }
} // namespace swimtwin
