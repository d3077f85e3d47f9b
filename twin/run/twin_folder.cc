#include <datasets/files/input_file.h>
#include <datasets/files/json_entries.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/error.h>
#include <twin/run/twin_folder.h>
#include <twin/run/twin_rows.h>

#include <fmt/format.h>

#include <fstream>
#include <system_error>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr int state_format = 1;

    Json steering_json(const Pilot &pilot)
    {
      Json json             = Json::object();
      json["phase"]         = to_string(pilot.phase());
      json["path_length_m"] = pilot.wanted_path().length_m();
      json["arc_m"]         = pilot.memory().arc_m;
      json["path_m"]        = Json::array();
      if (pilot.has_path())
        for (const Eigen::Vector2d &point : pilot.path().points_m())
          json["path_m"].push_back({point.x(), point.y()});
      return json;
    }

    void take_again(const fs::path &journal, TwinSession &session)
    {
      cut_to_whole_lines(journal);
      std::ifstream lines(journal);
      for (std::string line; std::getline(lines, line);)
        session.take_again(line);
    }
  } // namespace

  TwinFolder::TwinFolder(fs::path folder, std::string fingerprint, Provenance provenance)
      : folder_(std::move(folder)), fingerprint_(std::move(fingerprint)), provenance_(std::move(provenance))
  {
  }

  fs::path TwinFolder::journal_file(const long number) const
  {
    return folder_ / fmt::format("twin-journal-{}.jsonl", number);
  }

  void TwinFolder::begin(const TwinSession &session)
  {
    const std::vector<TableColumn> columns = estimate_columns(session);
    table_                                 = AppendedFile(folder_ / twin_table_name);
    table_.append_line(header_of(columns));
    log_.emplace(folder_ / twin_log_name, columns).begin(provenance_);
    alarms_ = AppendedFile(folder_ / alarms_name);
    if (session.proposes_fields())
      proposals_ = AppendedFile(folder_ / proposals_name);
    if (session.pilot() != nullptr)
    {
      steering_ = AppendedFile(folder_ / steering_name);
      steering_.append_line(decision_header);
    }
    journal_ = AppendedFile(journal_file(0));
    write_json_file(
        folder_ / twin_state_name,
        {{"format", state_format}, {"fingerprint", fingerprint_}, {"journal", 0}, {"rows", 0}, {"session", nullptr}});
  }

  void TwinFolder::resume(TwinSession &session)
  {
    const fs::path file = folder_ / twin_state_name;
    if (std::error_code error; !fs::exists(file, error))
      throw InputError(fmt::format("{} holds no twin that was interrupted: leave --resume out.", folder_.string()));
    const Json state  = read_json_file(file, "the twin's state", "start afresh with --force");
    const auto refuse = [&](const std::string &what) {
      throw InputError(fmt::format("{} {}; start afresh with --force.", file.string(), what));
    };
    std::string fingerprint;
    try
    {
      read_entry(state, "fingerprint", fingerprint);
      read_entry(state, "journal", journal_number_);
      read_entry(state, "rows", n_rows_);
      if (fingerprint != fingerprint_)
        refuse("is of another model or configuration");
      if (!state.at("session").is_null())
        session.restore(state.at("session"));
    }
    catch (const Json::exception &)
    {
      refuse("lacks its session");
    }
    catch (const InputError &error)
    {
      const std::string what = error.what();
      if (what.starts_with(file.string()))
        throw;
      refuse(what);
    }
    n_rows_in_file_ = std::max(0L, cut_to_whole_lines(folder_ / twin_table_name) - 1);
    table_          = AppendedFile(folder_ / twin_table_name);
    log_.emplace(folder_ / twin_log_name, estimate_columns(session))
        .resume(folder_ / twin_table_name, n_rows_, provenance_);
    cut_to_whole_lines(folder_ / alarms_name);
    alarms_ = AppendedFile(folder_ / alarms_name);
    if (session.proposes_fields())
    {
      cut_to_whole_lines(folder_ / proposals_name);
      proposals_ = AppendedFile(folder_ / proposals_name);
    }
    if (session.pilot() != nullptr)
    {
      cut_to_whole_lines(folder_ / steering_name);
      steering_ = AppendedFile(folder_ / steering_name);
    }
    // Killed while it saved, it has the journal before still, or has begun the next one.
    std::error_code ignored;
    fs::remove(journal_file(journal_number_ - 1), ignored);
    for (std::error_code error; fs::exists(journal_file(journal_number_ + 1), error); ++journal_number_)
      take_again(journal_file(journal_number_), session);
    take_again(journal_file(journal_number_), session);
    journal_ = AppendedFile(journal_file(journal_number_));
  }

  void TwinFolder::note(const TwinSession &session, const EstimateRecord &record)
  {
    const std::string row = estimate_row(session, record);
    new_rows_.push_back(row);
    // What the journal leads to again stands there already, but for the last row perhaps.
    if (++n_rows_ > n_rows_in_file_)
    {
      table_.append_line(row);
      ++n_rows_in_file_;
    }
  }

  void TwinFolder::note(const PlayRecord &record)
  {
    steering_.append_line(decision_row(record));
  }

  void TwinFolder::save(const TwinSession &session)
  {
    Json memory = session.memory();
    if (memory.is_null())
      return;
    wait_until_saved();
    journal_   = AppendedFile(journal_file(++journal_number_));
    Json state = {{"format", state_format},
                  {"fingerprint", fingerprint_},
                  {"journal", journal_number_},
                  {"rows", n_rows_},
                  {"session", std::move(memory)}};
    saving_    = std::async(std::launch::async, [this, state = std::move(state), rows = std::move(new_rows_),
                                              old = journal_file(journal_number_ - 1)] {
      log_->append(rows);
      write_text_atomically(folder_ / twin_state_name, state.dump());
      std::error_code ignored; // it is in nobody's way
      fs::remove(old, ignored);
    });
    new_rows_.clear();
  }

  void TwinFolder::wait_until_saved()
  {
    if (saving_.valid())
      saving_.get();
  }

  void TwinFolder::write_summary(const TwinSession &session) const
  {
    const StreamCounts &counts = session.counts();
    Json                json   = Json::object();
    json["status"]             = session.twin().has_started() ? "completed" : "nothing was seen";
    json["counts"]             = {{"lines", counts.n_lines},
                                  {"frames", counts.n_frames},
                                  {"late", counts.n_late},
                                  {"errors", counts.n_errors},
                                  {"alarms", counts.n_alarms}};
    json["parameters"]         = Json::object();
    json["keeps_its_prior"]    = Json::array();
    if (session.twin().has_started())
    {
      json["time_s"] = session.twin().now_s();
      for (const NamedParameter &p : named_parameters(session.twin(), session.twin().belief()))
        json["parameters"][p.name] = {{"value", p.value}, {"sd", p.standard_deviation}};
      for (const UnlearnedDirection &d : session.twin().unlearned())
      {
        Json entries = Json::object();
        for (const auto &[name, weight] : d.direction)
          entries[name] = weight;
        json["keeps_its_prior"].push_back({{"direction", entries}, {"variance_left", d.variance_left}});
      }
    }
    if (session.pilot() != nullptr)
      json["goal"] = steering_json(*session.pilot());
    json["provenance"] = json_of(provenance_);
    write_json_file(folder_ / twin_summary_name, json);
  }

  void TwinFolder::finish(const TwinSession &session)
  {
    wait_until_saved();
    log_->append(new_rows_);
    write_summary(session);
    journal_ = {};
    std::error_code ignored;
    fs::remove(journal_file(journal_number_), ignored);
    fs::remove(folder_ / twin_state_name, ignored);
  }
} // namespace swimtwin
