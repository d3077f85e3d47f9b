#include <twin/lab/laboratory.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  using std::numbers::pi;

  Laboratory::Laboratory(CoilDriver &coils, LaboratorySwimmer &swimmer, const LaboratoryCamera &camera,
                         const unsigned int seed)
      : coils_(coils), swimmer_(swimmer), camera_(camera), chance_{std::mt19937_64(seed), {}}
  {
  }

  Sighting Laboratory::noisy(const int kind, const double place, const double sigma)
  {
    const auto   camera = [this](const TwinParameter p) { return swimmer_.camera(p); };
    const double turned = camera(TwinParameter::camera_rotation);
    Sighting     observation{kind, {0., 0.}, sigma, place};
    if (kind == head_angle)
    {
      observation.value[0] = std::remainder(swimmer_.angle_rad() + turned, 2. * pi) + sigma * chance_.normal();
      return observation;
    }
    const Eigen::Vector2d point_m = kind == tail_point ? swimmer_.tail_point_m(place) : swimmer_.head_m(),
                          offset_m(camera(TwinParameter::camera_offset_x), camera(TwinParameter::camera_offset_y));
    observation.value =
        offset_m + std::exp(camera(TwinParameter::camera_scale)) * (Eigen::Rotation2Dd(turned) * point_m);
    for (int i = 0; i < 2; ++i)
      observation.value[i] += sigma * chance_.normal();
    return observation;
  }

  CapturedFrame Laboratory::next_frame()
  {
    std::uniform_real_distribution<double> uniform;
    const double                           next_s = next_frame_s();
    coils_.play_until(next_s, now_s_);
    swimmer_.advance(next_s, chance_);
    now_s_ = next_s;
    ++n_frames_;
    CapturedFrame frame{now_s_ + swimmer_.camera(TwinParameter::camera_delay), 0., {}};
    frame.arrives_s = frame.stamp_s + std::max(0., camera_.latency_s + camera_.latency_jitter_s * chance_.normal());
    std::vector<Sighting> seen = {noisy(head_position, 0., camera_.position_sigma_m)};
    if (camera_.sees_angle)
      seen.push_back(noisy(head_angle, 0., camera_.angle_sigma_rad));
    for (const double share : camera_.tail_shares)
      seen.push_back(noisy(tail_point, share, camera_.position_sigma_m));
    // The same random numbers are drawn whatever goes wrong, so that runs can be compared.
    const bool is_missing  = uniform(chance_.engine) < camera_.missing_share,
               is_outlier  = uniform(chance_.engine) < camera_.outlier_share;
    const double direction = 2. * pi * uniform(chance_.engine);
    if (is_outlier)
    {
      seen.front().value += camera_.outlier_m * Eigen::Vector2d(std::cos(direction), std::sin(direction));
      for (Sighting &o : seen)
        if (o.kind == head_angle)
          o.value[0] += direction - pi;
    }
    const auto within = [&](const std::vector<TimeSpan> &spans) {
      return std::any_of(spans.begin(), spans.end(), [&](const TimeSpan &s) { return s.contains(now_s_); });
    };
    if (within(camera_.stuck) && !last_seen_.empty())
      seen = last_seen_;
    last_seen_ = seen;
    if (!is_missing && !within(camera_.dark))
      frame.observations = std::move(seen);
    return frame;
  }
} // namespace swimtwin
