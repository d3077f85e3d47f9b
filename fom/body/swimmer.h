// The body: rigid head and elastic tail, its surface, its kinematics and the loads that a field and gravity put on it.
#pragma once

#include <datasets/scene/scene.h>
#include <fom/elastic/elastic_tail.h>
#include <fom/geometry/rigid_pose.h>
#include <fom/mesh/body_mesh.h>

#include <memory>

namespace swimtwin
{
  /// Where every point of the body is: x = center + R (X + shape(X)), the shape zero at the head.
  template <int dim>
  struct Configuration
  {
    RigidPose<dim>  pose;
    NodalField<dim> shape; ///< m, at the tail's nodes, head frame; empty without a tail
  };

  /// Its rate of change.
  template <int dim>
  struct Rates
  {
    dealii::Tensor<1, dim> velocity;   ///< of the head's centre, m/s
    AngularVelocity<dim>   omega;      ///< rad/s
    NodalField<dim>        shape_rate; ///< m/s, head frame
  };

  /// How fast it is, in the laboratory.
  template <int dim>
  struct BodyVelocities
  {
    dealii::Tensor<1, dim> head; ///< of its centre, m/s
    AngularVelocity<dim>   omega;
    AngularVelocity<dim>
                    spin; ///< angular momentum of the head over its moment of inertia; omega of a sphere, and in 2D
    NodalField<dim> tail; ///< at its nodes
  };

  /// Torque (N m; N in 2D, per unit depth) of the field on the head, and the symmetric part of its derivative by the
  /// rotation vector: the rest is half of a cross product with the torque (docs/equations.md, section 3).
  template <int dim>
  struct MagneticTorque
  {
    AngularVelocity<dim>                        torque;
    dealii::Tensor<2, n_rotations<dim>, double> derivative;
    AngularVelocity<dim>                        axis; ///< the torque's, and where there is none any across the moment
  };

  /// m x B of a moment with a direction (unit vector) in the body's frame; in the laboratory.
  template <int dim>
  MagneticTorque<dim> magnetic_torque(double moment_A_m2, const dealii::Tensor<1, dim> &direction,
                                      const Attitude<dim> &attitude, const std::array<double, 3> &field_T);

  /// The body's description; it does not move. Built once per run. Collective; throws InputError if the scene's mesh
  /// size does not do for the tail.
  template <int dim>
  class Swimmer
  {
  public:
    Swimmer(const Scene &scene, MPI_Comm communicator);
    /// The same on a mesh of the body that is there already.
    Swimmer(const Scene &scene, BodyMesh<dim> body);

    bool                    has_tail() const { return body_.tail != nullptr; }
    bool                    can_bend() const { return has_tail() && scene_.tail->is_elastic(); }
    const TailMesh<dim>    &tail() const { return *body_.tail; }
    const ElasticTail<dim> &elasticity() const { return *elasticity_; }
    bool                    is_clamped(const unsigned int tail_node) const { return is_clamped_[tail_node]; }

    /// Surface nodes: position at rest (head frame), and the tail's node there, or -1 on the bare head.
    unsigned int               n_surface_nodes() const { return body_.surface.nodes.size(); }
    const dealii::Point<dim>  &surface_at_rest(const unsigned int k) const { return body_.surface.nodes[k]; }
    int                        tail_node(const unsigned int k) const { return body_.tail_node[k]; }
    const std::vector<double> &surface_mesh_size() const { return body_.surface_size; }
    const BodyMesh<dim>       &body() const { return body_; }

    RigidPose<dim>                  pose_at_rest() const;
    Configuration<dim>              configuration_at_rest() const;
    std::vector<dealii::Point<dim>> surface(const Configuration<dim> &configuration) const;
    std::vector<dealii::Point<dim>> tail_positions(const Configuration<dim> &configuration) const;
    /// Volume (m^3; m^2 in 2D) inside the surface, its quadratic faces included, and the rate at which it changes.
    double volume(const Configuration<dim> &configuration) const;
    double volume_rate(const Configuration<dim> &configuration, const Rates<dim> &rates) const;
    /// Laboratory velocities of the tail's nodes, and of the whole body.
    NodalField<dim>     tail_velocities(const Configuration<dim> &configuration, const Rates<dim> &rates) const;
    BodyVelocities<dim> velocities(const Configuration<dim> &configuration, const Rates<dim> &rates) const;

    /// Kinetic energy (J, per unit depth in 2D) of head and tail, as far as the scene gives them inertia.
    double kinetic_energy(const BodyVelocities<dim> &velocities) const;
    /// Force (N, per unit depth in 2D) that gives the tail's nodes an acceleration (m/s^2); empty without its inertia.
    NodalField<dim> inertial_force_on_tail(const NodalField<dim> &acceleration) const;
    /// Mass (kg, per unit depth in 2D) of head and its moment of inertia (kg m^2) about its centre, in space about its
    /// z.
    double head_mass() const { return scene_.head.density_kg_m3 * scene_.head.volume(dim); }
    double head_moment_of_inertia() const { return scene_.head.density_kg_m3 * scene_.head.second_moment(dim); }
    /// Tensor of inertia over this moment, in the laboratory: the spin per angular velocity.
    dealii::Tensor<2, n_rotations<dim>, double> relative_inertia(const Attitude<dim> &attitude) const;
    const InertiaTerms                         &inertia() const { return inertia_; }

    /// Distance between two configurations relative to the body: root mean square over the tail, or the head's.
    double relative_change(const Configuration<dim> &a, const Configuration<dim> &b) const;

    /// Load of field and gravity on tail node a (laboratory, N per unit depth).
    dealii::Tensor<1, dim> load_on_tail_node(unsigned int a, double time_s) const;
    /// The field's part of it.
    dealii::Tensor<1, dim> magnetic_load_on_tail_node(unsigned int a, double time_s) const;
    /// Force of gravity less buoyancy on the head, and the field's torque on it.
    dealii::Tensor<1, dim> force_on_head(double time_s) const;
    MagneticTorque<dim>    torque_on_head(const Attitude<dim> &attitude, double time_s) const;

    /// From the head's centre to the body's middle, the mean position of its surface (m, head frame): linear in the
    /// shape. The middle is what time stepping advances (docs/equations.md, section 6); of a head that is not free
    /// it is the centre.
    dealii::Tensor<1, dim> arm_to_middle(const NodalField<dim> &shape) const;
    dealii::Tensor<1, dim> rate_of_arm(const NodalField<dim> &shape_rate) const; ///< m/s

    /// Angle (rad, from +x, not unwrapped) of the tail's axis at its tip; in space in the plane of x and y.
    double tail_angle(const Configuration<dim> &configuration) const;

    const Scene &scene() const { return scene_; }

  private:
    static BodyMesh<dim>                make_body(const Scene &scene, MPI_Comm communicator);
    void                                make_tail();
    void                                weigh_surface();
    std::vector<dealii::Tensor<1, dim>> surface_in_head_frame(const Configuration<dim> &configuration) const;
    dealii::Tensor<1, dim>              effective_gravity(double body_density_kg_m3, double time_s) const;

    const Scene                      &scene_;
    BodyMesh<dim>                     body_;
    std::unique_ptr<ElasticTail<dim>> elasticity_;
    std::vector<double>               surface_weight_; ///< share of the surface that is a node's
    dealii::Tensor<1, dim>            arm_at_rest_;
    std::vector<char>                 is_clamped_;
    double                            body_length_;
    bool                              is_symmetric_; ///< half of the scene is solved and reflected
    InertiaTerms                      inertia_;
  };
} // namespace swimtwin
