#include <datasets/system/clocks.h>
#include <datasets/system/console.h>
#include <datasets/system/error.h>
#include <twin/run/twin_service.h>
#include <twin/stream/line_reader.h>
#include <twin/stream/local_server.h>
#include <twin/stream/recorded_lines.h>

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <unistd.h>

namespace swimtwin
{
  namespace
  {
    constexpr int look_at_clock_every_ms = 50;

    class Service
    {
    public:
      Service(const ReducedModel &model, const TwinConfig &config, const ServiceOptions &options)
          : config_(config), options_(options),
            folder_(options.folder, digest(config.text + model.scene_text + std::to_string(model.n_modes()))),
            session_(model, config,
                     {[this](const std::string &line) { say_line(line); },
                      [this](const EstimateRecord &record) { folder_.note(session_, record); }})
      {
      }

      void run()
      {
        if (options_.port)
          server_.emplace(*options_.port);
        is_silent_ = true;
        if (options_.resumes)
          folder_.resume(session_);
        else
          folder_.begin(session_);
        is_silent_ = false;
        if (server_)
          serve_port();
        else if (options_.recording.empty())
        {
          session_.greet();
          converse(STDIN_FILENO);
        }
        else
          replay();
        session_.finish();
        folder_.write_summary(session_, options_.provenance);
        folder_.close();
      }

    private:
      void say_line(const std::string &line)
      {
        if (is_silent_)
          return;
        if (server_)
          server_->send(line + '\n');
        else
          say_text(line + '\n');
      }

      void take(const std::string &line)
      {
        folder_.remember_line(line);
        session_.take(line);
        last_line_s_ = wall_time_s();
        if (++n_since_save_ >= config_.save_every)
        {
          folder_.save(session_);
          n_since_save_ = 0;
        }
      }

      /// The stamps' clock goes on while nothing comes.
      void wait()
      {
        if (session_.twin().has_started())
          session_.wait(session_.twin().now_s() + (wall_time_s() - last_line_s_));
      }

      void converse(const int descriptor)
      {
        LineReader  reader(descriptor);
        std::string line;
        while (!session_.has_ended())
          switch (reader.next(line, look_at_clock_every_ms))
          {
          case LineReader::Got::line:
            take(line);
            break;
          case LineReader::Got::too_long:
            folder_.remember_line(""); // it counts as a line
            session_.refuse_long_line(LineReader::most_bytes);
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
          if (server_->accept_client(look_at_clock_every_ms))
          {
            session_.greet();
            converse(server_->client());
            if (!session_.has_ended())
              server_->drop_client();
          }
      }

      void replay()
      {
        const auto            lines   = recorded_lines(options_.recording);
        const auto            n_done  = static_cast<std::size_t>(session_.counts().n_lines);
        const double          start_s = wall_time_s();
        std::optional<double> first_s;
        session_.greet();
        for (std::size_t i = n_done; i < lines.size() && !session_.has_ended(); ++i)
        {
          take(lines[i]);
          if (!options_.in_real_time || !session_.twin().has_started())
            continue;
          first_s              = first_s.value_or(session_.twin().now_s());
          const double ahead_s = (session_.twin().now_s() - *first_s) - (wall_time_s() - start_s);
          if (ahead_s > 0.)
            std::this_thread::sleep_for(std::chrono::duration<double>(ahead_s));
        }
      }

      const TwinConfig          &config_;
      const ServiceOptions      &options_;
      TwinFolder                 folder_;
      TwinSession                session_;
      std::optional<LocalServer> server_;
      bool                       is_silent_    = false;
      double                     last_line_s_  = wall_time_s(); ///< as if one had come now
      int                        n_since_save_ = 0;
    };
  } // namespace

  void serve(const ReducedModel &model, const TwinConfig &config, const ServiceOptions &options)
  {
    Service(model, config, options).run();
  }
} // namespace swimtwin
