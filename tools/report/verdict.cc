#include "tools/report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tools/report/html.h"
#include "tools/report/json_reading.h"
#include "tools/report/requirement_json.h"

namespace retarget::report {
namespace {

namespace fs = std::filesystem;

std::string Count(int64_t n, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

// -1 where there is no number.
int FrameAt(const Json& json, const std::string& pointer) {
  const Json& frame = At(json, pointer);
  return frame.is_number_integer() ? frame.get<int>() : -1;
}

std::string FileName(const Json& report, const std::string& pointer) {
  return fs::path(TextAt(report, pointer)).filename().string();
}

// The template's own name, else its file's; a file called template.yaml goes by its folder.
std::string HoldName(const Json& report) {
  const std::string name = TextAt(report, "/inputs/template/name");
  if (!name.empty()) return name;
  const fs::path path = TextAt(report, "/inputs/template/file");
  const bool plain = path.stem() == "template" && path.has_parent_path();
  return Humanize(plain ? path.parent_path().filename().string() : path.stem().string());
}

std::vector<Sentence> Asked(const Json& report) {
  const int frames = report.value("frames", 0);
  const double seconds = frames / std::max(1e-9, report.value("fps", 30.0));
  const std::string a = FileName(report, "/inputs/clip_a/file");
  const std::string b = FileName(report, "/inputs/clip_b/file");
  const size_t tangles = At(report, "/tangles").size(), holds = At(report, "/holds").size();
  std::string kept = Count(static_cast<int64_t>(tangles), "tangle", "tangles");
  if (holds > 0) kept += " and " + Count(static_cast<int64_t>(holds), "held point", "held points");
  std::vector<Sentence> asked = {
      {fmt::format("a ({}) and b ({}), each captured alone, joined in the hold \"{}\" for {} "
                   "({:.1f} s): {} must "
                   "stay, the bodies must not overlap, planted feet must stand still.",
                   a, b, HoldName(report), Count(frames, "frame", "frames"), seconds, kept),
       -1}};
  for (size_t k = 0; k < tangles; ++k) {
    const auto node = [&](const char* figure, int end) {
      return Humanize(TextAt(report, fmt::format("/tangles/{}/{}/{}", k, figure, end)));
    };
    asked.push_back({fmt::format("Tag {}: a from {} to {}, tangled with b from {} to {}.", k + 1,
                                 node("a", 0), node("a", 1), node("b", 0), node("b", 1))});
  }
  return asked;
}

// Frames in which some tag is lost, of a motion; -1 where it was not measured.
int64_t FramesLost(const Json& report, const std::string& motion) {
  const double kept = NumberAt(report, "/metrics/" + motion + "/tangle_kept_percent");
  if (std::isnan(kept)) return -1;
  return std::llround(report.value("frames", 0) * (1 - kept / 100));
}

bool HasTags(const Json& report) { return !At(report, "/tangles").empty(); }

// Some tag falls to its limit, in a frame or between two.
bool TagMissed(const Json& report) {
  const std::vector<ReadRequirement> requirements = RequirementsOf(report);
  return std::any_of(requirements.begin(), requirements.end(), [](const ReadRequirement& r) {
    return r.Is(solver::RequirementKind::kTangle) && !r.met;
  });
}

std::string Outcome(const Json& report, size_t missed, size_t all) {
  const int frames = report.value("frames", 0);
  const int64_t lost = HasTags(report) ? FramesLost(report, "result") : 0;
  const bool loose = TagMissed(report);
  const std::string hold =
      !HasTags(report) ? ""
      : lost > 0       ? fmt::format("The tangles are lost in {} of {} frames", lost, frames)
      : loose          ? "The tangles come loose between frames"
                       : fmt::format("The tangles are kept in all {} frames", frames);
  if (TextAt(report, "/solve/status") == "interrupted") {
    return fmt::format("The solve was interrupted: {} of {} requirements {} missed so far.", missed,
                       all, missed == 1 ? "is" : "are");
  }
  if (missed == 0)
    return hold.empty() ? "Every requirement is met." : hold + " and every requirement is met.";
  const std::string rest =
      fmt::format("{} of {} requirements {} missed.", missed, all, missed == 1 ? "is" : "are");
  if (hold.empty()) return rest;
  return fmt::format("{}{} {}", hold, lost > 0 || loose ? ";" : ", but", rest);
}

// What is missed, and by how much.
std::string MissedBy(const ReadRequirement& r) {
  using Kind = solver::RequirementKind;
  const double scale = r.unit == "m" ? 100 : 1;
  const double value = scale * r.value, limit = scale * r.limit;
  const std::string shown = r.unit == "m" ? "cm" : r.unit;
  const std::string allowed = fmt::format("{:.1f} {}, {:.1f} allowed", value, shown, limit);
  const std::string who = r.figure < 0 ? "" : kFigure[r.figure];
  if (!r.kind) return fmt::format("{}: {:.4g} {}, {:.4g} allowed", r.name, value, shown, limit);
  switch (*r.kind) {
    case Kind::kTangle:
      return fmt::format("Tag {} comes loose: s GLI falls to {:.2f} and must stay above {:.2f}",
                         r.item + 1, value, limit);
    case Kind::kPassThroughs:
      return value == 1 ? "A limb passes through a limb once"
                        : fmt::format("A limb passes through a limb {:.0f} times", value);
    case Kind::kPenetrationOver1cm:
      return "The bodies overlap by more than 1 cm in " + allowed;
    case Kind::kPenetration:
      return "The bodies overlap by " + allowed;
    case Kind::kFootDrift:
      return fmt::format("A planted foot of {} drifts by {}", who, allowed);
    case Kind::kFootTravel:
      return fmt::format("A free foot of {} slides over the floor by {}", who, allowed);
    case Kind::kFootAcceleration:
      return fmt::format("A foot of {} lands or lifts off with {:.1f} m/s², {:.1f} allowed", who,
                         value, limit);
    case Kind::kFloor:
      return fmt::format("{} goes below the floor by {}", who, allowed);
    case Kind::kHold:
      return fmt::format("Hold {} opens by {}", r.item + 1, allowed);
    case Kind::kSegmentLength:
      return fmt::format("A segment of {} changes its length by {:.2f} %, {:.2f} allowed", who,
                         value, limit);
    case Kind::kWriteBack:
      return fmt::format(
          "The written rig of {} departs from the scene by {:.2f} {}, {:.2f} allowed", who, value,
          shown, limit);
    case Kind::kPoseError:
      return fmt::format("{} is bent out of its clip by {}", who, allowed);
    case Kind::kTrunkTilt:
      return fmt::format(
          "The trunk of {}, which is not carried, tilts from its clip by {:.0f} "
          "degrees, {:.0f} allowed",
          who, value, limit);
    case Kind::kFloating:
      return fmt::format("{}, which is not carried, floats by {}", who, allowed);
    case Kind::kJointLimit:
      return fmt::format("A joint of {} bends {:.0f} degrees beyond its range, {:.0f} allowed", who,
                         value, limit);
    case Kind::kJerk:
      return fmt::format("{} jerks {:.1f} times as much as its clip, {:.1f} allowed", who, value,
                         limit);
  }
  return "";
}

// One line for a requirement that is missed.
Sentence Missed(const ReadRequirement& r) {
  std::string where = Humanize(r.where);
  if (r.Is(solver::RequirementKind::kTangle) && r.frame >= 0) {
    where = fmt::format("frame {}", r.frame);  // the tag is named
  }
  return {MissedBy(r) + (where.empty() ? "" : " (" + where + ")") + ".", r.frame};
}

std::string Blemishes(const Json& report, const std::string& motion) {
  const std::string at = "/metrics/" + motion;
  const double depth = std::max(NumberAt(report, at + "/penetration_m"),
                                NumberAt(report, at + "/penetration_between_frames_m"));
  const double passes = NumberAt(report, at + "/pass_throughs");
  std::string out = std::isnan(depth) ? "" : fmt::format("{:.1f} cm of overlap", 100 * depth);
  if (passes > 0) out += " and " + Count(std::llround(passes), "pass-through", "pass-throughs");
  return out;
}

std::vector<Sentence> Compared(const Json& report) {
  std::vector<Sentence> out;
  const int frames = report.value("frames", 0);
  const auto of_all = [&](int64_t n) { return fmt::format("{} of {} frames", n, frames); };
  if (!At(report, "/metrics/source").is_null()) {
    const int64_t lost = FramesLost(report, "source");
    out.push_back({fmt::format(
        "Laid together without editing, the clips {}{}.",
        HasTags(report) ? "are tangled in " + of_all(frames - lost) + ", with " : "have ",
        Blemishes(report, "source"))});
  }
  const std::string message = TextAt(report, "/simulation/message");
  if (At(report, "/metrics/baseline").is_null()) {
    out.push_back(message.empty() ? Sentence{"There is no simulated run to compare with."}
                                  : Sentence{message, FrameAt(report, "/simulation/frame")});
    return out;
  }
  const int64_t lost = FramesLost(report, "baseline"), ours = FramesLost(report, "result");
  std::string line = "The simulation shows " + Blemishes(report, "baseline");
  if (HasTags(report)) {
    line = lost > 0 ? fmt::format("The simulation lost the tangles in {}", of_all(lost))
                    : "The simulation keeps the tangles in every frame";
    line += ", with " + Blemishes(report, "baseline");
    if (lost > 0)
      line += ours > 0 ? fmt::format("; the solve loses it in {}", ours)
                       : "; the solve keeps it in all";
  }
  out.push_back({line + "."});
  return out;
}

std::vector<Sentence> Why(const Json& report) {
  std::vector<Sentence> why;
  for (const Json& conflict : At(report, "/conflicts")) {
    const std::string sentence = TextAt(conflict, "/sentence");
    if (!sentence.empty()) why.push_back({sentence, FrameAt(conflict, "/frame")});
  }
  return why;
}

std::vector<Sentence> Stopped(const Json& report) {
  std::vector<Sentence> stopped;
  const std::string status = TextAt(report, "/solve/status");
  if (!status.empty() && status != "converged") {
    stopped.push_back(
        {fmt::format("The solver stopped early ({}); this is the best result so far.", status)});
  }
  if (TextAt(report, "/start/requested") == NameOf(Start::kSimulated) &&
      TextAt(report, "/start/used") == NameOf(Start::kTemplate)) {
    const std::string reason = TextAt(report, "/start/reason");
    if (!reason.empty()) stopped.push_back({reason, FrameAt(report, "/simulation/frame")});
  }
  return stopped;
}

std::vector<Sentence> Look(const Json& report, const std::vector<Sentence>& missed) {
  std::vector<Sentence> look;
  for (const Sentence& line : missed) {
    if (line.frame < 0) continue;
    look.push_back({fmt::format("Look at frame {} first.", line.frame), line.frame});
    break;
  }
  double least = 1e300;
  Sentence loosest;
  const Json& tags = At(report, "/metrics/result/tangles");
  for (size_t k = 0; k < tags.size(); ++k) {
    const double value = NumberAt(tags[k], "/min_signed_gli");
    if (!(value < least)) continue;
    least = value;
    const int frame = tags[k].value("worst_frame", 0);
    loosest = {fmt::format("The tangles are loosest in frame {}: tag {} stands at {:.2f} there.",
                           frame, k + 1, value),
               frame};
  }
  if (look.empty() && !loosest.text.empty()) look.push_back(loosest);
  const double a = NumberAt(report, "/metrics/result/a/joint_edit_deg");
  const double b = NumberAt(report, "/metrics/result/b/joint_edit_deg");
  if (!std::isnan(a) && !std::isnan(b)) {
    look.push_back({fmt::format(
        "The price: joints of a turn by {:.1f} degrees on average, those of b by {:.1f}.", a, b)});
  }
  return look;
}

}  // namespace

Verdict VerdictOf(const Json& report) {
  Verdict verdict;
  const std::vector<ReadRequirement> checks = RequirementsOf(report);
  for (const ReadRequirement& check : checks) {
    if (!check.met) verdict.missed.push_back(Missed(check));
  }
  verdict.met = verdict.missed.empty();
  verdict.outcome = Outcome(report, verdict.missed.size(), checks.size());
  verdict.asked = Asked(report);
  verdict.why = Why(report);
  verdict.stopped = Stopped(report);
  verdict.compared = Compared(report);
  verdict.look = Look(report, verdict.missed);
  return verdict;
}

std::vector<std::string> VerdictSentences(const Json& report) {
  const Verdict verdict = VerdictOf(report);
  std::vector<std::string> all = {verdict.outcome};
  for (const auto* part : {&verdict.asked, &verdict.missed, &verdict.why, &verdict.stopped,
                           &verdict.compared, &verdict.look}) {
    for (const Sentence& sentence : *part) all.push_back(sentence.text);
  }
  return all;
}

}  // namespace retarget::report
