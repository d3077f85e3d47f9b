#include <app/frame/stage_bar.h>

#include <datasets/system/console.h>

namespace swimtwin
{
  void StageBar::show(const std::string &stage, const int done, const int total)
  {
    if (stage != stage_)
    {
      bar_.reset();
      if (!quiet_)
        say("{}\n", stage);
      stage_ = stage;
      first_ = done;
      start_ = std::chrono::steady_clock::now();
      bar_   = std::make_unique<ProgressBar>(quiet_);
    }
    const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    bar_->show(done, total, done - first_, elapsed_s);
  }
} // namespace swimtwin
