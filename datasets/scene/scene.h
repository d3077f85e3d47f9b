// What is to be simulated: the content of a scene file, validated. SI units; units are part of the TOML keys.
#pragma once

#include <datasets/scene/field_program.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swimtwin
{
  struct ClosedSurface; // datasets/surface/closed_surface.h
  struct ElasticPart;   // datasets/surface/elastic_part.h
  struct EnclosedVolume;

  enum class HeadShape { rectangle, disc, ellipse, surface };
  enum class TipShape { rounded, flat };
  enum class TailSection { circular, rectangular };
  enum class HeadMotion { free, fixed, prescribed };
  enum class MaterialModel { st_venant_kirchhoff, neo_hookean, rigid, prescribed };
  enum class DomainShape { box, channel, disc, annulus, cylinder, sphere, surface };
  enum class WallCondition { no_slip, traction_free, moving_wall, inflow, shear_flow };
  enum class InflowProfile { parabolic, uniform };
  enum class Inertia { automatic, none, full, chosen };
  enum class CouplingScheme { monolithic, fixed_point };
  enum class LinearSolver { automatic, direct, iterative };
  enum class AccelerationMethod { aitken, iqn_ils };
  enum class SymmetricHalf { automatic, on, off };
  enum class MeshMotion { elastic, weighted_harmonic, harmonic };

  /// Terms of inertia, one by one. The fluid's two belong together (docs/equations.md, section 12).
  struct InertiaTerms
  {
    bool unsteady = false, convective = false; ///< of the fluid: rho du/dt (at a place) and rho u . grad u
    bool tail = false, head = false;

    bool        of_fluid() const { return unsteady || convective; }
    bool        of_body() const { return tail || head; }
    bool        any() const { return of_fluid() || of_body(); }
    friend bool operator==(const InertiaTerms &, const InertiaTerms &) = default;
  };

  /// Newtonian fluid. `inertia` is that of the whole scene.
  struct FluidProperties
  {
    double       density_kg_m3  = 0.;
    double       viscosity_Pa_s = 0.;
    Inertia      inertia        = Inertia::automatic;
    InertiaTerms chosen; ///< where inertia names its terms
  };

  /// Condition on one wall. `speed_m_s` is the mean inward normal speed of an inflow, or the tangential speed of a
  /// moving wall (along +x on bottom and top, +y on left and right, counter-clockwise on circles). A shear flow gives
  /// the fluid the velocity that it has in an unbounded one: shear_rate_1_s times the height above the domain's centre,
  /// along +x.
  struct Wall
  {
    WallCondition condition = WallCondition::no_slip;
    double        speed_m_s = 0., shear_rate_1_s = 0.;
    InflowProfile profile = InflowProfile::parabolic;
    double        ramp_s  = 0.; ///< the speed grows as (1 - cos(pi t / ramp)) / 2 before this time
  };

  /// Fluid domain around the swimmer. Walls: left, right, bottom, top (box, channel); outer (disc); outer, inner
  /// (annulus). One that is read from a surface has the walls that its file names, and the extent of all as its sizes.
  struct Domain
  {
    DomainShape           shape              = DomainShape::box;
    std::array<double, 2> center_m           = {0., 0.};
    double                center_z_m         = 0.;       ///< of the shape `surface`
    std::array<double, 2> size_m             = {0., 0.}; ///< box and channel: lengths along x and y; cylinder: x
    double                size_z_m           = 0.;       ///< box and channel in three dimensions
    double                radius_m           = 0.;       ///< disc and annulus: outer radius; cylinder, sphere
    double                inner_radius_m     = 0.;       ///< annulus; its inner circle shares the centre
    bool                  moves_with_swimmer = false;    ///< disc and sphere: it keeps its place relative to the head
    std::shared_ptr<const ClosedSurface> surface;        ///< in the laboratory (m), of the shape `surface` in space
    std::map<std::string, Wall>          walls; ///< complete after reading: every wall of the shape has its entry

    /// Whether the fluid can leave or enter freely somewhere, which also fixes the pressure's level.
    bool has_traction_free_wall() const;
    /// Whether a wall keeps the fluid from moving along with the swimmer as one rigid body.
    bool has_holding_wall() const;
  };

  /// A head's given motion about its place and angle at rest: all of it times sin(2 pi f t + phase).
  struct HeadOscillation
  {
    std::array<double, 2> amplitude_m  = {0., 0.};
    double                angle_rad    = 0.;
    double                frequency_Hz = 0.;
    double                phase_rad    = 0.;
  };

  /// Rigid head; `size_m` is its full extent along x and y at rest (a disc's two diameters are equal). One that is read
  /// from a surface has the larger of its extents along y and z there.
  struct Head
  {
    HeadShape             shape             = HeadShape::rectangle;
    std::array<double, 2> size_m            = {0., 0.};
    std::array<double, 2> center_m          = {0., 0.};
    double                angle_rad         = 0.; ///< of the whole swimmer at time 0
    double                density_kg_m3     = 0.;
    double                magnetization_A_m = 0.;
    /// Unit vector in the head's frame; in two dimensions +x.
    std::array<double, 3> magnetization_direction = {1., 0., 0.};
    HeadMotion            motion                  = HeadMotion::free;
    HeadOscillation       oscillation; ///< of a prescribed motion
    /// Of the shape `surface`, in space: in the head's frame (m), whose origin is the centre of its volume.
    std::shared_ptr<const ClosedSurface>  surface;
    std::shared_ptr<const EnclosedVolume> enclosed;

    /// Whether forces move it.
    bool is_free() const { return motion == HeadMotion::free; }
    bool is_driven() const { return motion == HeadMotion::prescribed; }

    // The head is rigid: accepted and kept, not used.
    std::optional<double> young_modulus_Pa, poisson_ratio;

    /// Area (m^2) of the shape in the plane.
    double area_m2() const;
    /// Volume: area (m^2) in two dimensions, in three that of the shape turned about x (m^3).
    double volume(int dimension) const;
    /// int (x^2 + y^2) dV about the centre: times the density, the moment of inertia about z.
    double second_moment(int dimension) const;
    /// In space: int (r^2 I - r r^T) dV in the head's frame; times the density, the tensor of inertia about the centre.
    std::array<std::array<double, 3>, 3> second_moments() const;
  };

  /// A tail's given bending: its axis, inextensible and with rigid cross sections, has at the arc length s from the
  /// head the angle angle_rad s/L sin(2 pi (f t - waves s/L) + phase) to the head's. A wave runs from the head to the
  /// tip; without one (waves = 0) the motion is reciprocal.
  struct TailWave
  {
    double angle_rad    = 0.;
    double frequency_Hz = 0.;
    double waves        = 0.;
    double phase_rad    = 0.;
  };

  /// Elastic tail along +x, clamped to the head; it starts at the head's surface. The length is measured on the axis,
  /// from the head's foremost point to the tip. Heights are diameters in space.
  struct Tail
  {
    double length_m      = 0.;
    double root_height_m = 0.;
    double tip_height_m  = 0.; ///< of the straight sides where they end; a rounded tip has half of it as radius
    /// Distance (m) from where the length begins and half height there, of points on sides that are not straight
    /// (datasets/scene/tail_outline.h); the three lengths above follow from them.
    std::vector<std::array<double, 2>> profile_m;
    TipShape                           tip     = TipShape::rounded;
    TailSection                        section = TailSection::circular; ///< in space
    double                             width_m = 0.; ///< along z, of a rectangular section; heights are along y
    /// Of a body that is read from a surface: which of it is the tail. The three lengths above are then those of a cone
    /// as long, with the same diameter at its root and as much volume.
    std::shared_ptr<const ElasticPart> part;
    MaterialModel                      law              = MaterialModel::st_venant_kirchhoff;
    double                             young_modulus_Pa = 0., poisson_ratio = 0., density_kg_m3 = 0.;
    double   magnetization_A_m = 0.; ///< along the tail's +x in the reference configuration; energy -int B . (F M)
    TailWave wave;                   ///< of a prescribed shape
    bool     is_rigid() const { return law == MaterialModel::rigid; }
    bool     is_driven() const { return law == MaterialModel::prescribed; }
    bool     is_elastic() const { return !is_rigid() && !is_driven(); } ///< else moduli are without meaning
    bool     has_inertia_in_vacuum = false;                             ///< else it is in equilibrium at every instant

    /// Of the sides, between the head and their end.
    double mean_height_m() const;
  };

  struct Gravity
  {
    std::array<double, 3> acceleration_m_s2 = {0., 0., 0.}; ///< z: in three dimensions
    double                ramp_s            = 0.;

    bool leaves_plane() const { return acceleration_m_s2[2] != 0.; }
  };

  /// `n_steps()` equal steps. A period is that of the field; without one it is the whole duration.
  struct TimeSettings
  {
    double period_s         = 0.;
    double periods          = 1.;
    int    steps_per_period = 0;
    bool   is_steady = false; ///< no time: loads and walls as they are in the end, and the flow and shape they lead to

    double time_step_s() const { return period_s / steps_per_period; }
    int    n_steps() const;
  };

  /// Of the plane; mesh_growth, remesh_quality and reuse_factorization have others in space (read_numerics.cc).
  struct Numerics
  {
    // meshes
    double mesh_size_m        = 0.;    ///< at the swimmer's surface
    double mesh_size_corner_m = 0.;    ///< at the head's convex corners and at the tail's tip; 0: mesh_size_m
    double mesh_size_far_m    = 0.;    ///< upper bound, far away and at the walls
    double mesh_growth        = 0.3;   ///< increase of mesh size per length of distance
    int    tail_order         = 2;     ///< 1 or 2
    bool   mirror_meshes      = false; ///< reflect every mesh at y = 0 (to test mirror symmetry)

    /// Mesh and solve the upper half alone and reflect it, where the scene has a mirror plane
    /// (datasets/scene/mirror_plane.h).
    SymmetricHalf symmetric_half = SymmetricHalf::automatic;

    // mesh motion and remeshing
    MeshMotion mesh_motion = MeshMotion::elastic;
    double remesh_quality  = 0.2; ///< remesh when the worst element's quality falls below (1: equilateral, 0: inverted)
    int    remesh_every_steps = 0; ///< 0: by quality alone

    // coupling and solvers
    CouplingScheme coupling = CouplingScheme::monolithic;
    /// On a step's configuration, root mean square over the tail in body lengths: its estimated error (monolithic), or
    /// the last iteration's residual (fixed-point).
    double             coupling_tolerance      = 1e-6;
    int                max_coupling_iterations = 20;                         ///< 200 for a fixed point
    AccelerationMethod acceleration            = AccelerationMethod::aitken; ///< of a fixed point
    double             relaxation              = 0.3; ///< its first factor at a full step, before anything was learnt
    int                iqn_reused_steps        = 8;
    LinearSolver       linear_solver           = LinearSolver::automatic;
    double             linear_tolerance        = 1e-7; ///< on the preconditioned residual, relative to the solution
    bool               reuse_factorization     = false;
    int                max_step_halvings       = 6;
  };

  struct OutputSettings
  {
    int snapshots_per_period = 50;
    int fields_per_period    = 0; ///< 0: no ParaView files
  };

  struct Scene
  {
    std::string                    name; ///< file name without its extension
    int                            dimension = 2;
    std::optional<FluidProperties> fluid;  ///< absent: a solid in vacuum
    std::optional<Domain>          domain; ///< present exactly when fluid is
    Head                           head;
    std::optional<Tail>            tail;
    FieldProgram                   field;
    Gravity                        gravity;
    TimeSettings                   time;
    Numerics                       numerics;
    OutputSettings                 output;

    /// The TOML after overrides and the digests of the field program and of surfaces, as solved: written into every
    /// output.
    std::string text;
    std::string hash; ///< SHA-256 (or an equivalent digest) of `text`, hexadecimal

    /// Length (m) of head and tail at rest along x: the body length of every tolerance. Of a rigid body that is read
    /// from a surface the largest extent.
    double body_length_m() const;
    /// Whether the body, or walls, are read from a surface: nothing is then known to be its own mirror image.
    bool has_surfaces() const { return head.surface || (domain && domain->surface); }
    /// Whether there are a fluid and an elastic tail, which a partitioned coupling solves in turn.
    bool can_be_partitioned() const { return fluid && tail && tail->is_elastic(); }
    bool is_partitioned() const { return numerics.coupling == CouplingScheme::fixed_point && can_be_partitioned(); }
  };

  /// Read and validate a scene file, after applying overrides of the form "key.path=value" (`--set`). Throws InputError
  /// with file, line, key, value, unit, rule and remedy, and the nearest known name for an unknown key.
  /// Relative paths of field programs and surfaces are relative to the scene file.
  Scene read_scene(const std::filesystem::path &file, const std::vector<std::string> &overrides = {});
  /// The same from text; `name` stands in for the file in messages.
  Scene parse_scene(std::string_view text, const std::string &name, const std::vector<std::string> &overrides = {});
} // namespace swimtwin
