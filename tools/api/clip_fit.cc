#include "tools/api/clip_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/body/contact.h"
#include "model/body/mirror.h"
#include "model/geometry/so3.h"

namespace retarget::api {
namespace {

using solver::kClearlyBetter;
using solver::kPostureNoise;
using solver::PostureDistance;

constexpr double kSearchFps = 10;   // of a whole clip: postures change little in between
constexpr double kLeastMotion = 1;  // s that must be left of a clip from a start that is proposed
constexpr double kLying = 60;       // degrees of the trunk from the vertical
constexpr double kSitting = 0.65;   // height of the root over the lowest foot, in leg lengths
constexpr double kInTheAir = 0.10;  // m over where the clip's feet rest
constexpr double kNear = 0.10;  // of the stature: as near as a posed figure is to a captured one
constexpr double kOtherSize = 1.35;  // of the partner's stature, against the template's

enum class Stance { kStands, kSits, kLies };
constexpr const char* kVerbs[] = {"stands", "sits or crouches", "lies"};

double LowestNode(const Body& body, const PosedBody& posed) {
  double lowest = posed.node[0].y();
  for (int n = 0; n < body.num_nodes(); ++n) lowest = std::min(lowest, posed.node[n].y());
  return lowest;
}

Stance StanceOf(const Body& body, const Pose& pose) {
  const PosedBody posed = PoseBody(body, pose);
  const Vec3 trunk = posed.node[body.FindNode("neck")] - posed.node[0];
  const double tilt = std::atan2(std::hypot(trunk.x(), trunk.z()), trunk.y()) / kDegree;
  if (tilt > kLying) return Stance::kLies;
  const double leg = body.SegmentLength(body.FindNode("left_knee")) +
                     body.SegmentLength(body.FindNode("left_ankle"));
  const double height = posed.node[0].y() - LowestNode(body, posed);
  return height < kSitting * leg ? Stance::kSits : Stance::kStands;
}

Pose MirroredPose(const Body& body, Pose pose) {
  pose.rotation = ReflectedRotations(body, pose);
  return pose;
}

bool ClearlyBetter(double other, double now) {
  return other < kClearlyBetter * now && now - other > kPostureNoise;
}

double Rms(double x, double y) { return std::sqrt(0.5 * (x * x + y * y)); }

// What stands out between the clip's posture and the figure's.
std::vector<std::string> Differences(const solver::RetargetInput& input, int f, bool fits) {
  std::vector<std::string> differs;
  const char* who = report::kFigure[f];
  const Pose& pose = input.clip[f].frames[input.template_frame];
  const Stance is = StanceOf(input.body[f], pose);
  const Stance wanted = StanceOf(input.posture.body[f], input.posture.pose[f]);
  if (!fits && is != wanted) {
    differs.push_back(fmt::format("{} where figure {} {}", kVerbs[static_cast<int>(is)], who,
                                  kVerbs[static_cast<int>(wanted)]));
  } else if (!fits) {
    differs.push_back("holds trunk and legs otherwise than figure " + std::string(who));
  }
  const auto ratio = [&](const std::array<Body, 2>& body) {
    return body[f].stature / body[1 - f].stature;
  };
  const double size = ratio(input.body) / ratio(input.posture.body);
  if (size < 1 / kOtherSize || size > kOtherSize) {
    differs.push_back(
        fmt::format("is {:.2f} times as tall beside its partner as figure {}", size, who));
  }
  if (input.posture.supports[f].empty()) return differs;
  std::vector<double> heights;
  for (const Pose& p : input.clip[f].frames) {
    heights.push_back(LowestNode(input.body[f], PoseBody(input.body[f], p)));
  }
  const double now = heights[input.template_frame];
  std::nth_element(heights.begin(), heights.begin() + static_cast<long>(heights.size() / 20),
                   heights.end());
  const double air = now - heights[heights.size() / 20];
  if (air > kInTheAir) {
    differs.push_back(
        fmt::format("has its feet {:.0f} cm in the air where figure {} stands", 100 * air, who));
  }
  return differs;
}

// The frame at which both clips together are nearest to the template, and how near.
std::pair<int, double> BestTogether(const std::array<solver::FigurePosture, 2>& wanted,
                                    const std::array<Clip, 2>& clip) {
  std::pair<int, double> best{0, 1e300};
  for (int t = 0; t < clip[0].num_frames(); ++t) {
    const double distance = Rms(wanted[0].DistanceOf(clip[0].frames[t]).value(),
                                wanted[1].DistanceOf(clip[1].frames[t]).value());
    if (distance < best.second) best = {t, distance};
  }
  return best;
}

// All of a clip, from its beginning; `start` is where the options begin.
Clip WholeClip(const io::LoadedClip& clip) {
  const int before = static_cast<int>(clip.options.start * kSearchFps);
  const int after =
      static_cast<int>((clip.duration() - clip.options.start - kLeastMotion) * kSearchFps);
  return clip.Resampled(kSearchFps, -before, std::max(1, after));
}

}  // namespace

JobFit FitOfJob(const solver::RetargetInput& input, const std::array<io::LoadedClip, 2>& clips,
                const TangleSettings& settings, double offset_s, const std::string& template_at) {
  JobFit out;
  const std::vector<Tag> tags = solver::FindTemplateTangles(input.posture, settings).tags;
  const solver::ClipFit fit = solver::FitOf(input.posture, tags, input.clip, input.template_frame);
  const bool same = solver::IsSameMotion(input.clip[0], input.clip[1]);
  out.warnings = solver::WarningsOf(fit, same);
  const std::array<solver::FigurePosture, 2> wanted = {
      solver::FigurePosture(input.posture, 0, tags), solver::FigurePosture(input.posture, 1, tags)};
  const double fps = input.clip[0].fps;
  const double as_given = fit.as_given();
  std::array<double, 2> mirrored;
  for (int f = 0; f < 2; ++f) {
    FigureFit& figure = out.figure[f];
    figure.distance = fit.at_template[f][f];
    figure.fits = !fit.stands_otherwise(f, f);
    figure.differs = Differences(input, f, figure.fits);
    const solver::Instant here = solver::BestInstant(wanted[f], input.clip[f]);
    figure.best_at_s = offset_s + here.frame / fps;
    figure.best_distance = here.distance.value();
    const solver::Instant anywhere = solver::BestInstant(wanted[f], WholeClip(clips[f]));
    const double before = std::floor(clips[f].options.start * kSearchFps) / kSearchFps;
    figure.best_start_s =
        std::max(0.0, clips[f].options.start - before + anywhere.frame / kSearchFps);
    figure.best_start_distance = anywhere.distance.value();
    mirrored[f] =
        wanted[f]
            .DistanceOf(MirroredPose(input.body[f], input.clip[f].frames[input.template_frame]))
            .value();
  }
  if (same || fit.swapped_fits_better()) return out;  // that comes first
  for (int f = 0; f < 2; ++f) {
    FigureFit& figure = out.figure[f];
    if (figure.differs.empty()) continue;
    figure.sentence =
        fmt::format("clip {} {}", report::kFigure[f], fmt::join(figure.differs, ", "));
    const double now = figure.distance.value();
    if (ClearlyBetter(figure.best_start_distance, now)) {
      figure.sentence += fmt::format(
          "; from {:.1f} s on ({} {:.1f}) it is nearer (nodes {:.0f} % of the stature off, not "
          "{:.0f} %)",
          figure.best_start_s, clips[f].options.Named(clips[f].options.words.start),
          figure.best_start_s, 100 * figure.best_start_distance, 100 * now);
    } else if (!figure.fits) {
      figure.sentence +=
          fmt::format("; no instant of it is clearly nearer (nodes {:.0f} % of the stature off)",
                      100 * std::min(now, figure.best_start_distance));
    }
    out.warnings.push_back(figure.sentence);
  }
  const auto [frame, together] = BestTogether(wanted, input.clip);
  if (as_given > kNear && ClearlyBetter(together, as_given)) {
    out.warnings.push_back(fmt::format(
        "both clips are nearer to the template at {:.2f} s: {} {:.2f} (nodes {:.0f} % of the "
        "stature off, not {:.0f} %)",
        offset_s + frame / fps, template_at, offset_s + frame / fps, 100 * together,
        100 * as_given));
  }
  const double as_mirrored = Rms(mirrored[0], mirrored[1]);
  out.mirrored_fits_better = ClearlyBetter(as_mirrored, as_given);
  if (out.mirrored_fits_better) {
    out.warnings.push_back(fmt::format(
        "the clips fit the mirrored template clearly better: retarget pose TEMPLATE --mirror both "
        "(nodes {:.0f} % of the stature off, not {:.0f} %)",
        100 * as_mirrored, 100 * as_given));
  }
  return out;
}

report::Json JobFitJson(const JobFit& fit) {
  report::Json out;
  for (int f = 0; f < 2; ++f) {
    const FigureFit& figure = fit.figure[f];
    out[report::kFigure[f]] = {{"fits", figure.fits},
                               {"distance", figure.distance.value()},
                               {"stance_distance", figure.distance.stance},
                               {"differs", figure.differs},
                               {"best_at_s", figure.best_at_s},
                               {"best_distance", figure.best_distance},
                               {"best_start_s", figure.best_start_s},
                               {"best_start_distance", figure.best_start_distance},
                               {"sentence", figure.sentence}};
  }
  out["mirrored_fits_better"] = fit.mirrored_fits_better;
  return out;
}

}  // namespace retarget::api
