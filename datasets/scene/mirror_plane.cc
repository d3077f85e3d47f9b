#include <datasets/scene/mirror_plane.h>
#include <datasets/scene/scene_surfaces.h>

#include <algorithm>
#include <cmath>

namespace swimtwin
{
  namespace
  {
    using Condition = WallCondition;

    bool is_magnetised(const Scene &scene)
    {
      return scene.head.magnetization_A_m != 0. || (scene.tail && scene.tail->magnetization_A_m != 0.);
    }

    bool has_transverse_field(const FieldProgram &field)
    {
      return field.by_T() != 0. ||
             std::any_of(field.b_T().begin(), field.b_T().end(), [](const auto &b) { return b[1] != 0.; });
    }

    /// Whether a moment along +x ever points against the field along x.
    bool points_against_field(const double magnetization_A_m, const FieldProgram &field)
    {
      return magnetization_A_m * field.bx_T() < 0. ||
             std::any_of(field.b_T().begin(), field.b_T().end(),
                         [&](const auto &b) { return magnetization_A_m * b[0] < 0.; });
    }

    bool moves(const Wall &wall)
    {
      if (wall.condition == Condition::shear_flow)
        return wall.shear_rate_1_s != 0.;
      return (wall.condition == Condition::moving_wall || wall.condition == Condition::inflow) && wall.speed_m_s != 0.;
    }

    bool moves_alike(const Wall &a, const Wall &b)
    {
      return a.condition == b.condition && a.speed_m_s == b.speed_m_s && a.profile == b.profile && a.ramp_s == b.ramp_s;
    }

    /// A clause on a wall that is not its own mirror image; empty if all are.
    std::string asymmetric_wall(const Domain &domain)
    {
      const auto &walls = domain.walls;
      for (const auto &[name, wall] : walls)
        if (wall.condition == Condition::shear_flow && moves(wall))
          return "the flow at the wall " + name + " shears across the axis";
      for (const char *across : {"left", "right", "outer", "inner"})
        if (const auto found = walls.find(across);
            found != walls.end() && found->second.condition == Condition::moving_wall && moves(found->second))
          return std::string("the wall ") + across + " moves across the axis";
      if (walls.count("bottom") != 0 && !moves_alike(walls.at("bottom"), walls.at("top")))
        return "the walls bottom and top differ";
      return {};
    }

    bool is_driven_across(const Scene &scene)
    {
      const HeadOscillation &given = scene.head.oscillation;
      return (scene.head.is_driven() && (given.amplitude_m[1] != 0. || given.angle_rad != 0.)) ||
             (scene.tail && scene.tail->is_driven());
    }

    bool is_off_axis(const Scene &scene)
    {
      return scene.domain && scene.domain->center_m[1] != scene.head.center_m[1];
    }

    std::string why_missing(const Scene &scene)
    {
      if (is_driven_across(scene))
        return "the prescribed motion goes across the axis";
      if (scene.head.angle_rad != 0.)
        return "the swimmer starts at an angle";
      if (is_off_axis(scene))
        return "the head is not on the domain's axis";
      if (scene.gravity.acceleration_m_s2[1] != 0.)
        return "gravity acts across the axis";
      if (is_magnetised(scene) && has_transverse_field(scene.field))
        return "the field acts across the axis";
      return scene.domain ? asymmetric_wall(*scene.domain) : std::string();
    }

    /// Net weight (N/m^3, along +x) of a material in the scene's fluid.
    double weight_along_x(const Scene &scene, const double density_kg_m3)
    {
      return (density_kg_m3 - (scene.fluid ? scene.fluid->density_kg_m3 : 0.)) * scene.gravity.acceleration_m_s2[0];
    }

    /// In space: what pushes or turns the body out of the plane of x and y; empty where nothing does.
    std::string what_leaves_plane(const Scene &scene)
    {
      if (is_magnetised(scene) && scene.field.leaves_plane())
        return "the field has a component along z";
      if (scene.head.magnetization_A_m != 0. && scene.head.magnetization_direction[2] != 0.)
        return "the head's magnetization has a component along z";
      return scene.gravity.leaves_plane() ? "gravity has a component along z" : "";
    }

