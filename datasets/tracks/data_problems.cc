#include <datasets/tracks/data_problems.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace swimtwin
{
  void DataProblems::add(DataProblem problem)
  {
    const auto is_told = [&](const DataProblem &other) {
      return other.severity == problem.severity && other.text == problem.text;
    };
    if (std::any_of(problems_.begin(), problems_.end(), is_told))
      return;
    n_errors_ += problem.severity == Severity::error ? 1 : 0;
    problems_.push_back(std::move(problem));
  }

  void DataProblems::append(const DataProblems &others)
  {
    for (const DataProblem &problem : others.problems_)
      add(problem);
  }

  std::vector<std::string> DataProblems::texts(const Severity severity) const
  {
    std::vector<std::string> found;
    for (const DataProblem &problem : problems_)
      if (problem.severity == severity)
        found.push_back(problem.text);
    return found;
  }

  std::vector<DataProblem> DataProblems::all() const
  {
    std::vector<DataProblem> sorted;
    for (const Severity severity : {Severity::error, Severity::warning})
      std::copy_if(problems_.begin(), problems_.end(), std::back_inserter(sorted),
                   [&](const DataProblem &problem) { return problem.severity == severity; });
    return sorted;
  }

  std::vector<WrongRow> DataProblems::wrong_rows() const
  {
    std::vector<WrongRow> rows;
    for (const DataProblem &problem : problems_)
      rows.insert(rows.end(), problem.rows.begin(), problem.rows.end());
    return rows;
  }

  void DataProblems::throw_errors() const
  {
    constexpr std::size_t    n_most = 30; // who has more starts with these
    std::vector<std::string> errors = texts(Severity::error);
    if (errors.size() > n_most)
    {
      errors[n_most - 1] = fmt::format("... and {} more errors: correct these first.", errors.size() - n_most + 1);
      errors.resize(n_most);
    }
    if (has_errors())
      throw InputError(fmt::format("{}", fmt::join(errors, "\n")));
  }
} // namespace swimtwin
