// What is thrown where a mesh is made on one rank: on all of them the same, since handlers go different ways.
#include <fom/meshing/gmsh_session.h>

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace swimtwin
{
  namespace
  {
    template <typename Thrown>
    void refuse_after(const Thrown &thrown)
    {
      mesh_on_first_rank<3>([&]() -> SimplexSoup<3> { throw thrown; }, MPI_COMM_WORLD);
    }
  } // namespace

  TEST(MeshOnFirstRank, IsRefusedAlikeOnAllRanks)
  {
    EXPECT_THROW(refuse_after(std::bad_alloc()), OutOfMemory);
    EXPECT_THROW(refuse_after(std::string("PLC Error:  A segment and a facet intersect")), CrossedSurfaces);
    try
    {
      refuse_after(std::runtime_error("some other reason"));
      FAIL() << "nothing was thrown";
    }
    catch (const ComputationError &error)
    {
      EXPECT_EQ(dynamic_cast<const OutOfMemory *>(&error), nullptr);
      EXPECT_NE(std::string(error.what()).find("some other reason"), std::string::npos) << error.what();
    }
  }
} // namespace swimtwin
