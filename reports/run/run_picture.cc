#include <reports/run/run_picture.h>

#include <fmt/format.h>

namespace swimtwin
{
  GnuplotPicture make_picture(const ShownRun &run, const std::string &name, const std::string_view script,
                              const std::string &heading, const std::string &finding)
  {
    return titled_picture(name, script, heading,
                          finding.empty() ? run.scene.name : fmt::format("{}: {}", run.scene.name, finding));
  }

  void set_time_axis(GnuplotPicture &picture, const ShownRun &run, const Rows rows)
  {
    picture.set_text("time_label", run.axis.label);
    picture.set("t_min", run.time(rows.front().time_s));
    picture.set("t_max", run.time(rows.back().time_s));
  }
} // namespace swimtwin
