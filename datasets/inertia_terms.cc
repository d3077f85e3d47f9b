#include <datasets/inertia_terms.h>

namespace swimtwin
{
  namespace
  {
    constexpr InertiaTerms all_terms{.unsteady = true, .convective = true, .tail = true, .head = true};

    InertiaTerms asked_for(const Scene &scene)
    {
      if (!scene.fluid)
        return {.tail = scene.tail && scene.tail->has_inertia_in_vacuum};
      switch (scene.fluid->inertia)
      {
      case Inertia::full:
        return all_terms;
      case Inertia::chosen:
        return scene.fluid->chosen;
      case Inertia::automatic:
      case Inertia::none:
        return {};
      }
      return {};
    }
  } // namespace

  InertiaTerms inertia_terms(const Scene &scene)
  {
    InertiaTerms terms = asked_for(scene);
    terms.tail         = terms.tail && scene.tail && !scene.time.is_steady;
    terms.head         = terms.head && !scene.head.fixed && !scene.time.is_steady;
    return terms;
  }
} // namespace swimtwin
