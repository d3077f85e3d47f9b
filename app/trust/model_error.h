// What is known of a reduced model's error, told by every verb that uses it.
#pragma once

#include <datasets/reduced/reduced_model.h>

#include <string>

namespace swimtwin
{
  /// One sentence, if held-out runs missed the model's target or there are none; else empty.
  std::string model_error_warning(const ReducedModel &model, const std::string &name);

  /// Say it.
  void warn_of_model_error(const ReducedModel &model, const std::string &name);

  /// That warning; throws InputError if the error is above what a fit, a plan or a path may rest on, and
  /// `is_accepted` (--accept-model-error) does not say that it may.
  void require_borne_model_error(const ReducedModel &model, const std::string &name, bool is_accepted);

  constexpr const char *accept_model_error = "--accept-model-error";
  constexpr const char *accept_model_error_help =
      "Go on with a model whose held-out runs are off by more than 5 % (rms; 10 % at worst)";
} // namespace swimtwin
