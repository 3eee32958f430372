#include "tools/report/diagnosis_text.h"

#include <fmt/format.h>

#include <cmath>

#include "tools/report/requirement_text.h"

namespace retarget::report {
namespace {

using solver::Cause;
using Kind = solver::RequirementKind;

constexpr double kAlsoOpposes = 0.2;  // share that is worth a word beside the largest

class Sentence {
 public:
  Sentence(const solver::Diagnosis& diagnosis, const solver::MetricsContext& subject)
      : c_(diagnosis), check_(diagnosis.check), subject_(subject) {}

  std::string What() const {
    const solver::RequirementCheck& r = check_;
    switch (r.kind) {
      case Kind::kHold: {
        const Hold& hold = subject_.holds[static_cast<size_t>(r.item)];
        return fmt::format("{} misses {} by {:.1f} cm at frame {}", End(hold.from), End(hold.to),
                           100 * r.value, r.frame);
      }
      case Kind::kTangle:
        return fmt::format(
            "s GLI of {} to {} about {} to {} falls to {:.3f} at frame {}, over {:.3g} is required",
            Limb(0), Limb(1), Limb(2), Limb(3), r.value, r.frame, r.limit);
      case Kind::kPenetrationOver1cm:
        return fmt::format("{:.1f} % of the frames, worst at frame {} ({} in {})", r.value, r.frame,
                           Limb(0), Limb(1));
      case Kind::kPenetration:
        return fmt::format("{} is {:.1f} cm inside {} at frame {}", Limb(0), 100 * r.value, Limb(1),
                           r.frame);
      case Kind::kFootDrift:
        return fmt::format("{} has slipped by {:.1f} cm at frame {}", Limb(0), 100 * r.value,
                           r.frame);
      case Kind::kFootTravel:
        return fmt::format(
            "{} slides {:.1f} cm over the floor in the swing from frame {} on, {:.1f} is allowed",
            Limb(0), 100 * r.value, r.frame, 100 * r.limit);
      case Kind::kFootAcceleration:
        return fmt::format(
            "{} is thrown with {:.0f} m/s^2 where a contact begins or ends at frame {}, {:.0f} is "
            "allowed",
            Limb(0), r.value, r.frame, r.limit);
      case Kind::kFloor:
        return fmt::format("{} is {:.1f} cm below the floor at frame {}", Limb(0), 100 * r.value,
                           r.frame);
      case Kind::kPassThroughs:
        if (r.limbs.size() != 2) break;
        return fmt::format("{} goes through {} between frames {} and {}", Limb(0), Limb(1), r.frame,
                           r.frame + 1) +
               (c_.pass_throughs > 1 ? fmt::format(" (the first of {})", c_.pass_throughs) : "");
      case Kind::kPoseError:
        return fmt::format(
            "the pose is {:.0f} cm from its clip at frame {}, {} most, {:.0f} is "
            "allowed",
            100 * r.value, r.frame, Limb(0), 100 * r.limit);
      case Kind::kTrunkTilt:
        return fmt::format(
            "the trunk leans {:.0f} degrees from its clip at frame {}, {:.0f} is "
            "allowed of a figure that is not carried",
            r.value, r.frame, r.limit);
      case Kind::kFloating:
        return fmt::format(
            "the lowest point, of {}, is {:.1f} cm in the air at frame {}, {:.1f} "
            "is allowed of a figure that is not carried",
            Limb(0), 100 * r.value, r.frame, 100 * r.limit);
      case Kind::kJointLimit:
        return fmt::format(
            "the joint before {} bends {:.0f} degrees beyond its range at frame {}, "
            "{:.0f} is allowed",
            Limb(0), r.value, r.frame, r.limit);
      case Kind::kJerk:
        return fmt::format(
            "the jerk is {:.1f} times that of its clip, largest in {} at frame {}, "
            "{:.1f} is allowed",
            r.value, Limb(0), r.frame, r.limit);
      case Kind::kSegmentLength:
      case Kind::kWriteBack:
        break;
    }
    const char* unit = UnitOf(r.kind);
    return fmt::format("{:.4g} {}, {:.4g} {} is allowed", r.value, unit, r.limit, unit);
  }

