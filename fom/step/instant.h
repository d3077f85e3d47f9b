// An accepted instant with what the next step needs.
#pragma once

#include <fom/body/swimmer.h>

namespace swimtwin
{
  template <int dim>
  struct Instant
  {
    double             time_s = 0.;
    Configuration<dim> configuration;
    Rates<dim>         rates;
  };
} // namespace swimtwin
