#include <app/frame/progress_bar.h>
#include <datasets/system/console.h>

#include <reports/page/number_text.h>

#include <fmt/format.h>

#include <unistd.h>

namespace swimtwin
{
  ProgressBar::ProgressBar(const bool quiet) : visible_(!quiet && isatty(STDERR_FILENO) != 0) {}

  ProgressBar::~ProgressBar()
  {
    if (visible_)
      mutter("\r\033[K");
  }

  void ProgressBar::show(const int done, const int total, const int rate_steps, const double elapsed_s)
  {
    constexpr int    width    = 30;
    constexpr double interval = 0.2;
    if (!visible_ || (done < total && elapsed_s - last_shown_s_ < interval))
      return;
    last_shown_s_     = elapsed_s;
    const int  filled = width * done / total;
    const auto left = rate_steps > 0 ? duration_text(elapsed_s / rate_steps * (total - done)) + " left" : std::string();
    mutter(
        fmt::format("\r\033[K[{:#<{}}{:.<{}}] step {} of {}  {}", "", filled, "", width - filled, done, total, left));
  }
} // namespace swimtwin
