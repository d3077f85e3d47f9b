#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <datasets/text/text_line.h>
#include <twin/page/live_server.h>
#include <twin/page/live_view.h>
#include <twin/run/twin_service.h>
#include <twin/stream/line_reader.h>
#include <twin/stream/local_server.h>
#include <twin/stream/recorded_lines.h>

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    constexpr double view_every_s           = 0.05;                     // of the wall clock
    constexpr int    look_at_clock_every_ms = 50, decide_within_ms = 4; ///< of their instants

    class Service
    {
    public:
      Service(const ReducedModel &model, const TwinConfig &config, const ServiceOptions &options)
          : config_(config), options_(options), folder_(options.folder, options.fingerprint, options.provenance),
            session_(model, config,
                     {[this](const std::string &line) { say_line(line); },
                      [this](const EstimateRecord &record) { note(record); },
                      [this](const PlayRecord &record) { folder_.note(record); }}),
            axis_(model.tail), look_at_clock_every_ms_(config.steering ? decide_within_ms : look_at_clock_every_ms)
      {
      }

      void run()
      {
        if (options_.port)
          server_.emplace(*options_.port);
        if (options_.page_port)
        {
          page_ = std::make_unique<LiveServer>(*options_.page_port, live_page);
          remark(fmt::format("the live page is at http://127.0.0.1:{}", page_->port()));
        }
        if (options_.on_begun)
          options_.on_begun();
        is_silent_ = true;
        if (options_.resumes)
          folder_.resume(session_);
        else
          folder_.begin(session_);
        is_silent_ = false;
        if (server_)
          serve_port();
        else if (!options_.recording)
        {
          session_.greet();
          converse(STDIN_FILENO);
        }
        else
          replay();
        session_.finish();
        folder_.finish(session_);
      }

    private:
      void note(const EstimateRecord &record)
      {
        folder_.note(session_, record);
        if (!page_ || wall_time_s() < next_view_s_)
          return;
        page_->publish(view_line(session_.twin(), axis_, record));
        next_view_s_ = wall_time_s() + view_every_s;
      }

      /// What those who look on are told as it was said.
      void show(const std::string &line)
      {
        const auto is = [&](const char *type) { return line.starts_with(fmt::format(R"({{"type":"{}",)", type)); };
        if (is("twin") || is("path") || is("end"))
          page_->publish_for_ever(line);
        else if (is("alarm"))
          page_->publish(line);
      }

      void say_line(const std::string &line)
      {
        if (page_)
          show(line);
        if (is_silent_)
          return;
        // What the coils were told is part of what a killed twin must know.
        if (line.starts_with(play_line_start))
          folder_.remember_line(line);
        if (line.starts_with(alarm_line_start))
          folder_.note_alarm(line);
        if (line.starts_with(proposal_line_start))
          folder_.note_proposal(line);
        if (line.starts_with(path_line_start)) // where it lies follows from no line of the journal
        {
          folder_.save(session_);
          folder_.wait_until_saved();
        }
        if (server_)
          server_->send(line + '\n');
        else
          say_text(line + '\n');
      }

      void take(const std::string &line, const std::string &where = {})
      {
        folder_.remember_line(line);
        session_.take(line, where);
        finish_line();
      }

      /// Remembered as itself, which is no line either: after a kill it counts again.
      void refuse(const std::string &sentence)
      {
        folder_.remember_line(text_line(sentence));
        session_.refuse_line(sentence);
        finish_line();
      }

      void finish_line()
      {
        last_line_s_ = wall_time_s();
        if (++n_since_save_ >= config_.save_every)
        {
          folder_.save(session_);
          n_since_save_ = 0;
        }
      }

      /// The stamps' clock goes on while nothing comes.
      void wait() { session_.wait(wall_time_s() - last_line_s_); }

      void converse(const int descriptor)
      {
        LineReader  reader(descriptor);
        std::string line;
        while (!session_.has_ended())
          switch (reader.next(line, look_at_clock_every_ms_))
          {
          case LineReader::Got::line:
            take(line);
            break;
          case LineReader::Got::too_long:
            refuse(LineReader::too_long_sentence());
            break;
          case LineReader::Got::nothing:
            wait();
            break;
          case LineReader::Got::end:
            return;
          }
      }

      void serve_port()
      {
        remark(fmt::format("listening on 127.0.0.1:{}; send {{\"type\": \"end\"}} to end.", server_->port()));
        while (!session_.has_ended())
          if (server_->accept_client(look_at_clock_every_ms_))
          {
            session_.greet();
            converse(server_->client());
            if (server_->n_lost() > 0)
              warn(fmt::format("the client did not take {} lines of the answer within {} s; read them, in a thread of "
                               "its own if need be.",
                               server_->n_lost(), LocalServer::patience.count() / 1000));
            if (!session_.has_ended())
              server_->drop_client();
          }
      }

      void replay()
      {
        const auto &[lines, warnings] = *options_.recording;
        const auto            n_done  = static_cast<std::size_t>(session_.counts().n_lines);
        const double          start_s = wall_time_s();
        std::optional<double> first_s;
        for (const std::string &warning : warnings)
          warn(warning);
        session_.greet();
        for (std::size_t i = n_done; i < lines.size() && !session_.has_ended(); ++i)
        {
          if (lines[i].fault.empty())
            take(lines[i].text, lines[i].where);
          else
            refuse(lines[i].fault);
          if (!options_.in_real_time || !session_.twin().has_started())
            continue;
          first_s              = first_s.value_or(session_.twin().now_s());
          const double ahead_s = (session_.twin().now_s() - *first_s) - (wall_time_s() - start_s);
          if (ahead_s > 0.)
            std::this_thread::sleep_for(std::chrono::duration<double>(ahead_s));
        }
      }

      const TwinConfig           &config_;
      const ServiceOptions       &options_;
      TwinFolder                  folder_;
      TwinSession                 session_;
      std::optional<LocalServer>  server_;
      TailAxis                    axis_;
      std::unique_ptr<LiveServer> page_; ///< null without one
      double                      next_view_s_  = 0.;
      bool                        is_silent_    = false;
      double                      last_line_s_  = wall_time_s(); ///< as if one had come now
      int                         n_since_save_ = 0;
      int                         look_at_clock_every_ms_; ///< while no line comes
    };
  } // namespace

  void serve(const ReducedModel &model, const TwinConfig &config, const ServiceOptions &options)
  {
    Service(model, config, options).run();
  }
} // namespace swimtwin
