#include <reports/page/html_page.h>

#include <reports/page/number_text.h>
#include <tests/datasets/temporary_folder.h>
#include <tests/reports/tag_balance.h>

#include <limits>

namespace swimtwin
{
  TEST(Html, EscapedTextHasNoMarkupLeft)
  {
    EXPECT_EQ(escaped(R"(<b a="1" c='2'>&amp;)"), "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;amp;");
    EXPECT_EQ(escaped("stiff ≥ soft"), "stiff ≥ soft");
    EXPECT_EQ(escaped(""), "");
  }

  // RFC 4648, section 10.
  TEST(Base64, HasTheVectorsOfItsStandard)
  {
    const std::pair<const char *, const char *> vectors[] = {{"", ""},
                                                             {"f", "Zg=="},
                                                             {"fo", "Zm8="},
                                                             {"foo", "Zm9v"},
                                                             {"foob", "Zm9vYg=="},
                                                             {"fooba", "Zm9vYmE="},
                                                             {"foobar", "Zm9vYmFy"}};
    for (const auto &[bytes, text] : vectors)
      EXPECT_EQ(base64(bytes), text);
  }

  TEST(Base64, KeepsZerosAndHighBytesAndBreaksNoLines)
  {
    EXPECT_EQ(base64(std::string_view("\0\xff\xfe", 3)), "AP/+");
    const std::string text = base64(std::string(3000, 'x'));
    EXPECT_EQ(text.size(), 4000u);
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }

  TEST(Html, LinksToFoldersOfAnyName)
  {
    EXPECT_EQ(link_target("../f=0.8 Hz/#1?%/report.html"), "../f%3D0.8%20Hz/%231%3F%25/report.html");
    EXPECT_EQ(link_target("a:b/é"), "a%3Ab/%C3%A9");
  }

  TEST(Html, PageOfHostileTextsIsWellFormedAndKeepsThem)
  {
    const TemporaryFolder folder;
    const std::string     hostile = "</title></pre><script>alert('1')</script>\"&";
    HtmlPage              page(hostile);
    page.add_verdict(Verdict::bad, hostile);
    page.add_warning(hostile);
    page.add_heading(hostile);
    page.add_paragraph(hostile);
    page.add_preformatted(hostile);
    page.add_table({{hostile, hostile}, {{{hostile}, {hostile, hostile}}}, true});
    page.add_table({{}, {}});
    page.add_picture(folder.write("a.png", "foobar"), hostile);
    const std::string text = page.text();
    EXPECT_EQ(first_unbalanced_tag(text), "");
    EXPECT_EQ(text.find("<script"), std::string::npos);
    expect_in(text, "<pre>" + escaped(hostile) + "</pre>");
    expect_in(text, "src=\"data:image/png;base64,Zm9vYmFy\"");
  }

  TEST(Html, PageAsksTheNetworkForNothing)
  {
    for (const char *part : {"http:", "https:", "@import", "url(", "<script", "<link"})
      EXPECT_EQ(HtmlPage("page").text().find(part), std::string::npos) << part;
  }

  TEST(NumberText, HasMinusSignsAndSaysWhatIsNotFinite)
  {
    EXPECT_EQ(plain_number(-1.5e-7, 3), "−1.5e−07");
    EXPECT_EQ(plain_number(-0., 3), "0");
    EXPECT_EQ(signed_number(0.25, 3), "+0.25");
    EXPECT_EQ(signed_number(-0., 3), "+0");
    EXPECT_EQ(plain_number(std::numeric_limits<double>::quiet_NaN(), 3), "not finite");
    EXPECT_EQ(signed_number(-std::numeric_limits<double>::infinity(), 3), "not finite");
  }
} // namespace swimtwin
