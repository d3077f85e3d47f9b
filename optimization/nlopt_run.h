// One run of an algorithm of NLopt on a problem in scaled quantities.
#pragma once

#include <optimization/guarded_search.h>
#include <optimization/scaled_problem.h>
#include <optimization/search_record.h>

namespace swimtwin
{
  /// From `start` until the algorithm stops, fails or the budget is spent; what it found is in the record. NLopt's
  /// return code is not looked at: it tells success where there is none. Throws what evaluating the problem throws.
  void run_nlopt(const MinimizationProblem &problem, const Scales &scales, const Eigen::VectorXd &start,
                 const SearchOptions &options, SearchRecord &record);
} // namespace swimtwin
