// Which terms of inertia a scene's run carries.
#pragma once

#include <datasets/scene.h>

namespace swimtwin
{
  /// The terms that [fluid] inertia asks for, less those of what the scene does not have or does not move. In vacuum it
  /// is [tail] inertia that asks.
  InertiaTerms inertia_terms(const Scene &scene);
} // namespace swimtwin
