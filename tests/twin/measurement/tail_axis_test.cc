#include <twin/measurement/tail_axis.h>

#include <rom/swimmer/tail_tip.h>
#include <tests/twin/open_swimmer.h>

#include <gtest/gtest.h>

namespace swimtwin
{
  // The reduced swimmer's own tip is made from other nodes by other code.
  TEST(TailAxis, EndsAtTheTipOfTheSwimmer)
  {
    const ReducedModel model = open_model();
    const TailAxis     axis(model.tail);
    const TailTip      tip(model.tail);
    ShapeVector        q = ShapeVector::Zero(model.n_modes());
    for (int k = 0; k < model.n_modes(); ++k)
      q[k] = (k % 2 == 0 ? 0.5 : -0.3) * model.resistance.coordinate_scale_m[k];
    EXPECT_GT((tip.position_m(q) - tip.position_m(ShapeVector::Zero(model.n_modes()))).norm(), 1e-4);
    EXPECT_LT((axis.position_m(1., q) - tip.position_m(q)).norm(), 1e-12);
  }
} // namespace swimtwin
