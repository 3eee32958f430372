#include "tools/report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "tools/report/html.h"
#include "tools/report/json_reading.h"

namespace retarget::report {
namespace {

namespace fs = std::filesystem;

std::string Count(int64_t n, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
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

std::vector<std::string> Asked(const Json& report) {
  const int frames = report.value("frames", 0);
  const double seconds = frames / std::max(1e-9, report.value("fps", 30.0));
  const std::string a = FileName(report, "/inputs/clip_a/file");
  const std::string b = FileName(report, "/inputs/clip_b/file");
  const size_t tangles = At(report, "/tangles").size(), holds = At(report, "/holds").size();
  std::string kept = Count(static_cast<int64_t>(tangles), "tangle", "tangles");
  if (holds > 0) kept += " and " + Count(static_cast<int64_t>(holds), "held point", "held points");
  std::vector<std::string> asked = {
      fmt::format("a ({}) and b ({}), each captured alone, joined in the hold \"{}\" for {} "
                  "({:.1f} s): {} must "
                  "stay, the bodies must not overlap, planted feet must stand still.",
                  a, b, HoldName(report), Count(frames, "frame", "frames"), seconds, kept)};
  for (size_t k = 0; k < tangles; ++k) {
    const auto node = [&](const char* figure, int end) {
      return Humanize(TextAt(report, fmt::format("/tangles/{}/{}/{}", k, figure, end)));
    };
    asked.push_back(fmt::format("Tag {}: a from {} to {}, tangled with b from {} to {}.", k + 1,
                                node("a", 0), node("a", 1), node("b", 0), node("b", 1)));
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

std::string Outcome(const Json& report, size_t missed, size_t all) {
  const int frames = report.value("frames", 0);
  const int64_t lost = HasTags(report) ? FramesLost(report, "result") : 0;
  const std::string hold = !HasTags(report) ? ""
                           : lost > 0
                               ? fmt::format("The hold is lost in {} of {} frames", lost, frames)
                               : fmt::format("The hold is kept in all {} frames", frames);
  if (missed == 0)
    return hold.empty() ? "Every requirement is met." : hold + " and every requirement is met.";
  const std::string rest =
      fmt::format("{} of {} requirements {} missed.", missed, all, missed == 1 ? "is" : "are");
  if (hold.empty()) return rest;
  return fmt::format("{}{} {}", hold, lost > 0 ? ";" : ", but", rest);
}

// One line for a requirement that is missed.
std::string Missed(const Json& check) {
  const std::string name = check.value("name", ""), unit = check.value("unit", "");
  const std::string who = name.substr(name.find_last_of(' ') + 1);
  const double scale = unit == "m" ? 100 : 1;
  const double value = scale * NumberAt(check, "/value"), limit = scale * NumberAt(check, "/limit");
  const std::string shown = unit == "m" ? "cm" : unit;
  const auto starts = [&](const char* with) { return name.rfind(with, 0) == 0; };
  const std::string allowed = fmt::format("{:.1f} {}, {:.1f} allowed", value, shown, limit);
  std::string line;
  if (starts("tangle")) {
    line = fmt::format("Tag {} comes loose: s GLI falls to {:.2f} and must stay above {:.2f}", who,
                       value, limit);
  } else if (starts("pass-throughs")) {
    line = fmt::format("A limb passes through a limb {:.0f} times", value);
    if (value == 1) line = "A limb passes through a limb once";
  } else if (starts("penetration over 1 cm")) {
    line = fmt::format("The bodies overlap by more than 1 cm in {}", allowed);
  } else if (starts("penetration")) {
    line = "The bodies overlap by " + allowed;
  } else if (starts("foot drift")) {
    line = fmt::format("A planted foot of {} drifts by {}", who, allowed);
  } else if (starts("floor")) {
    line = fmt::format("{} goes below the floor by {}", who, allowed);
  } else if (starts("hold")) {
    line = fmt::format("Hold {} opens by {}", who, allowed);
  } else if (starts("write-back")) {
    line = fmt::format("The written rig of {} departs from the scene by {:.2f} {}, {:.2f} allowed",
                       who, value, shown, limit);
  } else {
    line = fmt::format("{}: {:.4g} {}, {:.4g} allowed", name, value, shown, limit);
  }
  std::string where = Humanize(check.value("where", ""));
  const int frame = FrameNamedIn(where);
  if (starts("tangle") && frame >= 0) where = fmt::format("frame {}", frame);  // the tag is named
  return line + (where.empty() ? "" : " (" + where + ")") + ".";
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

std::vector<std::string> Compared(const Json& report) {
  std::vector<std::string> out;
  const int frames = report.value("frames", 0);
  const auto of_all = [&](int64_t n) { return fmt::format("{} of {} frames", n, frames); };
  if (!At(report, "/metrics/source").is_null()) {
    const int64_t lost = FramesLost(report, "source");
    out.push_back(fmt::format(
        "Laid together without editing, the clips {}{}.",
        HasTags(report) ? "are tangled in " + of_all(frames - lost) + ", with " : "have ",
        Blemishes(report, "source")));
  }
  const std::string message = TextAt(report, "/simulation/message");
  if (At(report, "/metrics/baseline").is_null()) {
    out.push_back(message.empty() ? "There is no simulated run to compare with." : message);
    return out;
  }
  const int64_t lost = FramesLost(report, "baseline"), ours = FramesLost(report, "result");
  std::string line = "The simulation shows " + Blemishes(report, "baseline");
  if (HasTags(report)) {
    line = lost > 0 ? fmt::format("The simulation lost the hold in {}", of_all(lost))
                    : "The simulation keeps the hold in every frame";
    line += ", with " + Blemishes(report, "baseline");
    if (lost > 0)
      line += ours > 0 ? fmt::format("; the solve loses it in {}", ours)
                       : "; the solve keeps it in all";
  }
  out.push_back(line + ".");
  return out;
}

std::vector<std::string> Why(const Json& report) {
  std::vector<std::string> why;
  for (const Json& conflict : At(report, "/conflicts")) {
    const std::string sentence = TextAt(conflict, "/sentence");
    if (!sentence.empty()) why.push_back(sentence);
  }
  return why;
}

std::vector<std::string> Stopped(const Json& report) {
  std::vector<std::string> stopped;
  const std::string status = TextAt(report, "/solve/status");
  if (!status.empty() && status != "converged") {
    stopped.push_back(
        fmt::format("The solver stopped early ({}); this is the best result so far.", status));
  }
  if (TextAt(report, "/start/requested") == "simulated" &&
      TextAt(report, "/start/used") == "template") {
    const std::string reason = TextAt(report, "/start/reason");
    if (!reason.empty()) stopped.push_back(reason);
  }
  return stopped;
}

std::vector<std::string> Look(const Json& report, const std::vector<std::string>& missed) {
  std::vector<std::string> look;
  for (const std::string& line : missed) {
    if (FrameNamedIn(line) < 0) continue;
    look.push_back(fmt::format("Look at frame {} first.", FrameNamedIn(line)));
    break;
  }
  double least = 1e300;
  std::string tightest;
  const Json& tags = At(report, "/metrics/result/tangles");
  for (size_t k = 0; k < tags.size(); ++k) {
    const double value = NumberAt(tags[k], "/min_signed_gli");
    if (!(value < least)) continue;
    least = value;
    tightest = fmt::format("The hold is loosest in frame {}: tag {} stands at {:.2f} there.",
                           tags[k].value("worst_frame", 0), k + 1, value);
  }
  if (look.empty() && !tightest.empty()) look.push_back(tightest);
  const double a = NumberAt(report, "/metrics/result/a/joint_edit_deg");
  const double b = NumberAt(report, "/metrics/result/b/joint_edit_deg");
  if (!std::isnan(a) && !std::isnan(b)) {
    look.push_back(fmt::format(
        "The price: joints of a turn by {:.1f} degrees on average, those of b by {:.1f}.", a, b));
  }
  return look;
}

}  // namespace

int FrameNamedIn(const std::string& text) {
  static const std::regex kFrame("frame ([0-9]{1,9})");
  std::smatch match;
  return std::regex_search(text, match, kFrame) ? std::stoi(match[1]) : -1;
}

Verdict VerdictOf(const Json& report) {
  Verdict verdict;
  const Json& checks = At(report, "/requirements");
  for (const Json& check : checks) {
    if (!check.value("met", true)) verdict.missed.push_back(Missed(check));
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
    all.insert(all.end(), part->begin(), part->end());
  }
  return all;
}

}  // namespace retarget::report
