// What is wrong with a user's data files, all of it at once.
#pragma once

#include <datasets/system/error.h>
#include <datasets/text/wrong_row.h>

#include <string>
#include <vector>

namespace swimtwin
{
  enum class Severity { warning, error };

  /// Something to know about a data file.
  struct DataProblem
  {
    Severity    severity = Severity::error;
    std::string text; ///< `file:line: what is wrong; remedy.`
    /// All that is wrong: without these rows of the table there would be no such error. None: it is the table's.
    std::vector<WrongRow> rows = {};
  };

  /// Collects problems in the order in which they are found, each once.
  class DataProblems
  {
  public:
    void error(std::string text, std::vector<WrongRow> rows = {})
    {
      add({Severity::error, std::move(text), std::move(rows)});
    }
    void warning(std::string text) { add({Severity::warning, std::move(text)}); }
    void append(const DataProblems &others);
    /// Run `read` and note the InputError that it may throw as an error; false if it did.
    template <typename Action>
    bool attempt(const Action &read)
    {
      try
      {
        read();
        return true;
      }
      catch (const InputError &problem)
      {
        error(problem.what());
        return false;
      }
    }

    bool has_errors() const { return n_errors_ > 0; }
    /// Errors first.
    std::vector<DataProblem> all() const;
    std::vector<std::string> texts(Severity severity) const;
    /// Of all errors.
    std::vector<WrongRow> wrong_rows() const;
    /// Throw InputError with the errors, one per line and some dozens at most, if there are any.
    void throw_errors() const;

  private:
    void add(DataProblem problem);

    std::vector<DataProblem> problems_;
    std::size_t              n_errors_ = 0;
  };
} // namespace swimtwin
