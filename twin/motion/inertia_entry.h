// The entry of a twin's and of a laboratory's file that says which inertia their swimmer carries.
#pragma once

#include <datasets/reduced/reduced_model.h>
#include <datasets/text/toml_table.h>

#include <string>

namespace swimtwin
{
  /// `inertia`: "none", "auto" (left out) or "full", which is a problem of the table where the model has none.
  std::string read_inertia(TomlTable &top, const ReducedModel &model);
} // namespace swimtwin
