#include <app/frame/tool.h>

namespace swimtwin
{
  std::vector<Verb> every_verb()
  {
    std::vector<Verb> verbs = {
        {"plan", add_plan}, {"simulate", add_simulate}, {"resistance", add_resistance}, {"train", add_train}};
    for (const Verb &verb : online_verbs())
      verbs.push_back(verb);
    verbs.push_back({"demo", add_demo});
    return verbs;
  }
} // namespace swimtwin
