#include <app/trust/refinement.h>
#include <datasets/system/error.h>

#include <gtest/gtest.h>

#include <cmath>

namespace swimtwin
{
  TEST(Refinement, EndsWhereBothModelsAgree)
  {
    Refinement refinement({5, "0.5%"});
    EXPECT_TRUE(refinement.goes_on("model.h5", 0.02));
    EXPECT_EQ(refinement.n_done(), 0);
    EXPECT_FALSE(refinement.goes_on("refined-1/model.h5", 0.005));
    EXPECT_EQ(refinement.n_done(), 1);
    EXPECT_EQ(refinement.shortfall(), "");
    EXPECT_EQ(refinement.rounds().size(), 2u);
  }

  TEST(Refinement, EndsAfterItsRoundsAndSaysWhatIsLeft)
  {
    Refinement refinement({1, "0.005"});
    EXPECT_TRUE(refinement.goes_on("model.h5", 0.02));
    EXPECT_FALSE(refinement.goes_on("refined-1/model.h5", 0.013));
    EXPECT_EQ(refinement.last_round(), "  refined-1/model.h5: 1.3 % off the full-order model at its own result\n");
    EXPECT_EQ(refinement.shortfall(), "after 1 of 1 refinements the models differ by 1.3 % at the result, more than "
                                      "--refine-target 0.5 %; --refine from refined-1/model.h5 goes on");
  }

  TEST(Refinement, DoesNotTakeTheUnknownForAgreement)
  {
    Refinement refinement({1, "0.5%"});
    EXPECT_TRUE(refinement.goes_on("model.h5", std::nan("")));
    EXPECT_FALSE(refinement.goes_on("refined-1/model.h5", std::nan("")));
    EXPECT_NE(refinement.shortfall(), "");
  }

  TEST(Refinement, RefusesATargetThatIsNoShare)
  {
    EXPECT_THROW(Refinement({1, "soon"}), InputError);
    EXPECT_THROW(Refinement({1, "-1%"}), InputError);
  }
} // namespace swimtwin
