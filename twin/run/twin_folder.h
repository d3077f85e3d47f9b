// A twin's folder: tables that are whole at any time, and what a killed twin goes on from.
#pragma once

#include <datasets/files/appended_file.h>
#include <datasets/system/provenance.h>
#include <twin/run/twin_log.h>
#include <twin/run/twin_session.h>

#include <filesystem>
#include <future>
#include <string>
#include <vector>

namespace swimtwin
{
  inline constexpr const char *twin_table_name   = "twin.csv";
  inline constexpr const char *twin_log_name     = "twin.h5";
  inline constexpr const char *twin_summary_name = "twin.json";
  inline constexpr const char *twin_state_name   = "twin-state.json";
  inline constexpr const char *alarms_name       = "twin-alarms.jsonl";
  inline constexpr const char *proposals_name    = "twin-proposals.jsonl"; ///< with [telling]
  inline constexpr const char *steering_name     = "steering.csv";         ///< with a goal

  class TwinFolder
  {
  public:
    /// `fingerprint`: of model and configuration, with which alone one can go on.
    TwinFolder(std::filesystem::path folder, std::string fingerprint, Provenance provenance);

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
    /// From here on a killed twin goes on. Files are written beside what follows, which a slow disk does not hold up;
    /// what cannot be written is thrown by a later call.
    void save(const TwinSession &session);
    void wait_until_saved();
    /// The summary is written, and nothing is left to go on with.
    void finish(const TwinSession &session);

  private:
    std::filesystem::path journal_file(long number) const;
    void                  write_summary(const TwinSession &session) const;

    std::filesystem::path    folder_;
    std::string              fingerprint_;
    Provenance               provenance_;
    AppendedFile             table_, alarms_, proposals_, steering_, journal_;
    std::optional<TwinLog>   log_;      ///< once it is begun
    std::vector<std::string> new_rows_; ///< that it lacks
    std::future<void>        saving_;
    long                     journal_number_ = 0, n_rows_ = 0, n_rows_in_file_ = 0;
  };
} // namespace swimtwin
