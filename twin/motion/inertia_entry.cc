#include <twin/motion/inertia_entry.h>

namespace swimtwin
{
  std::string read_inertia(TomlTable &top, const ReducedModel &model)
  {
    std::string choice = "auto";
    top.word("inertia", Need::optional, {"none", "auto", "full"}, choice);
    if (choice == "full" && !model.inertia.is_given())
      top.note("inertia", "asks for what the model was trained without; train it again with [fluid] inertia = \"auto\" "
                          "in its scene, or say \"none\".");
    return choice;
  }
} // namespace swimtwin
