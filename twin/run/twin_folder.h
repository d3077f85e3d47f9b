// A twin's folder: a table that is whole at any time, and what a killed twin goes on from.
#pragma once

#include <datasets/system/provenance.h>
#include <twin/run/twin_session.h>

#include <filesystem>
#include <string>
#include <vector>

namespace swimtwin
{
  inline constexpr const char *twin_table_name   = "twin.csv";
  inline constexpr const char *twin_summary_name = "twin.json";
  inline constexpr const char *twin_state_name   = "twin-state.json";
  inline constexpr const char *alarms_name       = "twin-alarms.jsonl";
  inline constexpr const char *proposals_name    = "twin-proposals.jsonl"; ///< with [telling]
  inline constexpr const char *steering_name     = "steering.csv";         ///< with a goal

  /// A file to which whole lines are appended, each by one write.
  class AppendedFile
  {
  public:
    AppendedFile() = default;
    /// Throws ComputationError.
    explicit AppendedFile(const std::filesystem::path &file);
    ~AppendedFile();
    AppendedFile(AppendedFile &&other) noexcept;
    AppendedFile &operator=(AppendedFile &&other) noexcept;

    /// Throws ComputationError that names the file and the cause.
    void append_line(std::string line);

  private:
    std::filesystem::path file_;
    int                   descriptor_ = -1;
  };

  class TwinFolder
  {
  public:
    /// `fingerprint`: of model and configuration, with which alone one can go on.
    TwinFolder(std::filesystem::path folder, std::string fingerprint);

    /// Go on with what is there: the session gets its memory, then the lines that came since. Throws InputError for
    /// another model or configuration, or a state that cannot be read.
    void resume(TwinSession &session);
    /// Begin a folder.
    void begin(const TwinSession &session);

    /// Before a line is worked on.
    void remember_line(const std::string &line) { journal_.append_line(line); }
    void note(const TwinSession &session, const EstimateRecord &record);
    void note(const PlayRecord &record);
    void note_alarm(const std::string &line) { alarms_.append_line(line); }
    void note_proposal(const std::string &line) { proposals_.append_line(line); }
    /// From here on a killed twin goes on.
    void save(const TwinSession &session);
    void write_summary(const TwinSession &session, const Provenance &provenance) const;
    /// Nothing is left to go on with.
    void close();

  private:
    std::filesystem::path journal_file(long number) const;

    std::filesystem::path folder_;
    std::string           fingerprint_;
    AppendedFile          table_, alarms_, proposals_, steering_, journal_;
    long                  journal_number_ = 0, n_rows_ = 0, n_rows_in_file_ = 0;
  };
} // namespace swimtwin
