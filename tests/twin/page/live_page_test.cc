#include <tests/twin/run/imagined_stream.h>
#include <twin/page/live_server.h>
#include <twin/page/live_view.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <sstream>

namespace swimtwin
{
  namespace
  {
    std::string text_of(const std::filesystem::path &file)
    {
      std::ostringstream text;
      text << std::ifstream(file).rdbuf();
      return text.str();
    }

    bool is_there(const char *program)
    {
      return std::system(fmt::format("command -v {} > /dev/null 2>&1", program).c_str()) == 0;
    }

    /// The page as it stands when the stream has ended, and what the browser says of it on its console.
    struct SeenPage
    {
      int         status = -1;
      std::string elements, console;
    };

    SeenPage look_at(const LiveServer &server)
    {
      const TemporaryFolder folder;
      const std::string     place = folder.path.string();
      SeenPage              page;
      page.status =
          std::system(fmt::format("cd {0}; HOME={0} timeout 60 chromium --headless --no-sandbox --disable-gpu "
                                  "--disable-dev-shm-usage --enable-logging=stderr --user-data-dir={0}/profile "
                                  "--virtual-time-budget=1000 --dump-dom http://127.0.0.1:{1}/ "
                                  "> elements 2> console",
                                  place, server.port())
                          .c_str());
      page.elements = text_of(folder.path / "elements");
      page.console  = text_of(folder.path / "console");
      return page;
    }

    TEST(LivePage, ShowsASwimToItsEndInABrowser)
    {
      if (!is_there("chromium"))
        GTEST_SKIP() << "there is no chromium; install Debian's package of that name to have the page looked at";
      const ReducedModel model = open_model();
      KeptSession        kept(model, twin_config(model, plain_twin));
      kept.session.greet();
      kept.take_all(lab_lines(model, short_lab));
      kept.session.finish();
      const TailAxis axis(model.tail);
      LiveServer     server(0, live_page);
      // Who comes later is told all of these.
      server.publish_for_ever(kept.of_type("twin").front().dump());
      server.publish_for_ever(R"({"type":"path","time_s":0,"points_m":[[0,0],[1e-3,2e-3],[3e-3,2e-3]]})");
      server.publish_for_ever(R"({"type":"alarm","name":"sight-<b>lost</b>","since_s":1.5,"time_s":2,"over":false,)"
                              R"("what":"no frame","remedy":"look"})");
      server.publish_for_ever(view_line(kept.session.twin(), axis, kept.estimates.back()));
      server.publish_for_ever(kept.of_type("end").front().dump());

      const SeenPage page = look_at(server);
      ASSERT_EQ(page.status, 0) << page.console;
      EXPECT_EQ(page.console.find("CONSOLE"), std::string::npos) << page.console; // no error, nothing refused
      const double         time_s = kept.estimates.back().time_s;
      const nlohmann::json last   = kept.of_type("estimate").back();
      for (const std::string &wanted :
           {std::string("swimtwin: open-2d</h1>"), fmt::format("t = {:.2f} s, trust ", time_s), std::string(", ended"),
            fmt::format("position ({:.2f}, {:.2f}) mm", 1e3 * last["x_m"].get<double>(),
                        1e3 * last["y_m"].get<double>()),
            std::string("E/\u03bc (1/ms): "), std::string("<figure id=\"p-bx\">"),
            std::string("sight-&lt;b&gt;lost&lt;/b&gt;")})
        EXPECT_NE(page.elements.find(wanted), std::string::npos) << wanted << "\n" << page.elements;
      // Path, trail, axis and head; a line in each panel.
      const std::string map = page.elements.substr(page.elements.find("id=\"map\""));
      EXPECT_EQ(map.find("NaN"), std::string::npos);
      const std::regex drawn("<polyline");
      EXPECT_GE(std::distance(std::sregex_iterator(map.begin(), map.end(), drawn), std::sregex_iterator()),
                4 + 2 + static_cast<long>(last["parameters"].size()));
    }
  } // namespace
} // namespace swimtwin
