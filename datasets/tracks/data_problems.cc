#include <datasets/tracks/data_problems.h>

#include <fmt/format.h>

#include <algorithm>

namespace swimtwin
{
  void DataProblems::add(const Severity severity, std::string text)
  {
    const auto is_told = [&](const DataProblem &problem) {
      return problem.severity == severity && problem.text == text;
    };
    if (std::any_of(problems_.begin(), problems_.end(), is_told))
      return;
    n_errors_ += severity == Severity::error ? 1 : 0;
    problems_.push_back({severity, std::move(text)});
  }

  void DataProblems::append(const DataProblems &others)
  {
    for (const DataProblem &problem : others.problems_)
      add(problem.severity, problem.text);
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
      for (const std::string &text : texts(severity))
        sorted.push_back({severity, text});
    return sorted;
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
