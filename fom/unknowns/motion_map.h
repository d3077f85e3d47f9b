// The motion map P: every nodal velocity and pressure as a linear function of what is really unknown.
#pragma once

#include <fom/geometry/rigid_pose.h>
#include <fom/geometry/simplex_mesh.h>

#include <deal.II/dofs/dof_handler.h>

#include <optional>
#include <vector>

namespace swimtwin
{
  /// Numbers of nodal values on a mesh, with the rank that owns each: velocity components at all nodes and, for a
  /// fluid, pressures at vertices. deal.II distributes them.
  template <int dim>
  class NodeNumbering
  {
  public:
    NodeNumbering(const SimplexMesh<dim> &mesh, bool with_pressure);

    unsigned int size() const { return owner_.size(); }
    unsigned int vector_index(const unsigned int node, const unsigned int component) const
    {
      return vector_index_[node * dim + component];
    }
    unsigned int                   pressure_index(const unsigned int vertex) const { return pressure_index_[vertex]; }
    unsigned int                   owner(const unsigned int index) const { return owner_[index]; }
    const dealii::DoFHandler<dim> &dof_handler() const { return dof_handler_; }

  private:
    dealii::DoFHandler<dim>   dof_handler_;
    std::vector<unsigned int> vector_index_, pressure_index_;
    std::vector<unsigned int> owner_;
  };

  /// P as a sparse matrix with a constant part: value(row) = sum_k coefficient_k unknown_k + imposed(row).
  ///
  /// Rows are the nodal values of the fluid, then those of the tail, then the head's own velocities (m/s, rad/s). A row
  /// is free (one unknown of its own), imposed (no unknown), tied to other rows, moves with the head, or turns with it
  /// beside what another row says. Unknowns are numbered by rank; the head's come last: velocities (m/s) and angular
  /// velocities times the length scale (m/s), so that all have like size.
  template <int dim>
  class MotionMap
  {
  public:
    struct Term
    {
      unsigned int unknown;
      double       coefficient;
    };

    MotionMap(unsigned int n_fluid_rows, unsigned int n_tail_rows, double length_scale_m);

    // Description, in any order; rows not mentioned are free.
    /// The row has a given value, set with `imposed`.
    void impose(unsigned int row);
    /// Component c of a node of the head, or clamped to it, at X in the head frame.
    void tie_to_head(unsigned int row, unsigned int component, const dealii::Tensor<1, dim> &X);
    /// Component c of a node at X in the head frame: the row of its velocity without the head's rotation, plus that.
    void tie_and_turn(unsigned int row, unsigned int without_rotation, unsigned int component,
                      const dealii::Tensor<1, dim> &X);
    /// Move a node of either kind in the head frame; any time.
    void move_on_head(const unsigned int row, const dealii::Tensor<1, dim> &X)
    {
      head_rows_[head_row_of_row_[row]].X = X;
    }
    /// The row is the mean of other rows (one: equal to it).
    void tie(unsigned int row, std::vector<unsigned int> masters);
    /// The row mirrors another one: it equals `sign` times that. What was imposed before stays imposed.
    void reflect(unsigned int row, unsigned int original, double sign);
    /// Of a free head's velocities (translations, then rotations) only these, in their order, are unknowns; the others
    /// are zero.
    void keep_head_to(std::vector<int> components) { head_components_ = std::move(components); }

    /// Number the unknowns. `owner` tells the rank of each row; a free head belongs to the last rank.
    void close(const std::vector<unsigned int> &owner, bool head_is_free, MPI_Comm communicator);

    /// A prescribed value of one of a held head's velocities (m/s, rad/s), or an addition to what a row that is tied to
    /// it has from there (a tail whose shape is given); any time before `set_rotation`. Ignored for rows that follow
    /// such a row, as images do: they have its value.
    void give(unsigned int row, double value);

    /// Turn the head: updates the coefficients of rows that move with it, also after `move_on_head` and `give`. Which
    /// unknowns a row has never changes.
    void set_rotation(const dealii::Tensor<2, dim> &rotation);

    std::vector<double> imposed; ///< constant part of every row: zero until set; what follows from `give` sets itself

    unsigned int n_rows() const { return kind_.size(); }
    unsigned int n_unknowns() const { return n_unknowns_; }
    unsigned int first_owned() const { return first_owned_; }
    unsigned int last_owned() const { return last_owned_; }
    bool         head_is_free() const { return head_is_free_; }
    unsigned int n_head_unknowns() const { return head_is_free_ ? head_components_.size() : 0; }
    /// Which of the head's velocities (U, then omega) its i-th unknown is; rotations times the length scale.
    int head_component(const unsigned int i) const { return head_components_[i]; }
    /// The unknown of one of them; none if it is zero or given.
    std::optional<unsigned int> head_unknown(int component) const;
    /// Row of the head's k-th velocity: translations, then rotations.
    unsigned int head_row(const unsigned int k) const { return n_rows() - n_rigid<dim> + k; }
    unsigned int first_head_unknown() const { return n_unknowns_ - n_head_unknowns(); }
    double       length_scale() const { return length_scale_; }

    const Term *begin(const unsigned int row) const { return terms_.data() + first_term_[row]; }
    const Term *end(const unsigned int row) const { return terms_.data() + first_term_[row + 1]; }

    /// One row from the unknowns.
    double value(const unsigned int row, const std::vector<double> &unknowns) const
    {
      double sum = imposed[row];
      for (const Term *term = begin(row); term != end(row); ++term)
        sum += term->coefficient * unknowns[term->unknown];
      return sum;
    }
    /// All rows from the unknowns: P y + imposed.
    std::vector<double> expand(const std::vector<double> &unknowns) const;
    /// Add P^T of a load on one row.
    void add_load(unsigned int row, double load, std::vector<double> &right_hand_side) const;

  private:
    enum class Kind : char { free, imposed, on_head, head, tied, turning };
    struct HeadRow
    {
      unsigned int           component;
      dealii::Tensor<1, dim> X;
    };
    void   append_terms(unsigned int row, double factor);
    void   append_rotation(const HeadRow &row, double factor);
    void   build_terms();
    double given_rotation(const HeadRow &row) const;
    double follow_given(unsigned int row) const;

    double                                 length_scale_;
    std::vector<Kind>                      kind_;
    std::vector<HeadRow>                   head_rows_;
    std::vector<int>                       head_row_of_row_;
    std::vector<std::vector<unsigned int>> masters_;
    std::vector<double>                    sign_;    ///< of tied rows
    std::vector<unsigned int>              unknown_; ///< of free rows
    std::vector<double>                    given_;   ///< empty unless something is
    std::vector<Term>                      terms_;
    std::vector<unsigned int>              first_term_;
    unsigned int                           n_unknowns_ = 0, first_owned_ = 0, last_owned_ = 0;
    bool                                   head_is_free_ = false;
    std::vector<int>                       head_components_;
    dealii::Tensor<2, dim>                 rotation_;
  };
} // namespace swimtwin
