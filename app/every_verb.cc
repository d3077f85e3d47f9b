#include <app/tool.h>

namespace swimtwin
{
  std::vector<Verb> every_verb()
  {
    return {{"plan", add_plan},
            {"simulate", add_simulate},
            {"resistance", add_resistance},
            {"train", add_train},
            {"sweep", add_sweep},
            {"reconstruct", add_reconstruct},
            {"calibrate", add_calibrate},
            {"optimize", add_optimize},
            {"track", add_track},
            {"twin", add_twin},
            {"lab", add_lab},
            {"report", add_report},
            {"demo", add_demo}};
  }
} // namespace swimtwin