  std::string Why() const {
    switch (c_.cause) {
      case Cause::kPassThrough:
        return "no term sees that: from one of these frames to the other the limbs change sides, "
               "and no step of the solve may take them back through each other; lay the template "
               "at another instant (--template-at), or leave the frames out (--frames)";
      case Cause::kNoTerm:
        return "no term works for that";
      case Cause::kUnlike:
        return "tangles, holds and contacts ask for it: the clip does not suit the template there; "
               "begin it at another instant (--start-a, --start-b), lay the template at another "
               "frame (--template-at), or take a clip that is closer to the template's figure";
      case Cause::kLowTarget:
        return fmt::format("the tag aims for {:.3g}, no more: --set {}={:.2g}", Tag().target,
                           c_.suggestion->setting, c_.suggestion->value);
      case Cause::kLooseTemplate:
        return fmt::format(
            "the template itself shows no more than {:.3g}: tangle it more tightly, or require "
            "less (requirements.gli)",
            std::abs(Tag().tag.tangle.gli));
      case Cause::kNoWeight:
        return fmt::format("{} is 0, so nothing asks for it: {}", c_.suggestion->setting, Set());
      case Cause::kBetweenFrames:
        return fmt::format(
            "the frames themselves show the solve nothing amiss, the miss lies between frames "
            "{} and {}: a higher --fps brings it to light",
            check_.frame, check_.frame + 1);
      case Cause::kFeetInOnePlace:
        return InTheData() +
               fmt::format(
                   "the clips plant both feet in one place ({}): begin one clip at another instant "
                   "(--start-a, --start-b), or take one foot out of the template's supports",
                   Feet());
      case Cause::kHoldOutOfReach:
        return InTheData() + OutOfReach();
      case Cause::kSameTerm:
        return Pair();
      case Cause::kFlatTangle:
        return fmt::format(
            "its target is {:.2f}, yet its GLI hardly changes with any move of these limbs "
            "({:.3f} turns per rad or m): they have come apart, and only a start in which they are "
            "tangled helps (--template-at)",
            Tag().target, c_.gli_slope);
      case Cause::kLowWeight:
        return (opposed() && c_.opposition.settled() ? Pair()
                                                     : "its pull is lost among the others") +
               ": " + Advice();
      case Cause::kNotSettled:
        return (opposed() ? Pair() + ", and " : "") +
               "the pulls are not in balance there: the solve ended early (solve.max_iterations, "
               "solve.max_seconds), or only a way through a limb led on";
      case Cause::kOpposed:
        return Pair() + ": " + Advice();
      case Cause::kUnopposed:
        return Alone() + ": " + Advice();
    }
    return "";
  }

 private:
  bool opposed() const { return c_.opposition.opposed(); }
  std::string Limb(size_t k) const {
    return k < check_.limbs.size() ? LimbName(check_.limbs[k], subject_.body) : "";
  }
  std::string End(const HoldPoint& p) const {
    return p.figure == kWorld ? "its place in the world"
                              : LimbName({p.figure, p.node}, subject_.body);
  }
  const solver::TangleTarget& Tag() const {
    return subject_.tangles[static_cast<size_t>(check_.item)];
  }
  std::string Planted(const solver::PlantedFoot& foot) const {
    return fmt::format("{}, planted in frames {} to {}",
                       LimbName({foot.figure, foot.contact.node}, subject_.body),
                       foot.contact.first, foot.contact.last);
  }

  std::string Set() const {
    return fmt::format("--set {}={:g}", c_.suggestion->setting, c_.suggestion->value);
  }
  std::string Advice() const {
    const solver::Suggestion& s = *c_.suggestion;
    if (s.is_default) {
      return fmt::format("{} is {:g}, far {} its default: {}", s.setting, s.now,
                         s.now < s.value ? "below" : "above", Set());
    }
    return (opposed() ? "give one of them more weight, e.g. " : "give it more weight: ") + Set();
  }

