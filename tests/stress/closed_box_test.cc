#include <tests/stress/hard_swimmers.h>

namespace swimtwin
{
  namespace
  {
    /// All walls no-slip: the pressure's level keeps the tail's area.
    Motion swim_in_closed_box(const std::vector<std::string> &settings)
    {
      return expect_convergence(
          hard_swimmer({"domain.walls.left=no-slip", "domain.walls.right=no-slip"}).with(settings));
    }
  } // namespace

  TEST(ClosedBox, HoldsACompressibleTail)
  {
    swim_in_closed_box({"tail.poisson_ratio=0"});
  }

  TEST(ClosedBox, HoldsANearlyIncompressibleTail)
  {
    swim_in_closed_box({"tail.poisson_ratio=0.49"});
  }

  TEST(ClosedBox, HoldsALinearTail)
  {
    swim_in_closed_box({"numerics.tail_order=1"});
  }

  // The fluid's area is given, so the tail's must stay, however compressible its material: with and without an open
  // end the tail differs by its volume's change alone, which bending hardly makes.
  TEST(ClosedBox, HardlyChangesTheStroke)
  {
    const Motion closed = swim_in_closed_box({}), open = expect_convergence(hard_swimmer({}));
    EXPECT_LT(distance(closed.trajectory, open.trajectory), 0.01);
  }
} // namespace swimtwin
