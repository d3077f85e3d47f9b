#include <reports/plan/target_files.h>
#include <reports/plan/track_files.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  namespace
  {
    TrackResult track_to(const Eigen::Vector2d &end_m, const double way_m)
    {
      TrackResult track;
      track.status = TrackStatus::arrived;
      track.instants.resize(2);
      track.instants.front().arc_m = 1e-3; // a closed loop's path begins before it is counted
      track.instants.back().arc_m  = 1e-3 + way_m;
      track.instants.back().mean_m = end_m;
      return track;
    }

    TrackRecord replayed(const TrackResult &planned, const TrackResult &replay)
    {
      TrackRecord record;
      record.result = planned;
      record.replay = replay;
      return record;
    }
  } // namespace

  TEST(DifferenceOfReplay, IsRelativeToTheWayAlongThePath)
  {
    const TrackResult planned = track_to({3e-3, 4e-3}, 20e-3), replay = track_to({0., 0.}, 20e-3);
    EXPECT_NEAR(replayed(planned, replay).difference_of_replay().value(), 0.25, 1e-14);
    EXPECT_EQ(replayed(planned, planned).difference_of_replay(), 0.);
  }

  TEST(DifferenceOfReplay, IsNoneWhereATrackFailedOrWentNowhere)
  {
    const TrackResult planned = track_to({3e-3, 4e-3}, 20e-3);
    TrackResult       failed  = planned;
    failed.status             = TrackStatus::failed;
    EXPECT_FALSE(replayed(planned, failed).difference_of_replay());
    EXPECT_FALSE(replayed(failed, planned).difference_of_replay());
    EXPECT_FALSE(replayed(planned, {}).difference_of_replay());
    EXPECT_FALSE(replayed(track_to({3e-3, 4e-3}, 0.), planned).difference_of_replay());
    TrackRecord without;
    without.result = planned;
    EXPECT_FALSE(without.difference_of_replay());
  }

  TEST(DifferenceOfReplay, IsRelativeToTheWayToTheTarget)
  {
    TargetRecord record;
    record.swim.resize(3);
    record.swim.front().pose.position_m = {1e-3, 1e-3};
    record.swim.back().pose.position_m  = {11e-3, 1e-3};
    EXPECT_FALSE(record.difference_of_replay());
    record.replay                            = record.swim;
    record.replay->back().pose.position_m[1] = 2e-3;
    EXPECT_NEAR(record.difference_of_replay().value(), 0.1, 1e-14);
  }
} // namespace swimtwin