  // The part of a term that opposes most: a hold, a tag, a planted foot.
  std::string Part() const {
    const solver::Opposition& o = c_.opposition;
    if (c_.opposing_foot) return Planted(*c_.opposing_foot);
    return o.item < 0 ? "" : fmt::format("{} {}", o.shares[0].term, o.item + 1);
  }

  // What opposes it, where something does.
  std::string Pair() const {
    const solver::Opposition::Share& most = c_.opposition.shares[0];
    const std::string part = Part(), term = solver::TermOf(check_.kind);
    if (most.term == term) {
      return fmt::format(
          "there it and {} pull against each other (cosine {:.2f}): no weight settles that, "
          "change one of them in the template",
          part, most.cosine);
    }
    std::string out =
        fmt::format("there `{}` and `{}`{} pull against each other (cosine {:.2f})", term,
                    most.term, part.empty() ? "" : " (" + part + ")", most.cosine);
    if (c_.opposition.shares.size() > 1 && c_.opposition.shares[1].share > kAlsoOpposes) {
      out += fmt::format(", and `{}` takes {:.0f} % of the pull", c_.opposition.shares[1].term,
                         100 * c_.opposition.shares[1].share);
    }
    return out;
  }

  // No single term opposes.
  std::string Alone() const {
    std::string out = "no one term pulls against it there";
    std::string before = ": ";
    for (const solver::Opposition::Share& s : c_.opposition.shares) {
      if (s.share < solver::kCountingShare) break;
      out += before + fmt::format("`{}` takes {:.0f} % of its pull", s.term, 100 * s.share);
      before = ", ";
    }
    return out;
  }

  std::string InTheData() const { return opposed() ? Pair() + ". In the data " : ""; }
  std::string Feet() const {
    std::string out;
    for (const solver::PlantedFoot& foot : c_.feet) {
      out += (out.empty() ? "" : "; ") + Planted(foot);
    }
    return out;
  }
  std::string OutOfReach() const {
    const auto ground = [&](int k) {
      return c_.reach.ground[k] ? Planted(*c_.reach.ground[k]) : "its place in the world";
    };
    const bool world = !c_.reach.ground[0] || !c_.reach.ground[1];
    return fmt::format(
        "a contact and the hold contradict each other: {} is {:.2f} m from {}, the {} "
        "{:.2f} m at full stretch; no weight mends that while the feet stay, so move a "
        "clip, or change the hold or the supports in the template",
        ground(0), c_.reach.apart_m, ground(1),
        world ? "body between them" : "two bodies between them", c_.reach.reach_m);
  }

  const solver::Diagnosis& c_;
  const solver::RequirementCheck& check_;
  const solver::MetricsContext& subject_;
};

}  // namespace

const char* CauseName(Cause cause) {
  switch (cause) {
    case Cause::kPassThrough:
      return "pass_through";
    case Cause::kNoTerm:
      return "no_term";
    case Cause::kUnlike:
      return "unlike";
    case Cause::kLowTarget:
      return "low_target";
    case Cause::kLooseTemplate:
      return "loose_template";
    case Cause::kNoWeight:
      return "no_weight";
    case Cause::kBetweenFrames:
      return "between_frames";
    case Cause::kFeetInOnePlace:
      return "feet_in_one_place";
    case Cause::kHoldOutOfReach:
      return "hold_out_of_reach";
    case Cause::kSameTerm:
      return "same_term";
    case Cause::kFlatTangle:
      return "flat_tangle";
    case Cause::kLowWeight:
      return "low_weight";
    case Cause::kNotSettled:
      return "not_settled";
    case Cause::kOpposed:
      return "opposed";
    case Cause::kUnopposed:
      return "unopposed";
  }
  return "";
}

std::string DiagnosisSentence(const solver::Diagnosis& diagnosis,
                              const solver::MetricsContext& subject) {
  const Sentence sentence(diagnosis, subject);
  return NameOf(diagnosis.check) + ": " + sentence.What() + "; " + sentence.Why();
}

}  // namespace retarget::report
