#include <app/frame/tool.h>

namespace swimtwin
{
  std::vector<Verb> online_verbs()
  {
    return {{"sweep", add_sweep},
            {"reconstruct", add_reconstruct},
            {"calibrate", add_calibrate},
            {"optimize", add_optimize},
            {"track", add_track},
            {"twin", add_twin},
            {"lab", add_lab},
            {"report", add_report}};
  }
} // namespace swimtwin
