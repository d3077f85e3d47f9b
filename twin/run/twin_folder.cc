#include <datasets/files/input_file.h>
#include <datasets/files/json_entries.h>
#include <datasets/files/output_folder.h>
#include <datasets/system/error.h>
#include <twin/run/twin_folder.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace swimtwin
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr int state_format = 1;

    [[noreturn]] void refuse_writing(const fs::path &file)
    {
      throw ComputationError(
          fmt::format("cannot write {}: {}.", file.string(), std::generic_category().message(errno)));
    }

    /// A line that a kill cut short goes. Returns the number of whole lines.
    long cut_to_whole_lines(const fs::path &file)
    {
      std::error_code error;
      if (const auto size = fs::file_size(file, error); error || size == 0) // no alarm yet, or just saved
        return 0;
      const std::string content = read_content(file, "the twin's file");
      const std::size_t end     = content.rfind('\n');
      fs::resize_file(file, end == std::string::npos ? 0 : end + 1, error);
      if (error)
        throw ComputationError(fmt::format("cannot shorten {}: {}.", file.string(), error.message()));
      return std::count(content.begin(), content.end(), '\n');
    }

    std::string cell(const double value)
    {
      return std::isfinite(value) ? fmt::format("{}", value) : "";
    }

    std::string header(const TwinSession &session)
    {
      std::string        text = "time_s,x_m,y_m,angle_rad,x_sd_m,y_sd_m,angle_sd_rad";
      const SwimmerTwin &twin = session.twin();
      for (int i = 1; i <= twin.swimmer().n_modes(); ++i)
        text += fmt::format(",shape_{}_m", i);
      const Belief nothing = Belief::independent(Eigen::VectorXd::Zero(twin.layout().n_states()),
                                                 Eigen::VectorXd::Ones(twin.layout().n_states()));
      for (const NamedParameter &p : named_parameters(twin, nothing))
        text += fmt::format(",{},sd_of_{}", p.name, p.name);
      return text + ",innovation_x_m,innovation_y_m,innovation_sd_m,innovation_angle_rad,innovation_angle_sd_rad,"
                    "significance,trust,flags,line";
    }

    /// Of the head's position and angle; empty where they were not seen. The larger of two deviations.
    void add_innovations(const EstimateRecord &r, std::vector<std::string> &cells)
    {
      std::array<double, 5> values{};
      values.fill(std::nan(""));
      for (const Innovation &i : r.innovations)
        if (i.kind == head_position)
        {
          values[0] = i.residual[0];
          values[1] = i.residual[1];
          values[2] = std::max(i.standard_deviation[0], i.standard_deviation[1]);
        }
        else if (i.kind == head_angle)
        {
          values[3] = i.residual[0];
          values[4] = i.standard_deviation[0];
        }
      for (const double value : values)
        cells.push_back(cell(value));
    }

    constexpr const char *steering_header = "time_s,phase,mean_x_m,mean_y_m,path_x_m,path_y_m,arc_m,distance_m,doubt_m,"
                                            "bx_T,by_T,took_s,decided_in_time";

    /// What is not known yet is an empty cell.
    std::string row(const PlayRecord &r)
    {
      const bool is_led             = r.phase == SteeringPhase::following || r.phase == SteeringPhase::arrived,
                 is_seen            = is_led || r.phase == SteeringPhase::warming;
      const double          none    = std::nan("");
      const auto            seen    = [&](const double value) { return cell(is_seen ? value : none); };
      const auto            led     = [&](const double value) { return cell(is_led ? value : none); };
      const Eigen::Vector2d first_T = r.samples.front().field_T;
      return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", cell(r.decided_s), to_string(r.phase),
                         seen(r.mean_m.x()), seen(r.mean_m.y()), led(r.path_m.x()), led(r.path_m.y()), led(r.arc_m),
                         led((r.mean_m - r.path_m).norm()), led(r.doubt_m), cell(first_T.x()), cell(first_T.y()),
                         cell(r.took_s), r.is_late ? 0 : 1);
    }

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

    std::string row(const TwinSession &session, const EstimateRecord &r)
    {
      const Belief            &b     = r.belief;
      std::vector<std::string> cells = {cell(r.time_s)};
      for (int i = 0; i < 3; ++i)
        cells.push_back(cell(b.mean[i]));
      for (int i = 0; i < 3; ++i)
        cells.push_back(cell(b.standard_deviation(i)));
      for (int i = 0; i < session.twin().swimmer().n_modes(); ++i)
        cells.push_back(cell(b.mean[3 + i]));
      for (const NamedParameter &p : named_parameters(session.twin(), b))
      {
        cells.push_back(cell(p.value));
        cells.push_back(cell(p.standard_deviation));
      }
      add_innovations(r, cells);
      return fmt::format("{},{},{},{},{}", fmt::join(cells, ","), cell(r.significance), cell(r.trust),
                         fmt::join(r.flags, ";"), r.line);
    }
  } // namespace

  AppendedFile::AppendedFile(const fs::path &file)
      : file_(file), descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644))
  {
    if (descriptor_ < 0)
      refuse_writing(file);
  }

  AppendedFile::~AppendedFile()
  {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }

  AppendedFile::AppendedFile(AppendedFile &&other) noexcept
      : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1))
  {
  }

  AppendedFile &AppendedFile::operator=(AppendedFile &&other) noexcept
  {
    std::swap(file_, other.file_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  void AppendedFile::append_line(std::string line)
  {
    line += '\n';
    const ssize_t n = ::write(descriptor_, line.data(), line.size());
    if (n == static_cast<ssize_t>(line.size()))
      return;
    if (n >= 0)
      errno = ENOSPC;
    refuse_writing(file_);
  }

  TwinFolder::TwinFolder(fs::path folder, std::string fingerprint)
      : folder_(std::move(folder)), fingerprint_(std::move(fingerprint))
  {
  }

  fs::path TwinFolder::journal_file(const long number) const
  {
    return folder_ / fmt::format("twin-journal-{}.jsonl", number);
  }

  void TwinFolder::begin(const TwinSession &session)
  {
    table_ = AppendedFile(folder_ / twin_table_name);
    table_.append_line(header(session));
    alarms_ = AppendedFile(folder_ / alarms_name);
    if (session.proposes_fields())
      proposals_ = AppendedFile(folder_ / proposals_name);
    if (session.pilot() != nullptr)
    {
      steering_ = AppendedFile(folder_ / steering_name);
      steering_.append_line(steering_header);
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
    cut_to_whole_lines(journal_file(journal_number_));
    std::ifstream journal(journal_file(journal_number_));
    for (std::string line; std::getline(journal, line);)
      session.take_again(line);
    journal_ = AppendedFile(journal_file(journal_number_));
  }

  void TwinFolder::note(const TwinSession &session, const EstimateRecord &record)
  {
    // What the journal leads to again stands there already, but for the last row perhaps.
    if (++n_rows_ > n_rows_in_file_)
    {
      table_.append_line(row(session, record));
      ++n_rows_in_file_;
    }
  }

  void TwinFolder::note(const PlayRecord &record)
  {
    steering_.append_line(row(record));
  }

  void TwinFolder::save(const TwinSession &session)
  {
    Json memory = session.memory();
    if (memory.is_null())
      return;
    AppendedFile next(journal_file(journal_number_ + 1));
    write_text_atomically(folder_ / twin_state_name, Json{{"format", state_format},
                                                          {"fingerprint", fingerprint_},
                                                          {"journal", journal_number_ + 1},
                                                          {"rows", n_rows_},
                                                          {"session", std::move(memory)}}
                                                         .dump());
    journal_ = std::move(next);
    std::error_code ignored; // it is in nobody's way
    fs::remove(journal_file(journal_number_), ignored);
    ++journal_number_;
  }

  void TwinFolder::write_summary(const TwinSession &session, const Provenance &provenance) const
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
    json["provenance"] = json_of(provenance);
    write_json_file(folder_ / twin_summary_name, json);
  }

  void TwinFolder::close()
  {
    journal_ = {};
    std::error_code ignored;
    fs::remove(journal_file(journal_number_), ignored);
    fs::remove(folder_ / twin_state_name, ignored);
  }
} // namespace swimtwin
