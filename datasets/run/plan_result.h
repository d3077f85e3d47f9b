// What a search for a field found, what it is measured against, and whether the full-order model agrees: plan.json.
#pragma once

#include <datasets/run/refinement.h>
#include <datasets/system/provenance.h>

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  struct PlanTraceStep
  {
    long   n_periods     = 0;  ///< integrated so far
    double objective     = 0.; ///< of the best field so far: of one that keeps to all limits, once there is one
    double violation     = 0.; ///< of its limits, relative
    long   n_evaluations = 0;  ///< fields looked at so far, with derivatives or without
  };

  /// A periodic field and the motion that it makes.
  struct PlannedField
  {
    std::string name;   ///< "reference sinusoid", "tuned sinusoid", "optimal field", "gradient-free"
    std::string status; ///< of the search: "converged", "infeasible", ...; "given" without one
    std::string message;

    /// Bias, then cosine and sine of each harmonic (T).
    std::vector<double> bx_T, by_T;
    double              frequency_Hz = 0.;
    /// Of the periodic motion at phase 0: head's angle (rad), coordinates of the shape (m), and velocities with
    /// inertia.
    std::vector<double> start;

    bool                          moves          = false; ///< a periodic motion was found; nothing below counts without
    double                        mean_speed_m_s = 0., displacement_m = 0.;
    double                        sideways_m = 0.;      ///< drift per period across the direction of travel
    std::vector<double>           multipliers;          ///< Floquet's, in size, the largest first
    std::map<std::string, double> terms;                ///< of the objective, in their units
    double                        objective       = 0.; ///< relative, as weighted; smaller is better
    double                        largest_field_T = 0., largest_slew_T_s = 0.; ///< of |B| and |dB/dt|
    double                        largest_shape_radius = 0., largest_strain = 0., largest_heading_deviation_rad = 0.;
    /// The worst limit, relative to its bound, on a grid ten times as fine as the search's; at most 0 if all are kept.
    double field_excess = 0., motion_excess = 0.;

    double                     kkt_residual  = std::numeric_limits<double>::quiet_NaN(); ///< without a search
    long                       n_evaluations = 0, n_gradients = 0, n_periods = 0;
    int                        n_starts = 0;
    std::vector<PlanTraceStep> trace; ///< of the best start
  };

  /// One point of the curve of gain against heading stability.
  struct TradeOffPoint
  {
    double      largest_multiplier = 0.; ///< the bound
    double      tuned_speed_m_s = 0., optimal_speed_m_s = 0.;
    double      tuned_frequency_Hz = 0., optimal_frequency_Hz = 0.;
    std::string tuned_status, optimal_status;
  };

  struct ReplayedField
  {
    std::string         name;
    double              start_angle_rad = 0.;   ///< from where the motion settles fastest
    std::vector<double> displacement_m;         ///< per period, of the full-order model
    std::vector<double> reduced_displacement_m; ///< of the reduced swimmer from the same start
    double              mean_speed_m_s = 0.;    ///< of the last period
  };

  struct PlanReplay
  {
    int                        steps_per_period = 0;
    std::vector<ReplayedField> fields; ///< the tuned sinusoid, then the optimal field
    double                     wall_time_s = 0.;

    double gain() const { return fields.at(1).mean_speed_m_s / fields.at(0).mean_speed_m_s; }
    /// Of the last period's displacements on both models, relative; the larger of both fields. NaN where one is not
    /// known.
    double largest_difference() const;
  };

  /// One swimmer of a robust plan.
  struct PlannedMember
  {
    double young_modulus_Pa = 0., viscosity_Pa_s = 0.;
    double magnetization_A_m = 0.; ///< times the scale of the field
    double mean_speed_m_s = 0., tuned_speed_m_s = 0., largest_multiplier = 0.;
  };

  struct PlanResult
  {
    std::string status = "not run"; ///< of the optimal field's search
    std::string message;
    std::string model_file, scene_name, goal_text;

    double young_modulus_Pa = 0., viscosity_Pa_s = 0., magnetization_A_m = 0.;
    /// Terms of inertia that the swimmer carried, by their names in [fluid] inertia; plans of earlier versions have
    /// none.
    std::vector<std::string> inertia;
    double                   heading_rad = 0., sample_rate_Hz = 0.;

    std::vector<PlannedField>    fields;
    std::vector<TradeOffPoint>   trade_off;
    std::vector<PlannedMember>   members; ///< of a robust plan
    std::optional<PlanReplay>    replay;
    std::vector<RefinementRound> refinement; ///< of the model: each round's, the last one made this plan; or empty
    std::vector<std::string>     warnings;
    double                       search_time_s = 0.;
    unsigned long                seed          = 0;
    Provenance                   provenance;

    /// Null if there is none.
    const PlannedField *find(const std::string &name) const;
    /// Mean speed of the optimal field over that of the tuned sinusoid; NaN if one of them is missing.
    double gain() const;
    /// "confirmed: ..." or "not confirmed: ..." by the full-order model.
    std::string confirmation() const;
  };

  inline constexpr const char *reference_field_name = "reference sinusoid", *tuned_field_name = "tuned sinusoid",
                              *optimal_field_name = "optimal field", *given_field_name = "given field",
                              *gradient_free_field_name = "gradient-free";
  /// Largest difference of the gains of both models that counts as a confirmation.
  inline constexpr double confirming_difference = 0.1;

  void write_plan_result(const std::filesystem::path &file, const PlanResult &result);
  /// Throws InputError that names the file and what is missing or of the wrong kind.
  PlanResult read_plan_result(const std::filesystem::path &file);
} // namespace swimtwin
