// The rigid resistance matrix of a scene's swimmer at rest, with its file.
#include <app/full_order/resistance_report.h>

#include <app/frame/claimed_folder.h>
#include <app/frame/ranks.h>
#include <app/frame/written_files.h>
#include <datasets/files/output_folder.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/system/provenance.h>
#include <fom/resistance/resistance.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>

namespace swimtwin
{
  namespace
  {
    /// What the matrix's rows and columns are: all rigid motions, or in space those in the plane of a half domain.
    template <int dim>
    std::vector<std::string> order_of(const ResistanceResult<dim> &result)
    {
      if (dim == 2)
        return {"Ux", "Uy", "omega"};
      if (result.matrix.m() == 3)
        return {"Ux", "Uy", "omega_z"};
      return {"Ux", "Uy", "Uz", "omega_x", "omega_y", "omega_z"};
    }

    template <int dim>
    nlohmann::ordered_json to_json(const ResistanceResult<dim> &result, const Scene &scene,
                                   const std::vector<std::string> &warnings, const std::string &command_line,
                                   const double wall_time_s)
    {
      nlohmann::ordered_json json;
      json["matrix"] = nlohmann::ordered_json::array();
      for (unsigned int i = 0; i < result.matrix.m(); ++i)
      {
        auto &row = json["matrix"].emplace_back(nlohmann::ordered_json::array());
        for (unsigned int j = 0; j < result.matrix.n(); ++j)
          row.push_back(result.matrix(i, j));
      }
      json["order"]       = order_of(result);
      json["units"]       = dim == 2
                                ? "force and torque of the body on the fluid per unit depth: Pa s, Pa s m, Pa s m^2; torque "
                                  "about the head's centre"
                                : "force and torque of the body on the fluid: Pa s m, Pa s m^2, Pa s m^3; torque about the "
                                  "head's centre";
      json["asymmetry"]   = result.asymmetry;
      json["n_unknowns"]  = result.n_unknowns;
      json["n_cells"]     = result.n_cells;
      json["wall_time_s"] = wall_time_s;
      json["warnings"]    = warnings;
      json["provenance"]  = {{"program_version", current_program_version},
                             {"command_line", command_line},
                             {"scene_hash", scene.hash},
                             {"created", utc_time_now()},
                             {"scene_text", scene.text}};
      return json;
    }

    template <int dim>
    void print(const ResistanceResult<dim> &result)
    {
      say("Resistance of the body at rest{} ({} unknowns, asymmetry {:.1e})\n", dim == 2 ? ", per unit depth" : "",
          result.n_unknowns, result.asymmetry);
      const bool               is_whole = result.matrix.m() == 6;
      std::vector<std::string> rows{"Fx", "Fy", "T "};
      std::string              head = " ";
      if (is_whole)
        rows = {"Fx", "Fy", "Fz", "Tx", "Ty", "Tz"};
      for (const std::string &name : is_whole ? order_of(result) : std::vector<std::string>{"Ux", "Uy", "omega"})
        head += fmt::format(" {:>16}", name);
      say("{}\n", head);
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        std::string row = rows[i];
        for (unsigned int j = 0; j < rows.size(); ++j)
          row += fmt::format(" {:16.8e}", result.matrix(i, j));
        say("{}\n", row);
      }
    }

    void refuse_if_nothing_resists(const Scene &scene)
    {
      if (scene.domain && !scene.domain->has_holding_wall())
        throw InputError(scene.name +
                         ": [domain.walls] leaves every wall traction-free: nothing resists fluid and body "
                         "that move along together; make one of them \"no-slip\"");
    }

    template <int dim>
    void compute_and_report(const Scene &scene, const CommonOptions &common)
    {
      const auto         start = std::chrono::steady_clock::now();
      const Swimmer<dim> swimmer(scene, MPI_COMM_WORLD);
      const auto         result = compute_resistance(swimmer, swimmer.configuration_at_rest(), MPI_COMM_WORLD);
      if (!is_speaker())
        return;
      const double wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const auto   warnings    = sliver_warnings(scene);
      write_text_atomically(common.output / "resistance.json",
                            to_json(result, scene, warnings, common.command_line, wall_time_s).dump(2) + "\n");
      for (const std::string &warning : warnings)
        warn(warning);
      if (!common.quiet)
        print(result);
    }
  } // namespace

  void resistance_and_report(const Scene &scene, const CommonOptions &common)
  {
    refuse_if_nothing_resists(scene);
    work_in_folder_together(
        output_request(common, written_by::resistance(), files_of(common, scene)), [&](const Begun &) {
          scene.dimension == 3 ? compute_and_report<3>(scene, common) : compute_and_report<2>(scene, common);
        });
  }
} // namespace swimtwin
