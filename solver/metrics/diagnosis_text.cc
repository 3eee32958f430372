#include "solver/metrics/diagnosis_text.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <type_traits>

namespace retarget::solver {
namespace {

constexpr double kUnsettled = 0.5;    // share of a pull that nothing takes
constexpr double kAlsoOpposes = 0.2;  // share that is worth a word beside the largest
constexpr double kCounts = 0.05;      // share that is worth a word where none is large
constexpr double kFlatGli = 0.05;     // turns per rad or m
constexpr double kDeep = 0.01;        // m

double WeightIn(const Settings& settings, const std::string& term) {
  double weight = 0;
  VisitSettings(settings, [&](const std::string& key, const auto& value, auto&&...) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      if (key == "weights." + term) weight = value;
    }
  });
  return weight;
}
double UsualWeight(const std::string& term) { return WeightIn(Settings{}, term); }

std::string SetWeight(const std::string& term, double weight) {
  return Text("--set weights.%s=%g", term.c_str(), weight);
}

const HeldTangle& TagOf(const ConflictCase& c) {
  return c.subject.tangles[static_cast<size_t>(c.check.item)];
}

std::string What(const ConflictCase& c) {
  const RequirementCheck& r = c.check;
  const auto limb = [&](size_t k) { return LimbName(c.subject.body, r.limbs[k]); };
  if (r.term == "hold") {
    const Hold& hold = c.subject.holds[static_cast<size_t>(r.item)];
    const auto end = [&](const HoldPoint& p) {
      return p.figure == kWorld ? "its place in the world"
                                : LimbName(c.subject.body, {p.figure, p.node});
    };
    return Text("%s misses %s by %.1f cm at frame %d", end(hold.from).c_str(), end(hold.to).c_str(),
                100 * r.value, r.frame);
  }
  if (r.term == "tangle") {
    return Text("s GLI of %s to %s about %s to %s falls to %.3f at frame %d, over %.3g is required",
                limb(0).c_str(), limb(1).c_str(), limb(2).c_str(), limb(3).c_str(), r.value,
                r.frame, r.limit);
  }
  if (r.name == kDeepFrames) {
    return Text("%.1f %% of the frames, worst at frame %d (%s in %s)", r.value, r.frame,
                limb(0).c_str(), limb(1).c_str());
  }
  if (r.term == "penetration") {
    return Text("%s is %.1f cm inside %s at frame %d", limb(0).c_str(), 100 * r.value,
                limb(1).c_str(), r.frame);
  }
  if (r.term == "foot_lock") {
    return Text("%s has slipped by %.1f cm at frame %d", limb(0).c_str(), 100 * r.value, r.frame);
  }
  if (r.term == "ground") {
    return Text("%s is %.1f cm below the floor at frame %d", limb(0).c_str(), 100 * r.value,
                r.frame);
  }
  if (r.name == "pass-throughs" && r.limbs.size() == 2) {
    const int all = static_cast<int>(c.metrics.pass_throughs.size());
    return Text("%s goes through %s between frames %d and %d", limb(0).c_str(), limb(1).c_str(),
                r.frame, r.frame + 1) +
           (all > 1 ? Text(" (the first of %d)", all) : "");
  }
  return Text("%.4g %s, %.4g %s is allowed", r.value, r.unit.c_str(), r.limit, r.unit.c_str());
}

bool IsFeeble(const ConflictCase& c) {
  return WeightIn(c.problem.settings(), c.check.term) < 0.5 * UsualWeight(c.check.term);
}

// How much the weight of the requirement's own term would have to grow: against a steady force the
// residual falls with the square of the weight.
double MoreWeight(const ConflictCase& c) {
  double ratio = c.check.value / std::max(c.check.limit, 1e-6);
  if (c.check.term == "tangle") {
    ratio = (TagOf(c).target - c.check.value) / (TagOf(c).target - c.check.limit);
  }
  if (c.check.name == kDeepFrames) ratio = c.metrics.penetration_m / kDeep;
  const double more = WeightIn(c.problem.settings(), c.check.term) *
                      std::clamp(1.5 * std::sqrt(std::max(ratio, 0.0)), 2.0, 10.0);
  const double digit = std::pow(10.0, std::floor(std::log10(more)) - 1);
  return digit * std::ceil(more / digit);
}

std::string Advice(const ConflictCase& c) {
  const std::string& term = c.check.term;
  if (IsFeeble(c)) {
    return Text("weights.%s is %g, far below its default: ", term.c_str(),
                WeightIn(c.problem.settings(), term)) +
           SetWeight(term, UsualWeight(term));
  }
  for (const Opposition::Share& s : c.opposition.shares) {
    const double weight = WeightIn(c.problem.settings(), s.term);
    if (s.share < kCounts || weight <= 2 * UsualWeight(s.term)) continue;
    return Text("weights.%s is %g, far above its default: ", s.term.c_str(), weight) +
           SetWeight(s.term, UsualWeight(s.term));
  }
  return (c.opposition.opposed() ? "give one of them more weight, e.g. "
                                 : "give it more weight: ") +
         SetWeight(term, MoreWeight(c));
}

// A tag that cannot rise above the requirement, since it does not aim there.
std::string LowTarget(const ConflictCase& c) {
  const double target = TagOf(c).target, limit = c.check.limit;
  const double shown = std::abs(TagOf(c).tag.tangle.gli);
  if (target > limit) return "";
  if (shown > limit) {
    return Text("the tag aims for %.3g, no more: --set tangle.margin=%.2g", target,
                std::min(0.5, 1.1 * limit - kTangleThreshold));
  }
  return Text(
      "the template itself shows no more than %.3g: tangle it more tightly, or require "
      "less (requirements.gli)",
      shown);
}

