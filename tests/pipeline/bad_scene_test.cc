#include <tests/pipeline/simulation.h>
#include <tests/places.h>

#include <fmt/format.h>

namespace swimtwin
{
  namespace
  {
    /// The shipped scene of the case files with a piece of its text replaced.
    std::string edited_scene(const std::string &old_text, const std::string &new_text)
    {
      std::string text  = content(std::string(places::scenes) + "/reference-2d-casefile.toml");
      const auto  place = text.find(old_text);
      if (place == std::string::npos)
        ADD_FAILURE() << old_text << " is not in the scene";
      else
        text.replace(place, old_text.size(), new_text);
      return text;
    }

    std::string line_of(const std::string &text, const std::string &part)
    {
      return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(part)), '\n'));
    }

    /// Exit code 2, one sentence with these parts, and nothing written.
    void expect_refusal(const ShrunkScene &scene, const std::vector<std::string> &parts,
                        const std::string &verb = "simulate")
    {
      const TemporaryFolder    folder;
      std::vector<std::string> arguments{verb, "--output", folder.path / "run"};
      for (const auto &word : scene.arguments())
        arguments.push_back(word);
      expect_failure(run_tool(arguments), 2, parts);
      EXPECT_FALSE(std::filesystem::exists(folder.path / "run")) << verb;
    }

    /// The refusal of a scene file names file and line of `new_text`.
    void expect_refusal_of_edit(const std::string &old_text, const std::string &new_text,
                                std::vector<std::string> parts)
    {
      const TemporaryFolder folder;
      const std::string     text = edited_scene(old_text, new_text);
      const std::string     file = folder.write("edited.toml", text);
      parts.push_back(file + ":" + line_of(text, new_text));
      expect_refusal({file}, parts);
    }

    void expect_refusal_of_setting(const std::string &setting, std::vector<std::string> parts)
    {
      parts.push_back("--set " + setting);
      expect_refusal({"reference-2d-casefile", {setting}}, parts);
    }
  } // namespace

  TEST(BadScene, AMissingFileIsNamed)
  {
    for (const char *verb : {"simulate", "resistance", "plan"})
      expect_refusal({"no-such-folder/no-such-scene.toml"}, {"no-such-folder/no-such-scene.toml", "No such file"},
                     verb);
  }

  TEST(BadScene, AFolderIsNotAScene)
  {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path / "folder.toml");
    expect_refusal({folder.path / "folder.toml"}, {"folder.toml"});
  }

  TEST(BadScene, TextThatIsNotTomlIsNamedWithItsLine)
  {
    expect_refusal_of_edit("viscosity_Pa_s = 1.52", "viscosity_Pa_s = = 1.52", {"not valid TOML"});
  }

  TEST(BadScene, AnUnknownKeyIsNamedWithTheNearestOne)
  {
    expect_refusal_of_edit("viscosity_Pa_s", "viscosity_Pas", {"viscosity_Pas", "nearest", "viscosity_Pa_s"});
    expect_refusal_of_setting("tail.young_moduls_Pa=1e5", {"young_moduls_Pa", "nearest", "young_modulus_Pa"});
    expect_refusal_of_setting("tial.length_m=1e-3", {"tial", "nearest", "tail"});
  }

  TEST(BadScene, AnEntryOfTheWrongTypeIsNamedWithTheOneNeeded)
  {
    expect_refusal_of_edit("viscosity_Pa_s = 1.52", "viscosity_Pa_s = \"thick\"",
                           {"viscosity_Pa_s", "a number in Pa s"});
    expect_refusal_of_setting("time.steps_per_period=many", {"steps_per_period", "whole number"});
  }

  TEST(BadScene, SizesAreNotNegative)
  {
    expect_refusal_of_edit("length_m = 7.5e-3", "length_m = -7.5e-3", {"[tail] length_m", "positive", "(unit: m)"});
    expect_refusal_of_setting("numerics.mesh_size_m=-1e-4", {"mesh_size_m", "positive"});
  }

  TEST(BadScene, NumbersAreFinite)
  {
    expect_refusal_of_setting("fluid.viscosity_Pa_s=nan", {"viscosity_Pa_s", "positive"});
    expect_refusal_of_setting("field.by_T=inf", {"by_T", "finite"});
  }

  TEST(BadScene, TheSwimmerFitsIntoItsBox)
  {
    // Box and swimmer do not fit: no single entry of the table is to blame, but one was overridden.
    for (const auto &[length, problem] :
         {std::pair("10e-3", "beyond the right wall"), {"15.5e-3", "touches the right wall"}})
      expect_refusal({"reference-2d-casefile", {std::string("domain.size_m=[") + length + ", 20e-3]"}},
                     {"--set domain.size_m", "[domain]", problem, "enlarge the domain"});
  }

  TEST(BadScene, AFieldDoesNotSwingWithFrequencyZero)
  {
    expect_refusal_of_setting("field.frequency_Hz=0", {"[field] frequency_Hz", "positive", "Hz"});
  }

  TEST(BadScene, AnOverrideNeedsAKeyAndAValue)
  {
    for (const char *setting : {"time.periods", "=3"})
      expect_refusal({"reference-2d-casefile", {setting}},
                     {fmt::format("--set: {} is not KEY=VALUE; write for instance --set time.periods=2", setting)});
  }

  TEST(BadScene, TooFewStepsPerPeriodAreRefused)
  {
    expect_refusal_of_setting("time.steps_per_period=4", {"steps_per_period = 4", "at least"});
  }

  TEST(BadScene, FourDimensionsAreRefused)
  {
    expect_refusal_of_setting("dimension=4", {"dimension = 4", "use 2 or 3"});
  }

  TEST(BadScene, AResistanceMatrixNeedsAFluid)
  {
    const TemporaryFolder folder;
    expect_failure(
        run_tool({"resistance", std::string(places::scenes) + "/csm1.toml", "--output", folder.path / "run"}), 2,
        {"csm1", "[fluid]"});
    EXPECT_FALSE(std::filesystem::exists(folder.path / "run"));
  }
} // namespace swimtwin
