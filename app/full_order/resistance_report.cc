// The rigid resistance matrix of a scene's swimmer at rest, with its file.
#include <app/resistance.h>

#include <app/claimed_folder.h>
#include <app/ranks.h>
#include <app/written_files.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/provenance.h>
#include <fom/resistance/resistance.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>

namespace swimtwin
{
  namespace
  {
    template <int dim>
    nlohmann::ordered_json to_json(const ResistanceResult<dim> &result, const Scene &scene,
                                   const std::string &command_line, const double wall_time_s)
    {
      nlohmann::ordered_json json;
      json["matrix"] = nlohmann::ordered_json::array();
      for (int i = 0; i < 3; ++i)
        json["matrix"].push_back({result.matrix(i, 0), result.matrix(i, 1), result.matrix(i, 2)});
      json["order"]       = {"Ux", "Uy", dim == 2 ? "omega" : "omega_z"};
      json["units"]       = dim == 2
                                ? "force and torque of the body on the fluid per unit depth: Pa s, Pa s m, Pa s m^2; torque "
                                  "about the head's centre"
                                : "force and torque of the body on the fluid: Pa s m, Pa s m^2, Pa s m^3; torque about the "
                                  "head's centre";
      json["asymmetry"]   = result.asymmetry;
      json["n_unknowns"]  = result.n_unknowns;
      json["n_cells"]     = result.n_cells;
      json["wall_time_s"] = wall_time_s;
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
      say("  {:>16} {:>16} {:>16}\n", "Ux", "Uy", "omega");
      const char *const rows[] = {"Fx", "Fy", "T "};
      for (int i = 0; i < 3; ++i)
        say("{} {:16.8e} {:16.8e} {:16.8e}\n", rows[i], result.matrix(i, 0), result.matrix(i, 1), result.matrix(i, 2));
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
      write_text_atomically(common.output / "resistance.json",
                            to_json(result, scene, common.command_line, wall_time_s).dump(2) + "\n");
      if (!common.quiet)
        print(result);
    }
  } // namespace

  void resistance_and_report(const Scene &scene, const CommonOptions &common)
  {
    work_in_folder_together(
        output_request(common, written_by::resistance(), files_of(common, scene)), [&](const Begun &) {
          scene.dimension == 3 ? compute_and_report<3>(scene, common) : compute_and_report<2>(scene, common);
        });
  }
} // namespace swimtwin
