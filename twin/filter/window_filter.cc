#include <twin/filter/window_filter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace swimtwin
{
  namespace
  {
    bool comes_before(const Sighting &a, const Sighting &b)
    {
      return std::make_tuple(a.kind, a.place, a.value.x(), a.value.y(), a.sigma) <
             std::make_tuple(b.kind, b.place, b.value.x(), b.value.y(), b.sigma);
    }
  } // namespace

  WindowFilter::WindowFilter(Process &process, Sensor &sensor, const FilterOptions &filter_options)
      : options(filter_options), process_(process), sensor_(sensor), algebra_(process.n_states(), process.n_noises()),
        slopes_(SquareRootFilter::max_rows, process.n_states()), transition_(process.n_states(), process.n_states()),
        noise_(process.n_states(), process.n_noises()), residual_(SquareRootFilter::max_rows),
        shift_(process.n_states())
  {
  }

  void WindowFilter::start(const double time_s, const Belief &belief, const JumpTest &jumps,
                           const std::array<NoiseLevel, max_observation_kinds> *levels)
  {
    n_nodes_         = 0;
    FilterNode &node = append(time_s);
    node.predicted = node.filtered = belief;
    node.jumps                     = jumps;
    for (int kind = 0; kind < max_observation_kinds; ++kind)
    {
      const double sigma                                = sensor_.first_sigma(kind);
      node.noise_levels[static_cast<std::size_t>(kind)] = {sigma * sigma, 0.};
    }
    if (levels != nullptr)
      node.noise_levels = *levels;
  }

  FilterNode &WindowFilter::append(const double time_s)
  {
    if (static_cast<std::size_t>(n_nodes_) == nodes_.size())
      nodes_.push_back(std::make_unique<FilterNode>());
    FilterNode &node = *nodes_[static_cast<std::size_t>(n_nodes_++)];
    node.time_s      = time_s;
    node.observations.clear();
    node.innovations.clear();
    node.log_likelihood = 0.;
    return node;
  }

  /// Nodes lead from the latest one to this instant, as many as the process' largest step asks for.
  bool WindowFilter::go_to(const double time_s)
  {
    const double start_s = latest().time_s, length = time_s - start_s;
    if (length <= 0.)
      return true;
    const int n_steps = std::max(1, static_cast<int>(std::ceil(length / process_.largest_step_s() - 1e-9)));
    for (int i = 1; i <= n_steps; ++i)
    {
      const double      now_s  = i == n_steps ? time_s : start_s + length * i / n_steps;
      const FilterNode &before = latest();
      FilterNode       &node   = append(now_s);
      node.transition.resize(process_.n_states(), process_.n_states());
      node.noise.resize(process_.n_states(), process_.n_noises());
      node.predicted    = before.filtered;
      node.noise_levels = before.noise_levels;
      node.jumps        = before.jumps;
      if (!process_.advance(before.time_s, now_s, node.predicted.mean, node.transition, node.noise))
      {
        --n_nodes_;
        return false;
      }
      algebra_.predict(node.transition, node.noise, node.predicted.root);
      node.jumps.advance(now_s, node.transition);
      node.filtered = node.predicted;
    }
    return true;
  }

  void WindowFilter::take_in(const Sighting &observation, Innovation &innovation, FilterNode &node)
  {
    const Eigen::Index m        = sensor_.n_rows(observation);
    auto               residual = residual_.head(m);
    auto               slopes   = slopes_.topRows(m);
    NoiseLevel        &level    = node.noise_levels[static_cast<std::size_t>(observation.kind)];
    const bool         learned  = observation.sigma <= 0.;
    const double       sigma    = learned ? level.sigma() : observation.sigma;
    sensor_.look(observation, node.time_s, node.filtered.mean, residual, slopes);
    innovation = {observation.kind, static_cast<int>(m)};
    innovation.distance_squared =
        algebra_.distance_squared(residual, slopes, sigma, node.filtered, innovation.standard_deviation);
    innovation.residual.head(m) = residual;
    const double distance       = std::sqrt(innovation.distance_squared);
    innovation.weight           = options.robustness.weight(
                  distance, node.time_s >= gated_from_s || residual.norm() > sensor_.largest_residual(observation.kind));
    if (learned && distance < options.robustness.gate)
      level.learn(residual.squaredNorm() / static_cast<double>(m),
                  innovation.standard_deviation.head(m).squaredNorm() / static_cast<double>(m) - sigma * sigma);
    node.log_likelihood -= 0.5 * std::min(innovation.distance_squared, std::pow(options.robustness.gate, 2)) +
                           innovation.standard_deviation.head(m).array().log().sum() +
                           0.5 * static_cast<double>(m) * std::log(2. * std::numbers::pi);
    if (innovation.weight == 0.)
      return;
    const double used = sigma / std::sqrt(innovation.weight);
    trial_            = node.filtered;
    algebra_.update(residual, slopes, used, trial_, record_);
    const int n_iterations = distance > options.iterate_beyond ? options.max_iterations : 1;
    for (int i = 1; i < n_iterations; ++i)
    {
      // Expected at the trial, but of the belief before: r + H (x - x_before).
      shift_ = trial_.mean - node.filtered.mean;
      sensor_.look(observation, node.time_s, trial_.mean, residual, slopes);
      residual.noalias() += slopes * shift_;
      trial_ = node.filtered;
      algebra_.update(residual, slopes, used, trial_, record_);
    }
    node.filtered = trial_;
    if (options.learns_jumps)
      node.jumps.learn(record_);
  }

  void WindowFilter::observe(FilterNode &node)
  {
    std::sort(node.observations.begin(), node.observations.end(), comes_before);
    node.innovations.resize(node.observations.size());
    for (std::size_t i = 0; i < node.observations.size(); ++i)
      take_in(node.observations[i], node.innovations[i], node);
    for (const Widening &widening : widenings_)
      if (widening.time_s == node.time_s)
        apply(widening, node);
  }

  void WindowFilter::gather(const double time_s, const std::vector<Sighting> &observations)
  {
    if (n_frames_ == frames_.size())
      frames_.emplace_back();
    Frame &frame = frames_[n_frames_++];
    frame.time_s = time_s;
    frame.observations.assign(observations.begin(), observations.end());
  }

  /// What was seen at node `first` and after it.
  void WindowFilter::gather_frames(const int first)
  {
    n_frames_ = 0;
    for (int i = first; i < n_nodes_; ++i)
      if (!node(i).observations.empty())
        gather(node(i).time_s, node(i).observations);
  }

  /// The gathered frames, from the latest node on; those of one instant are taken in together.
  bool WindowFilter::go_through_frames()
  {
    const auto frames = frames_in_use();
    std::sort(frames.begin(), frames.end(), [](const Frame &a, const Frame &b) { return a.time_s < b.time_s; });
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      if (!go_to(frames[i].time_s))
        return false;
      auto &seen = latest_node().observations;
      seen.insert(seen.end(), frames[i].observations.begin(), frames[i].observations.end());
      const bool is_last_of_instant = i + 1 == frames.size() || frames[i + 1].time_s > latest().time_s;
      if (is_last_of_instant)
        observe(latest_node());
    }
    return true;
  }

  bool WindowFilter::replay_from_start()
  {
    n_nodes_         = 1;
    FilterNode &node = latest_node();
    node.observations.clear();
    node.innovations.clear();
    node.filtered = node.predicted;
    return go_through_frames();
  }

  /// Back to the last node that is earlier and at which something was seen, or to the first: steps in between depend on
  /// both of their ends. What was seen later is gathered.
  void WindowFilter::go_back_before(const double time_s)
  {
    int before = n_nodes_ - 1;
    while (before > 0 && (node(before).time_s >= time_s || node(before).observations.empty()))
      --before;
    gather_frames(before + 1);
    n_nodes_ = before + 1;
  }

  Insertion WindowFilter::add(const Frame &frame)
  {
    if (frame.time_s <= node(0).time_s)
      return Insertion::too_old;
    const bool is_in_order = frame.time_s > latest().time_s;
    n_frames_              = 0;
    if (!is_in_order)
      go_back_before(frame.time_s);
    gather(frame.time_s, frame.observations);
    if (!go_through_frames())
      return Insertion::failed;
    trim();
    return is_in_order ? Insertion::in_order : Insertion::replayed;
  }

  bool WindowFilter::revisit(const double time_s)
  {
    go_back_before(time_s);
    return go_through_frames();
  }

  void WindowFilter::apply(const Widening &widening, FilterNode &node)
  {
    transition_.setIdentity();
    noise_.setZero();
    noise_.col(0) = widening.direction;
    algebra_.predict(transition_, noise_, node.filtered.root);
    node.jumps.restart();
  }

  bool WindowFilter::widen(const double from_s, const double to_s, const Eigen::VectorXd &direction)
  {
    constexpr int n_times = 4;
    const double  first_s = std::max(from_s, node(0).time_s);
    double        last_s  = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < n_times; ++k)
    {
      const double wanted_s = first_s + (to_s - first_s) * k / (n_times - 1);
      int          i        = 0;
      while (i + 1 < n_nodes_ && (node(i).time_s < wanted_s || node(i).observations.empty()))
        ++i;
      if (node(i).time_s > last_s)
        widenings_.push_back({node(i).time_s, direction});
      last_s = std::max(last_s, node(i).time_s);
    }
    return revisit(first_s);
  }

  void WindowFilter::trim()
  {
    // The first node must stay one that was seen something at, or steps would depend on when it went.
    int first = 0;
    for (int i = 1; i < n_nodes_ && node(i).time_s <= latest().time_s - options.window_s; ++i)
      if (!node(i).observations.empty())
        first = i;
    if (first == 0)
      return;
    std::rotate(nodes_.begin(), nodes_.begin() + first, nodes_.begin() + n_nodes_);
    n_nodes_ -= first;
    // What the first one saw is part of its belief.
    FilterNode &front = *nodes_.front();
    front.predicted   = front.filtered;
    front.observations.clear();
    front.innovations.clear();
    std::erase_if(widenings_, [this](const Widening &w) { return w.time_s <= node(0).time_s; });
  }

  bool WindowFilter::predict(const double time_s, Belief &belief)
  {
    belief = latest().filtered;
    return predict(latest().time_s, time_s, belief);
  }

  bool WindowFilter::predict(const double from_s, const double to_s, Belief &belief)
  {
    const double length  = to_s - from_s;
    const int    n_steps = std::max(0, static_cast<int>(std::ceil(length / process_.largest_step_s() - 1e-9)));
    for (int i = 0; i < n_steps; ++i)
    {
      if (!process_.advance(from_s + length * i / n_steps, from_s + length * (i + 1) / n_steps, belief.mean,
                            transition_, noise_))
        return false;
      algebra_.predict(transition_, noise_, belief.root);
    }
    return true;
  }
} // namespace swimtwin
