// `retarget inspect FILE`: what is in a motion or character file, and whether a human is.
#include <fmt/format.h>

#include "io/clip_inspect.h"
#include "tools/cli/commands.h"
#include "tools/report/report.h"

namespace retarget::cli {

int RunInspect(const io::ClipOptions& options, bool json) {
  std::vector<io::NamedFact> facts = io::InspectClip(options.path);
  try {
    const io::LoadedClip clip = io::RecogniseClip(options);
    facts.push_back(
        {"human", fmt::format("yes: profile {}, stature {:.2f} m, {} up", clip.facts.map.profile,
                              clip.facts.stature, clip.facts.up)});
  } catch (const InputError& refusal) {
    facts.push_back({"human", std::string("no: ") + refusal.what()});
  }
  if (json) {
    report::Json out = report::Json::object();
    for (const io::NamedFact& fact : facts) {
      if (fact.name == "note") {
        out["notes"].push_back(fact.value);
      } else {
        out[fact.name] = fact.value;
      }
    }
    fmt::print("{}\n", out.dump(1));
  } else {
    for (const io::NamedFact& fact : facts) fmt::print("{:<20}{}\n", fact.name, fact.value);
  }
  return kDone;
}

}  // namespace retarget::cli
