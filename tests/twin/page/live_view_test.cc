#include <tests/twin/run/imagined_stream.h>
#include <twin/page/live_view.h>

#include <gtest/gtest.h>

#include <string>

namespace swimtwin
{
  namespace
  {
    TEST(LiveView, ShowsTheAxisFromTheHeadToTheTip)
    {
      const ReducedModel model = open_model();
      KeptSession        kept(model, twin_config(model, plain_twin));
      kept.take_all(lab_lines(model, short_lab));
      const TailAxis axis(model.tail);
      const auto     view     = nlohmann::json::parse(view_line(kept.session.twin(), axis, kept.estimates.back()));
      const auto     estimate = kept.of_type("estimate").back();
      EXPECT_EQ(view["x_m"], estimate["x_m"]);
      EXPECT_EQ(view["axis_m"][0][0], estimate["x_m"]);
      for (const int i : {0, 1})
        EXPECT_NEAR(view["axis_m"].back()[i].get<double>(), estimate["tip_m"][i].get<double>(), 1e-9);
    }

    TEST(LiveView, ThePageAsksTheNetworkForNothing)
    {
      const std::string page = live_page;
      for (const char *outside : {"src=", "href=", "@import", "fetch(", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
      // A namespace's name is no address.
      EXPECT_EQ(page.find("https://"), std::string::npos);
      EXPECT_EQ(page.find("http://"), page.find("http://www.w3.org/2000/svg"));
    }
  } // namespace
} // namespace swimtwin
