// What a calibration reads, all of it before any of it is worked on.
#pragma once

#include <app/verbs/calibrate.h>

#include <datasets/observation/calibration_problem.h>
#include <datasets/observation/observation_set.h>
#include <datasets/reduced/reduced_model.h>

namespace swimtwin
{
  struct CalibrationInput
  {
    ReducedModel                model;
    CalibrationProblem          problem;
    std::vector<ObservationSet> sets;
  };

  /// Throws InputError; of several files of observations it lists the errors of all.
  CalibrationInput read_calibration_input(const CalibrateCommand &command);

  /// What will be fitted to what, for people: free parameters, and of each data set its points, sizes, field and
  /// origin.
  std::string summary(const CalibrationInput &input);
} // namespace swimtwin
