#include <datasets/scene/tail_outline.h>
#include <datasets/scene/tail_rules.h>
#include <datasets/text/toml_document.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swimtwin
{
  namespace
  {
    /// A film goes with a cylinder, in whose back it is clamped.
    void check_section(const TomlDocument &document, const Scene &scene)
    {
      const Tail &tail = *scene.tail;
      if (tail.section == TailSection::circular)
      {
        if (document.find("tail.width_m") != nullptr)
          document.refuse("tail", "width_m",
                          "belongs to a rectangular section; remove it, or add section = \"rectangular\".");
        return;
      }
      if (scene.dimension == 2)
        document.refuse("tail", "section",
                        "is for three dimensions: in two a tail is as wide as the depth; remove it.");
      if (document.find("tail.width_m") == nullptr)
        document.refuse("tail", "width_m", "is missing; a rectangular section needs it, in m.");
      if (scene.head.shape != HeadShape::rectangle)
        document.refuse("tail", "section",
                        "needs a head with a flat back; set [head] shape = \"cylinder\", or use \"circular\".");
      if (tail.tip != TipShape::flat || !tail.profile_m.empty())
        document.refuse("tail", tail.profile_m.empty() ? "tip" : "profile_m",
                        "is for a circular section; a rectangular one has straight sides and a flat tip: remove it.");
      const double corner = std::hypot(tail.width_m, tail.root_height_m);
      if (corner > 0.99 * scene.head.size_m[1])
        document.refuse(
            "tail", "width_m",
            fmt::format("m gives a root whose corners are {:.4g} m apart, which does not fit in the back of "
                        "the head ({} m); reduce it, or enlarge the head.",
                        corner, scene.head.size_m[1]));
    }

    void check_profile(const TomlDocument &document, const Tail &tail)
    {
      if (tail.profile_m.empty())
        return;
      for (const char *key : {"length_m", "root_height_m", "tip_height_m"})
        if (document.find(join_path("tail", key)) != nullptr)
          document.refuse("tail", key, "does not go with profile_m, which says it; remove one of both.");
      const auto refuse = [&](const std::string &reason) { document.refuse("tail", "profile_m", reason); };
      if (tail.profile_m.size() < 2)
        refuse("has one point; give at least two, from the head to the tip.");
      if (tail.profile_m.front()[0] != 0.)
        refuse(fmt::format("begins at {} m; its first distance must be 0, where the head ends.",
                           tail.profile_m.front()[0]));
      for (std::size_t i = 0; i < tail.profile_m.size(); ++i)
      {
        const auto &[x, half_height] = tail.profile_m[i];
        if (half_height <= 0.)
          refuse(fmt::format("has the radius {} m at {} m; every radius must be positive: end the tail before.",
                             half_height, x));
        if (i > 0 && x <= tail.profile_m[i - 1][0])
          refuse(fmt::format("goes from {} m to {} m; distances must grow from point to point: {}.",
                             tail.profile_m[i - 1][0], x,
                             x < tail.profile_m[i - 1][0] ? "sort them" : "leave out one, or part them"));
      }
    }

    /// Whether the curved sides stay out of the head's ellipse.
    bool profile_leaves_the_head(const Head &head, const TailOutline &tail)
    {
      constexpr int n_samples = 400;
      const double  a = 0.5 * head.size_m[0], b = 0.5 * head.size_m[1];
      for (int i = 1; i <= n_samples; ++i)
      {
        const double x = tail.x_root_m + (tail.x_end_m - tail.x_root_m) * i / n_samples;
        if (std::hypot(x / a, tail.half_height_m(x) / b) <= 1.)
          return false;
      }
      return true;
    }

    /// The sides start on the head's curve and must leave it: their direction points out of the ellipse.
    bool sides_leave_the_head(const Head &head, const Tail &tail)
    {
      if (head.shape == HeadShape::rectangle)
        return true;
      const TailOutline sides = tail_outline(head, tail);
      if (!tail.profile_m.empty())
        return profile_leaves_the_head(head, sides);
      const double a = 0.5 * head.size_m[0], b = 0.5 * head.size_m[1];
      const double dx = sides.x_end_m - sides.x_root_m, dy = 0.5 * (tail.tip_height_m - tail.root_height_m);
      return dx * sides.x_root_m / (a * a) + dy * 0.5 * tail.root_height_m / (b * b) > 0.;
    }

    /// Sine of the angle between the head's surface and the sides where they leave it; 1 on a flat back.
    double opening_at_root(const Head &head, const Tail &tail)
    {
      if (head.shape == HeadShape::rectangle)
        return 1.;
      const TailOutline sides = tail_outline(head, tail);
      const double      a = 0.5 * head.size_m[0], b = 0.5 * head.size_m[1], x = sides.x_root_m,
                   step = 1e-3 * (sides.x_end_m - x), y = 0.5 * tail.root_height_m;
      const double rise = sides.half_height_m(x + step) - y, nx = x / (a * a), ny = y / (b * b);
      return (nx * step + ny * rise) / (std::hypot(nx, ny) * std::hypot(step, rise));
    }

    /// In space a wedge as thin as that has no sound elements with curved faces.
    void check_wedge(const TomlDocument &document, const Head &head, const Tail &tail)
    {
      constexpr double least = 0.15;
      if (const double opening = opening_at_root(head, tail); opening < least)
        document.refuse(
            "tail", tail.profile_m.empty() ? "root_height_m" : "profile_m",
            fmt::format("{}lets the tail leave the head's surface at an angle of {:.2g} degrees, too thin a "
                        "wedge to be meshed; at least {:.2g} degrees are needed: reduce it, or taper less.",
                        tail.profile_m.empty() ? "m " : "", std::asin(opening) * 180. / std::numbers::pi,
                        std::asin(least) * 180. / std::numbers::pi));
    }

    /// In space elements are as small as the tail is thin.
    void check_thinnest(const TomlDocument &document, const Tail &tail)
    {
      constexpr double least  = 1e-4; // of the length
      double           radius = .5 * std::min(tail.root_height_m, tail.tip_height_m);
      for (const auto &[x, half_height] : tail.profile_m)
        radius = std::min(radius, half_height);
      if (radius >= least * tail.length_m)
        return;
      const bool is_straight = tail.profile_m.empty();
      document.refuse(
          "tail", is_straight ? "tip_height_m" : "profile_m",
          fmt::format("{} too thin for elements of a tail of {:.3g} m; at least {:.2g} m are needed: blunt it.",
                      is_straight ? "m is" : fmt::format("is {:.3g} m thick where it is thinnest,", 2. * radius),
                      tail.length_m, 2. * least * tail.length_m));
    }

    void check_root_and_tip(const TomlDocument &document, const Head &head, const Tail &tail)
    {
      const bool        is_straight = tail.profile_m.empty();
      const std::string root        = is_straight ? "root_height_m" : "profile_m";
      if (tail.root_height_m > head.size_m[1])
        document.refuse("tail", root,
                        fmt::format("{} is larger than the head's height of {} m; the tail must start on the head.",
                                    is_straight ? "m" : fmt::format("begins {} m high, which", tail.root_height_m),
                                    head.size_m[1]));
      if (is_straight && tail.tip_height_m > tail.root_height_m)
        document.refuse("tail", "tip_height_m",
                        fmt::format("m is larger than root_height_m = {} m; a tail does not widen towards its tip.",
                                    tail.root_height_m));
      if (tail.tip == TipShape::rounded && 0.5 * tail.tip_height_m >= tail.length_m)
        document.refuse(
            "tail", "tip_height_m",
            fmt::format("m gives a rounded tip of radius {} m that is not shorter than the tail (length_m = {} "
                        "m); reduce it.",
                        0.5 * tail.tip_height_m, tail.length_m));
      if (!sides_leave_the_head(head, tail))
        document.refuse("tail", root,
                        fmt::format("{}lets the tail's tapering sides cut into the head's curve; reduce it, or taper "
                                    "less.",
                                    is_straight ? "m " : ""));
    }
  } // namespace

  void check_tail_entries(const TomlDocument &document, const Scene &scene)
  {
    check_section(document, scene);
    check_profile(document, *scene.tail);
  }

  void check_tail(const TomlDocument &document, const Scene &scene)
  {
    check_root_and_tip(document, scene.head, *scene.tail);
    if (scene.dimension != 3)
      return;
    check_wedge(document, scene.head, *scene.tail);
    check_thinnest(document, *scene.tail);
  }
} // namespace swimtwin