    bool has_driven_flow(const Scene &scene)
    {
      return scene.domain && std::any_of(scene.domain->walls.begin(), scene.domain->walls.end(),
                                         [](const auto &entry) { return moves(entry.second); });
    }

    /// A flow from the left alone: it pulls on a tail that is held at its root.
    bool flow_pulls_on_tail(const Domain &domain)
    {
      return std::all_of(domain.walls.begin(), domain.walls.end(), [](const auto &entry) {
        const auto &[name, wall] = entry;
        return !moves(wall) || (name == "left" && wall.condition == Condition::inflow && wall.speed_m_s > 0.);
      });
    }

    std::string why_doubtful(const Scene &scene)
    {
      const auto &tail = scene.tail;
      if (scene.head.is_free() && points_against_field(scene.head.magnetization_A_m, scene.field))
        return "the head's magnetization points against the field, which turns it away from the axis";
      if (tail && points_against_field(tail->magnetization_A_m, scene.field))
        return "the tail's magnetization points against the field, which turns it away from the axis";
      if (scene.head.is_free() && (has_driven_flow(scene) || weight_along_x(scene, scene.head.density_kg_m3) != 0. ||
                                   (tail && weight_along_x(scene, tail->density_kg_m3) != 0.)))
        return "a free body in a flow or falling may turn or drift away from the axis";
      if (!scene.head.is_free() && tail && weight_along_x(scene, tail->density_kg_m3) < 0.)
        return "the tail's weight compresses it, and it may buckle";
      if (tail && scene.domain && !flow_pulls_on_tail(*scene.domain))
        return "the flow may compress the tail, and it may buckle";
      return {};
    }
  } // namespace

  bool domain_is_mirrored(const Scene &scene)
  {
    if (!scene.domain)
      return true;
    const Domain &domain = *scene.domain;
    if (!domain.moves_with_swimmer)
      return !is_off_axis(scene) && asymmetric_wall(domain).empty();
    // It keeps its place in the head's frame.
    const double x = domain.center_m[0] - scene.head.center_m[0], y = domain.center_m[1] - scene.head.center_m[1],
                 angle         = scene.head.angle_rad;
    constexpr double round_off = 1e-9;
    return std::abs(y * std::cos(angle) - x * std::sin(angle)) <= round_off * scene.body_length_m();
  }

  MirrorPlane find_mirror_plane(const Scene &scene)
  {
    if (scene.head.surface)
      return {"the body is read from a surface, whose triangles are not cut at z = 0", {}};
    if (scene.domain && scene.domain->surface)
      return {"the walls are read from a surface, whose triangles are not cut at z = 0", {}};
    if (scene.dimension == 3) // z = 0: bodies of revolution in planar fields
      return {what_leaves_plane(scene), {}};
    MirrorPlane plane{why_missing(scene), {}};
    if (plane.exists())
      plane.doubt = why_doubtful(scene);
    return plane;
  }

  bool solves_half(const Scene &scene)
  {
    if (scene.numerics.symmetric_half != SymmetricHalf::automatic)
      return scene.numerics.symmetric_half == SymmetricHalf::on;
    const MirrorPlane plane = find_mirror_plane(scene);
    return plane.exists() && plane.doubt.empty() && !scene.is_partitioned();
  }

  bool moves_in_plane(const Scene &scene)
  {
    return scene.dimension == 3 && (solves_half(scene) || (scene.has_surfaces() && way_out_of_plane(scene).empty()));
  }

  std::string way_out_of_plane(const Scene &scene)
  {
    if (scene.dimension != 3)
      return {};
    const std::string load = what_leaves_plane(scene);
    return load.empty() ? asymmetric_surface(scene) : load;
  }

  std::string symmetry_warning(const Scene &scene)
  {
    const std::string doubt = find_mirror_plane(scene).doubt;
    if (doubt.empty() || !solves_half(scene))
      return {};
    return "the motion is kept symmetric ([numerics] symmetric_half = \"on\"), but " + doubt +
           "; compare with symmetric_half = \"off\"";
  }
} // namespace swimtwin
