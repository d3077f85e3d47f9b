// What will be solved, what is skipped and why, and what it will cost.
#include <app/full_order/plan_report.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/ranks.h>
#include <app/frame/written_files.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/console.h>
#include <fom/run/run_plan.h>
#include <reports/page/number_text.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    /// Nothing is said of meshes that there are not.
    std::string describe_size(const Scene &scene, const RunPlan &plan)
    {
      const char *const cells = scene.dimension == 3 ? "tetrahedra" : "triangles";
      std::string       text;
      if (scene.fluid)
        text += fmt::format("  fluid mesh             {} {}, worst quality {:.2f}\n", plan.n_fluid_cells, cells,
                            plan.mesh_quality);
      if (scene.tail)
        text += fmt::format("  tail mesh              {} {}\n", plan.n_tail_cells, cells);
      return text + fmt::format("  unknowns               {}\n  steps                  {} of {:.4g} s\n",
                                plan.n_unknowns, scene.time.n_steps(), scene.time.time_step_s());
    }

    std::string describe_cost(const Scene &scene, const RunPlan &plan)
    {
      if (!scene.fluid)
        return "  none: what a step costs was measured with a fluid only\n";
      const std::string time = plan.estimated_time_s < 1. ? "below 1 s" : duration_text(plan.estimated_time_s);
      return fmt::format("  time                   {}{}\n  memory                 {:.0f} MB\n", time,
                         plan.is_extrapolated ? " (beyond the sizes that were measured)" : "",
                         plan.estimated_memory_MB);
    }

    std::string describe(const Scene &scene, const RunPlan &plan)
    {
      std::string text = fmt::format("Plan for {}\n", scene.name);
      const auto  list = [&](const char *title, const std::vector<PlanItem> &items) {
        text += fmt::format("{}\n", title);
        for (const auto &[what, why] : items)
          text += fmt::format("  {:<22} {}\n", what, why);
      };
      list("Solved", plan.solved);
      list("Skipped", plan.skipped);
      list("Numbers", plan.numbers);
      text += "Size\n" + describe_size(scene, plan);
      text += fmt::format("Estimate (one core)\n{}", describe_cost(scene, plan));
      for (const auto &warning : plan.warnings)
        text += fmt::format("Warning: {}\n", warning);
      return text;
    }

    void plan_in_folder(const Scene &scene, const CommonOptions &common)
    {
      const RunPlan plan = plan_run(scene, MPI_COMM_WORLD);
      if (!is_speaker())
        return;
      const std::string text = describe(scene, plan);
      if (!common.output.empty())
        write_text_atomically(common.output / "plan.txt", text);
      if (!common.quiet)
        say_text(text);
    }
  } // namespace

  void plan_and_report(const Scene &scene, const CommonOptions &common)
  {
    if (common.output.empty())
      return plan_in_folder(scene, common);
    work_in_folder_together(output_request(common, written_by::plan(), files_of(common, scene)),
                            [&](const Begun &) { plan_in_folder(scene, common); });
  }
} // namespace swimtwin
