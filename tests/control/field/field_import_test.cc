#include <control/field/field_import.h>
#include <control/goal/measured_field.h>
#include <datasets/scene/field_program_writer.h>
#include <tests/datasets/temporary_folder.h>

namespace swimtwin
{
  namespace
  {
    FieldProgram program(const double size, const double period_s)
    {
      const auto field = std::make_shared<FourierField>(1);
      return sampled_program({field, sinusoid_coefficients(*field, size, size), 1. / period_s}, 64. / period_s);
    }
  } // namespace

  TEST(FieldImport, HasNoDoubtsAboutCoilsFields)
  {
    EXPECT_TRUE(unit_doubts(program(5e-3, 1.25)).empty());
  }

  TEST(FieldImport, DoubtsMillitesla)
  {
    const auto doubts = unit_doubts(program(5., 1.25));
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_NE(doubts[0].find("reaches 7.07 T, more than coils for swimmers give; if its columns are in mT"),
              std::string::npos);
    EXPECT_NE(unit_doubts(program(1e-6, 1.25)).at(0).find("less than the Earth's field"), std::string::npos);
    EXPECT_NE(unit_doubts(program(5e-3, 1.25e4)).at(0).find("repeats after 1.25e+04 s"), std::string::npos);
  }

  TEST(FieldImport, ReadsWhatWasWritten)
  {
    const TemporaryFolder folder;
    const FieldProgram    written = program(5e-3, 1.25);
    write_field_program(folder.path / "field.csv", written, "from a test\nof two lines");
    const FieldProgram read = FieldProgram::read_csv(folder.path / "field.csv", 1.25);
    EXPECT_EQ(read.time_s(), written.time_s());
    EXPECT_EQ(read.b_T(), written.b_T());
    const ImportedField imported = import_field(read, 2);
    const FourierField  field(2);
    EXPECT_LT((imported.drive.parameters - sinusoid_coefficients(field, 5e-3, 5e-3)).norm(), 2e-5); // of the pieces
    EXPECT_LT(imported.loss_T, 2e-5);
  }
} // namespace swimtwin
