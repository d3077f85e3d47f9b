// What a laboratory observed of one swimmer in one field: displacement per period against frequency, with error bars.
#pragma once

#include <datasets/scene/field_program.h>
#include <datasets/tracks/data_problems.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace swimtwin
{
  /// What the file holds; whatever it is, an Observation is a displacement per period.
  enum class ObservedQuantity {
    displacement, ///< per period
    mean_speed,   ///< over a period; divided by the frequency when read
    positions     ///< of a tracked head, with time
  };

  /// One point of the curve.
  struct Observation
  {
    double frequency_Hz   = 0.;
    double displacement_m = 0.; ///< of the head's centre per period, positive along the initial head-first direction
    double sigma_m        = 0.; ///< one standard deviation of it
    std::string where;          ///< `file:line` it was read from, for messages

    // Of a tracked head, else 0:
    int    n_periods         = 0;  ///< whole periods that the displacement is the mean of
    double scatter_m         = 0.; ///< standard deviation from period to period (needs two)
    double heading_drift_rad = 0.; ///< angle between the way made and the head-first direction
  };

  struct ObservationSet
  {
    std::string           name; ///< file name without its extension, and its folder where sets are to be told apart
    std::filesystem::path file;

    // Of the sidecar:
    std::string           source, swimmer, measured_by; ///< in words
    bool                  synthetic   = false;
    bool                  has_inertia = true; ///< of swimmer and fluid; only computed data can be without
    std::optional<int>    dimension;          ///< of a computed swimmer, if the sidecar says it
    std::optional<double> temperature_C;      ///< of the fluid
    std::optional<double> body_length_m;      ///< of the swimmer, to tell whether sizes are plausible
    std::optional<int>    period = 3;         ///< counted from 1, after a start from rest; none: the periodic state
    FieldProgram          field;              ///< its shape: sinusoidal or sampled; `field_at` plays it at a frequency

    ObservedQuantity         quantity = ObservedQuantity::displacement;
    std::vector<Observation> points; ///< by increasing frequency
    /// Further columns of a curve as they stand in the file: name -> one cell per point.
    std::map<std::string, std::vector<std::string>> extra_columns;
    std::vector<std::string>                        warnings; ///< for printing; one sentence each, with file and line
  };

  /// The field of the set's shape whose period is 1 / frequency.
  FieldProgram field_at(const ObservationSet &set, double frequency_Hz);

  /// Read a table and its sidecar: the very table that is named, or the one that belongs to a sidecar that is named
  /// (datasets/observation/observation_files.h). What the files look like is written in docs/file-formats.md,
  /// "Observations". Throws InputError that lists every error of the files, one per line, each with file, line, column
  /// and remedy.
  ObservationSet read_observations(const std::filesystem::path &file);

  /// Several sets, with names that tell them apart; the errors of all at once. A file that is named twice is one of
  /// them.
  std::vector<ObservationSet> read_observations(const std::vector<std::filesystem::path> &files);

  /// Every problem of a file and its sidecar, errors first; empty when there is nothing to say. Does not throw for what
  /// is wrong in the files.
  std::vector<DataProblem> lint_observations(const std::filesystem::path &file);

  /// Whether displacements look like another unit beside a body of this length: larger than three body lengths, or
  /// below 1e-9 m. `read_observations` does it by itself when the sidecar names `body_length_m`, else with a
  /// centimetre.
  std::vector<std::string> implausible_sizes(const ObservationSet &set, double body_length_m);
} // namespace swimtwin