// Why a requirement is missed that no weighing of terms against each other can serve.
std::string BeyondWeights(const ConflictCase& c) {
  const RequirementCheck& r = c.check;
  if (r.name == "pass-throughs") {
    return "no term sees that: from one of these frames to the other the limbs change sides, and "
           "no step of the solve may take them back through each other; lay the template at "
           "another instant (--template-at), or leave the frames out (--frames)";
  }
  if (r.term.empty()) return "no term works for that";
  if (r.term == "tangle" && !LowTarget(c).empty()) return LowTarget(c);
  if (WeightIn(c.problem.settings(), r.term) == 0) {
    return Text("weights.%s is 0, so nothing asks for it: ", r.term.c_str()) +
           SetWeight(r.term, UsualWeight(r.term));
  }
  if (c.opposition.pull == 0) {
    return Text(
        "the frames themselves show the solve nothing amiss, the miss lies between frames "
        "%d and %d: a higher --fps brings it to light",
        r.frame, r.frame + 1);
  }
  return "";
}

// The part of a term that opposes most: a hold, a tag, a planted foot.
std::string PartName(const ConflictCase& c) {
  const Opposition& o = c.opposition;
  if (o.item < 0) return "";
  const Scene& scene = c.problem.scene();
  if (o.shares[0].term == "foot_lock") return PlantedName(scene, ContactOfAnchor(scene, o.item));
  return Text("%s %d", o.shares[0].term.c_str(), o.item + 1);
}

// What opposes it. `c.opposition` is opposed.
std::string Pair(const ConflictCase& c) {
  const Opposition::Share& most = c.opposition.shares[0];
  const std::string part = PartName(c);
  std::string out = Text("there `%s` and `%s`", c.check.term.c_str(), most.term.c_str()) +
                    (part.empty() ? "" : " (" + part + ")") +
                    Text(" pull against each other (cosine %.2f)", most.cosine);
  if (most.term == c.check.term) {
    out = Text(
        "there it and %s pull against each other (cosine %.2f): no weight settles that, "
        "change one of them in the template",
        part.c_str(), most.cosine);
  } else if (c.opposition.shares.size() > 1 && c.opposition.shares[1].share > kAlsoOpposes) {
    out += Text(", and `%s` takes %.0f %% of the pull", c.opposition.shares[1].term.c_str(),
                100 * c.opposition.shares[1].share);
  }
  return out;
}

// No single term opposes.
std::string Alone(const ConflictCase& c) {
  std::string out = "no one term pulls against it there";
  std::string before = ": ";
  for (const Opposition::Share& s : c.opposition.shares) {
    if (s.share < kCounts) break;
    out += before + Text("`%s` takes %.0f %% of its pull", s.term.c_str(), 100 * s.share);
    before = ", ";
  }
  return out;
}

// A tag whose gradient has vanished: its paths are far apart.
std::string FlatTangle(const ConflictCase& c) {
  if (c.check.term != "tangle") return "";
  const double weight = WeightIn(c.problem.settings(), "tangle");
  const double missing = std::max(TagOf(c).target - c.check.value, 1e-6);
  const double slope = c.opposition.pull / (weight * weight * missing);
  if (slope >= kFlatGli) return "";
  return Text(
      "its target is %.2f, yet its GLI hardly changes with any move of these limbs "
      "(%.3f turns per rad or m): they have come apart, and only a start in which they are "
      "tangled helps (--template-at)",
      TagOf(c).target, slope);
}

std::string Why(const ConflictCase& c) {
  const Opposition& o = c.opposition;
  const std::string beyond = BeyondWeights(c);
  if (!beyond.empty()) return beyond;
  const std::string data = ContradictionInData(c);
  if (!data.empty()) return (o.opposed() ? Pair(c) + ". In the data " : "") + data;
  if (o.opposed() && o.shares[0].term == c.check.term) return Pair(c);
  const std::string flat = FlatTangle(c);
  if (!flat.empty()) return flat;
  const bool settled = std::abs(o.unopposed) < kUnsettled;
  if (IsFeeble(c)) {
    return (o.opposed() && settled ? Pair(c) : "its pull is lost among the others") + ": " +
           Advice(c);
  }
  if (!settled) {
    return (o.opposed() ? Pair(c) + ", and " : "") +
           "the pulls are not in balance there: the solve ended early (solve.max_iterations, "
           "solve.max_seconds), or only a way through a limb led on";
  }
  return (o.opposed() ? Pair(c) : Alone(c)) + ": " + Advice(c);
}

}  // namespace

std::string ConflictSentence(const ConflictCase& c) {
  return c.check.name + ": " + What(c) + "; " + Why(c);
}

std::string LimbName(const std::array<Body, 2>& body, const LimbNode& limb) {
  return std::string(limb.figure == 0 ? "a " : "b ") + body[limb.figure].nodes[limb.node].name;
}

std::string PlantedName(const Scene& scene, const AnchoredContact& planted) {
  return Text("%s, planted in frames %d to %d",
              LimbName(scene.body, {planted.figure, planted.contact.node}).c_str(),
              planted.contact.first, planted.contact.last);
}

std::string Text(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace retarget::solver
