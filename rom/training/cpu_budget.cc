#include <rom/training/cpu_budget.h>

#include <datasets/system/clocks.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  CpuBudget::CpuBudget(const double limit_s, const MPI_Comm communicator)
      : communicator_(communicator), limit_s_(limit_s), start_s_(of_all_ranks_s())
  {
  }

  double CpuBudget::of_all_ranks_s() const
  {
    double now_s = process_cpu_time_s();
    MPI_Allreduce(MPI_IN_PLACE, &now_s, 1, MPI_DOUBLE, MPI_SUM, communicator_);
    return now_s;
  }

  void CpuBudget::book(const std::string &purpose)
  {
    const double now_s = of_all_ranks_s() - start_s_;
    auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const auto &e) { return e.first == purpose; });
    if (entry == entries_.end())
      entry = entries_.insert(entries_.end(), {purpose, 0.});
    entry->second += now_s - spent_s_;
    spent_s_ = now_s;
  }

  double CpuBudget::spent_on_s(const std::string &purpose) const
  {
    for (const auto &[name, seconds] : entries_)
      if (name == purpose)
        return seconds;
    return 0.;
  }

  std::string CpuBudget::text() const
  {
    std::string text;
    for (const auto &[name, seconds] : entries_)
      text += fmt::format("{}{:.0f} s {}", text.empty() ? "" : ", ", seconds, name);
    return text;
  }
} // namespace swimtwin
