#include <app/ranks.h>

namespace swimtwin
{
  bool is_speaker()
  {
    return true;
  }

  void let_speaker_go_first() {}

  void agree(const std::function<void()> &on_speaker)
  {
    on_speaker();
  }

  void end_all_ranks(int /*exit_code*/) {}
} // namespace swimtwin
