#include <reports/plan/plan_files.h>

#include <reports/run/run_folder.h>

#include <algorithm>

namespace swimtwin
{
  namespace fs = std::filesystem;

  std::string file_name(const std::string &name)
  {
    std::string file = name;
    std::replace(file.begin(), file.end(), ' ', '-');
    return file;
  }

  std::string replay_folder_name(const std::string &field)
  {
    return "replay/" + file_name(field);
  }

  bool is_plan(const fs::path &folder)
  {
    return fs::exists(folder / plan_name);
  }

  PlanFolder read_plan(const fs::path &folder)
  {
    PlanFolder plan{folder_name(folder), read_plan_result(folder / plan_name), {}};
    for (const PlannedField &field : plan.plan.fields)
      if (const fs::path file = folder / motion_folder_name / (file_name(field.name) + ".csv"); fs::exists(file))
        plan.motions.push_back({field.name, read_trajectory_csv(file)});
    return plan;
  }
} // namespace swimtwin
