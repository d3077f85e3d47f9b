#include <datasets/scene/field_period.h>
#include <datasets/scene/field_program.h>
#include <datasets/scene/median_step.h>
#include <datasets/system/error.h>
#include <datasets/text/csv_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace swimtwin
{
  namespace
  {
    using Vector = std::array<double, 3>;

    constexpr std::size_t n_samples_min = 4;
    constexpr double      largest_gap   = 1.5; // times the median step
    constexpr double      gap_round_off = 1e-9;

    struct SampleProblem
    {
      std::size_t index = 0;
      std::string sentence;
    };

    std::optional<SampleProblem> find_disorder(const std::vector<double> &time_s, const double period_s)
    {
      const std::size_t n = time_s.size();
      if (n < n_samples_min)
        return SampleProblem{
            n, fmt::format("{} samples are not enough; at least {} per period are needed.", n, n_samples_min)};
      if (time_s.front() < 0.)
        return SampleProblem{0, fmt::format("time_s = {} is negative; times start at 0.", time_s.front())};
      for (std::size_t i = 1; i < n; ++i)
        if (time_s[i] <= time_s[i - 1])
          return SampleProblem{i, fmt::format("time_s = {} does not increase after {}.", time_s[i], time_s[i - 1])};
      if (time_s.back() >= period_s)
        return SampleProblem{n - 1,
                             fmt::format("time_s = {} is not before the end of the period ({} s); the sample at the "
                                         "end of the period is the first one again, leave it out.",
                                         time_s.back(), period_s)};
      return std::nullopt;
    }

    std::optional<SampleProblem> find_gap(const std::vector<double> &time_s, const double period_s)
    {
      const std::size_t n     = time_s.size();
      const double      limit = largest_gap * (1. + gap_round_off) * median_step(time_s);
      for (std::size_t i = 1; i <= n; ++i)
      {
        const double step = (i < n ? time_s[i] : period_s + time_s.front()) - time_s[i - 1];
        if (step > limit)
          return SampleProblem{
              std::min(i, n - 1),
              fmt::format("a gap of {:.6g} s {} is more than {} times the median step of {:.6g} s; add "
                          "the missing samples.",
                          step, i < n ? "before this sample" : "between this last sample and the next period",
                          largest_gap, median_step(time_s))};
      }
      return std::nullopt;
    }

    std::optional<SampleProblem> find_problem(const std::vector<double> &time_s, const double period_s)
    {
      const std::optional<SampleProblem> disorder = find_disorder(time_s, period_s);
      return disorder ? disorder : find_gap(time_s, period_s);
    }

    void require_period(const double period_s)
    {
      if (!std::isfinite(period_s) || period_s <= 0.)
        throw InputError(fmt::format("period_s = {} of a field program must be positive.", period_s));
    }

    Vector interpolate(const Vector &a, const Vector &b, const double weight)
    {
      Vector value{};
      for (std::size_t i = 0; i < value.size(); ++i)
        value[i] = (1. - weight) * a[i] + weight * b[i];
      return value;
    }

    /// Piecewise linear and periodic: the piece after the last sample leads to the first one of the next period.
    Vector interpolate_periodic(const std::vector<double> &time_s, const std::vector<Vector> &b_T,
                                const double period_s, const double time)
    {
      double phase = time - period_s * std::floor(time / period_s);
      if (phase < time_s.front())
        phase += period_s;
      const auto        after = std::upper_bound(time_s.begin(), time_s.end(), phase);
      const std::size_t right = static_cast<std::size_t>(after - time_s.begin()), left = right - 1;
      if (right < time_s.size())
        return interpolate(b_T[left], b_T[right], (phase - time_s[left]) / (time_s[right] - time_s[left]));
      const double wrapped_step = period_s + time_s.front() - time_s[left];
      return interpolate(b_T[left], b_T.front(), (phase - time_s[left]) / wrapped_step);
    }
  } // namespace

  FieldProgram FieldProgram::constant(const double bx_T, const double by_T, const double bz_T)
  {
    FieldProgram field;
    field.waveform_     = Waveform::constant;
    field.bx_T_         = bx_T;
    field.by_T_         = by_T;
    field.along_z_.bz_T = bz_T;
    return field;
  }

  FieldProgram FieldProgram::sinusoidal(const double bx_T, const double by_T, const double frequency_Hz,
                                        const FieldAlongZ &along_z)
  {
    if (!std::isfinite(frequency_Hz) || frequency_Hz <= 0.)
      throw InputError(fmt::format("frequency_Hz = {} of a sinusoidal field must be positive.", frequency_Hz));
    FieldProgram field = constant(bx_T, by_T);
    field.waveform_    = Waveform::sinusoidal;
    field.period_s_    = 1. / frequency_Hz;
    field.along_z_     = along_z;
    return field;
  }

  FieldProgram FieldProgram::sampled(std::vector<double> time_s, std::vector<std::array<double, 3>> b_T,
                                     const double period_s)
  {
    require_period(period_s);
    if (time_s.size() != b_T.size())
      throw InputError(
          fmt::format("a field program needs one field per time, not {} for {}.", b_T.size(), time_s.size()));
    if (const auto problem = find_problem(time_s, period_s))
      throw InputError(fmt::format("sample {} of the field program: {}", problem->index + 1, problem->sentence));
    FieldProgram field;
    field.waveform_ = Waveform::sampled;
    field.period_s_ = period_s;
    field.time_s_   = std::move(time_s);
    field.b_T_      = std::move(b_T);
    return field;
  }

  FieldProgram FieldProgram::read_csv(const std::filesystem::path &file, double period_s)
  {
    const CsvTable            table  = CsvTable::read(file);
    const std::vector<double> time_s = table.column("time_s");
    const std::vector<double> bx_T = table.column("bx_T"), by_T = table.column("by_T");
    const std::vector<double> bz_T =
        table.has_column("bz_T") ? table.column("bz_T") : std::vector<double>(time_s.size());
    if (period_s == 0.)
      period_s = stated_period_s(file).value_or(0.);
    if (!std::isfinite(period_s) || period_s <= 0.)
      throw InputError(fmt::format("{}: the program has no period; give [field] period_s as a positive number in s, or "
                                   "in {} beside it.",
                                   table.where(table.n_rows()), period_file(file).filename().string()));
    if (const auto problem = find_problem(time_s, period_s))
      throw InputError(fmt::format("{}: {}", table.where(problem->index), problem->sentence));
    std::vector<Vector> b_T;
    for (std::size_t i = 0; i < time_s.size(); ++i)
      b_T.push_back({bx_T[i], by_T[i], bz_T[i]});
    FieldProgram field = sampled(time_s, std::move(b_T), period_s);
    field.file         = file;
    return field;
  }

  bool FieldProgram::leaves_plane() const
  {
    return along_z_.bz_T != 0. || std::any_of(b_T_.begin(), b_T_.end(), [](const Vector &b) { return b[2] != 0.; });
  }

  std::array<double, 3> FieldProgram::operator()(const double time_s) const
  {
    const double amplitude = ramp_s > 0. && time_s < ramp_s ? std::max(0., time_s / ramp_s) : 1.;
    Vector       b{};
    switch (waveform_)
    {
    case Waveform::none:
      break;
    case Waveform::constant:
      b = {bx_T_, by_T_, along_z_.bz_T};
      break;
    case Waveform::sinusoidal: {
      const double phase = 2. * std::numbers::pi * time_s / period_s_;
      b                  = {bx_T_, by_T_ * std::sin(phase), along_z_.bz_T * std::sin(phase + along_z_.phase_rad)};
      break;
    }
    case Waveform::sampled:
      b = interpolate_periodic(time_s_, b_T_, period_s_, time_s);
      break;
    }
    for (double &component : b)
      component *= amplitude;
    return b;
  }
} // namespace swimtwin
