#include <datasets/system/provenance.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  // FIPS 180-4 example, and the empty text.
  TEST(Digest, IsThePublishedSha256)
  {
    EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  }

  TEST(UtcTimeNow, IsIso8601)
  {
    const std::string now = utc_time_now();
    ASSERT_EQ(now.size(), std::string("2025-01-31T12:00:00Z").size());
    EXPECT_EQ(now[4], '-');
    EXPECT_EQ(now[10], 'T');
    EXPECT_EQ(now.back(), 'Z');
  }
} // namespace swimtwin
