#include <rom/training/added_runs.h>

#include <datasets/reduced/held_out_error.h>
#include <rom/training/explored_shapes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swimtwin
{
  namespace
  {
    constexpr int    first_candidate = 2001, n_candidates = 200; ///< of the range's members; held out are others
    constexpr double least_distance = 0.03, no_span = 1e-9;

    std::array<double, 3> groups(const HeldOutRun &run)
    {
      const RunGroups g = run_groups(run);
      return {g.elastic, g.magnetic, g.slope};
    }

    std::array<double, 3> groups(const RunParameters &p)
    {
      return groups(
          HeldOutRun{p.young_modulus_Pa, p.viscosity_Pa_s, p.magnetization_A_m, p.frequency_Hz, p.bx_T, p.by_T});
    }

    /// What each group spans over the range.
    std::array<double, 3> spans(const std::vector<RunParameters> &members)
    {
      std::array<double, 3> low, high;
      low.fill(std::numeric_limits<double>::infinity());
      high.fill(-std::numeric_limits<double>::infinity());
      for (const auto &member : members)
      {
        const auto g = groups(member);
        for (std::size_t c = 0; c < g.size(); ++c)
        {
          low[c]  = std::min(low[c], g[c]);
          high[c] = std::max(high[c], g[c]);
        }
      }
      return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    }

    /// Of two motions, as a share of what the range spans; groups that it leaves as they are do not count.
    double distance(const std::array<double, 3> &a, const std::array<double, 3> &b, const std::array<double, 3> &span)
    {
      double sum = 0.;
      for (std::size_t c = 0; c < a.size(); ++c)
        if (span[c] > no_span)
          sum += std::pow((a[c] - b[c]) / span[c], 2);
      return std::sqrt(sum);
    }

    std::vector<HeldOutRun> worst_first(const TrainingRecord &record)
    {
      std::vector<HeldOutRun> runs = record.held_out_runs;
      std::stable_sort(runs.begin(), runs.end(), [&](const HeldOutRun &a, const HeldOutRun &b) {
        return std::abs(relative_error(a, record)) > std::abs(relative_error(b, record));
      });
      return runs;
    }
  } // namespace

  std::vector<AddedRun> runs_near_the_worst(const TrainingRecord &record, const TrainedRange &range, const int n,
                                            const std::vector<int> &taken)
  {
    const auto members  = spread_members(range, n_candidates, first_candidate);
    const auto span     = spans(members);
    const auto held_out = worst_first(record);
    const auto is_seen  = [&](const std::array<double, 3> &g) {
      return std::any_of(held_out.begin(), held_out.end(),
                          [&](const HeldOutRun &run) { return distance(g, groups(run), span) < least_distance; });
    };
    std::vector<int>      used = taken;
    std::vector<AddedRun> added;
    for (std::size_t i = 0; i < std::min<std::size_t>(static_cast<std::size_t>(n), held_out.size()); ++i)
    {
      AddedRun nearest;
      double   least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < members.size(); ++k)
      {
        const int    number = first_candidate + static_cast<int>(k);
        const auto   g      = groups(members[k]);
        const double d      = distance(g, groups(held_out[i]), span);
        if (d < least && !is_seen(g) && std::find(used.begin(), used.end(), number) == used.end())
        {
          least   = d;
          nearest = {members[k], number};
        }
      }
      if (nearest.number == 0)
        continue;
      used.push_back(nearest.number);
      added.push_back(nearest);
    }
    return added;
  }

  std::vector<std::filesystem::path> added_run_folders(const std::filesystem::path &runs)
  {
    std::vector<std::filesystem::path> folders;
    for (int number = first_candidate; number < first_candidate + n_candidates; ++number)
      if (const auto folder = runs / run_folder_name(number);
          std::filesystem::exists(folder / "summary.json") && std::filesystem::exists(folder / "snapshots.h5"))
        folders.push_back(folder);
    return folders;
  }
} // namespace swimtwin
