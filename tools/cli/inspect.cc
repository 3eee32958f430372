// `retarget inspect FILE`: what is in a motion or character file, and whether a human is.
#include <fmt/format.h>

#include "io/clip_inspect.h"
#include "tools/cli/commands.h"
#include "tools/report/report.h"

namespace retarget {

int RunInspect(const ClipOptions& options, bool json) {
  std::vector<NamedFact> facts = InspectClip(options.path);
  try {
    const LoadedClip clip = RecogniseClip(options);
    facts.push_back(
        {"human", fmt::format("yes: profile {}, stature {:.2f} m, {} up", clip.facts.map.profile,
                              clip.facts.stature, clip.facts.up)});
  } catch (const InputError& refusal) {
    facts.push_back({"human", std::string("no: ") + refusal.what()});
  }
  if (json) {
    Json out = Json::object();
    for (const NamedFact& fact : facts) {
      if (fact.name == "note") {
        out["notes"].push_back(fact.value);
      } else {
        out[fact.name] = fact.value;
      }
    }
    fmt::print("{}\n", out.dump(1));
  } else {
    for (const NamedFact& fact : facts) fmt::print("{:<20}{}\n", fact.name, fact.value);
  }
  return kDone;
}

}  // namespace retarget
