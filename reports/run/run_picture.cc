#include <reports/run/run_picture.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  GnuplotPicture make_picture(const ShownRun &run, const std::string &name, const std::string_view script,
                              const std::string &heading, const std::string &finding)
  {
    GnuplotPicture picture;
    picture.name   = name;
    picture.script = script;
    picture.set_text("heading", heading);
    picture.set_text("caption", finding.empty() ? run.scene.name : fmt::format("{}: {}", run.scene.name, finding));
    return picture;
  }

  void set_time_axis(GnuplotPicture &picture, const ShownRun &run, const Rows rows)
  {
    picture.set_text("time_label", run.axis.label);
    picture.set("t_min", run.time(rows.front().time_s));
    picture.set("t_max", run.time(rows.back().time_s));
  }

  void Extent::add(const double x, const double y)
  {
    low_  = {std::min(low_[0], x), std::min(low_[1], y)};
    high_ = {std::max(high_[0], x), std::max(high_[1], y)};
  }

  double Extent::size() const
  {
    return std::max({least_, high_[0] - low_[0], high_[1] - low_[1]});
  }

  std::array<double, 2> Extent::center() const
  {
    return {0.5 * (low_[0] + high_[0]), 0.5 * (low_[1] + high_[1])};
  }

  void Extent::assign_to(GnuplotPicture &picture) const
  {
    const double margin = 0.5 * (size() - std::max(high_[0] - low_[0], high_[1] - low_[1]));
    picture.set("x_min", low_[0] - margin);
    picture.set("x_max", high_[0] + margin);
    picture.set("y_min", low_[1] - margin);
    picture.set("y_max", high_[1] + margin);
  }
} // namespace swimtwin
