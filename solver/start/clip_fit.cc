#include "solver/start/clip_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/body/path.h"
#include "model/geometry/so3.h"

namespace retarget::solver {
namespace {

constexpr double kSameMotionDeg = 1;  // mean over the joints of a frame

double Rms(double x, double y) { return std::sqrt(0.5 * (x * x + y * y)); }

std::vector<Vec3> NodesFromRoot(const Body& body, const Pose& pose) {
  std::vector<Vec3> nodes = PoseBody(body, pose).node;
  const Vec3 root = nodes[0];
  for (Vec3& node : nodes) node -= root;
  return nodes;
}

}  // namespace

double PostureDistance::value() const { return Rms(whole, involved); }

FigurePosture::FigurePosture(const TemplatePosture& posture, int figure,
                             const std::vector<Tag>& tags)
    : body_(posture.body[figure]),
      nodes_(NodesFromRoot(body_, posture.pose[figure])),
      involved_(nodes_.size(), 0),
      arm_(nodes_.size(), 0) {
  for (const char* elbow : {"left_elbow", "right_elbow"}) {
    const int first = body_.FindNode(elbow);
    if (first >= 0) arm_[first] = 1;
  }
  for (size_t n = 1; n < arm_.size(); ++n) arm_[n] |= arm_[body_.nodes[n].parent];
  for (const Tag& tag : tags) {
    for (const int n : NodesOn(body_, figure == 0 ? tag.tangle.a : tag.tangle.b)) involved_[n] = 1;
  }
  for (const Hold& hold : posture.holds) {
    for (const HoldPoint& point : {hold.from, hold.to}) {
      if (point.figure == figure) involved_[point.node] = 1;
    }
  }
}

PostureDistance FigurePosture::DistanceOf(const Pose& pose) const {
  const std::vector<Vec3> nodes = NodesFromRoot(body_, pose);
  PostureDistance out;
  out.yaw = BestYaw(nodes, nodes_);
  const Quat turn = YawRotation(out.yaw);
  double whole = 0, involved = 0, stance = 0;
  int num_involved = 0, num_stance = 0;
  for (size_t n = 1; n < nodes.size(); ++n) {
    const double d2 = (turn * nodes[n] - nodes_[n]).squaredNorm();
    whole += d2;
    if (involved_[n]) {
      involved += d2;
      ++num_involved;
    }
    if (!arm_[n]) {
      stance += d2;
      ++num_stance;
    }
  }
  out.whole = std::sqrt(whole / static_cast<double>(nodes.size() - 1)) / body_.stature;
  out.involved = num_involved > 0 ? std::sqrt(involved / num_involved) / body_.stature : out.whole;
  out.stance = std::sqrt(stance / num_stance) / body_.stature;
  return out;
}

Instant BestInstant(const FigurePosture& figure, const Clip& clip) {
  Instant best;
  for (int t = 0; t < clip.num_frames(); ++t) {
    const PostureDistance distance = figure.DistanceOf(clip.frames[t]);
    if (t == 0 || distance.value() < best.distance.value()) best = {t, distance};
  }
  return best;
}

double ClipFit::as_given() const {
  return Rms(at_template[0][0].value(), at_template[1][1].value());
}

double ClipFit::swapped() const {
  return Rms(at_template[0][1].value(), at_template[1][0].value());
}

bool ClipFit::swapped_fits_better() const {
  return swapped() < kClearlyBetter * as_given() && as_given() - swapped() > kPostureNoise;
}

bool ClipFit::stands_otherwise(int clip, int figure) const {
  return at_template[clip][figure].stance > kOtherStance;
}

ClipFit FitOf(const TemplatePosture& posture, const std::vector<Tag>& tags,
              const std::array<Clip, 2>& clips, int template_frame) {
  ClipFit fit;
  for (int figure = 0; figure < 2; ++figure) {
    const FigurePosture wanted(posture, figure, tags);
    for (int clip = 0; clip < 2; ++clip) {
      fit.at_template[clip][figure] = wanted.DistanceOf(clips[clip].frames[template_frame]);
    }
  }
  return fit;
}

bool IsSameMotion(const Clip& a, const Clip& b) {
  if (a.num_frames() != b.num_frames()) return false;
  for (int t = 0; t < a.num_frames(); ++t) {
    const Pose& p = a.frames[t];
    const Pose& q = b.frames[t];
    if (p.rotation.size() != q.rotation.size()) return false;
    // Of the root, the tilt alone.
    double sum = std::acos(std::clamp(
        (p.rotation[0].conjugate() * Vec3::UnitY()).dot(q.rotation[0].conjugate() * Vec3::UnitY()),
        -1.0, 1.0));
    for (size_t l = 1; l < p.rotation.size(); ++l)
      sum += p.rotation[l].angularDistance(q.rotation[l]);
    if (sum / static_cast<double>(p.rotation.size()) > kSameMotionDeg * kPi / 180) return false;
  }
  return true;
}

std::vector<std::string> WarningsOf(const ClipFit& fit, bool same_motion) {
  std::vector<std::string> warnings;
  const auto warn = [&](const char* format, auto... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    warnings.emplace_back(text);
  };
  if (same_motion) {
    warnings.emplace_back("both clips are the same motion");
  } else if (fit.swapped_fits_better()) {
    warn(
        "the clips fit the template clearly better the other way round: swap them (nodes %.0f %% "
        "of the stature off, as given %.0f %%)",
        100 * fit.swapped(), 100 * fit.as_given());
    return warnings;
  }
  for (int clip = 0; clip < 2; ++clip) {
    const char name = "ab"[clip];
    const double own = 100 * fit.at_template[clip][clip].stance;
    const double other = 100 * fit.at_template[clip][1 - clip].stance;
    if (!fit.stands_otherwise(clip, clip)) continue;
    if (fit.stands_otherwise(clip, 1 - clip)) {
      warn(
          "clip %c fits no figure of the template: its trunk and legs are otherwise at the "
          "template's instant (%.0f %% of the stature off figure %c, %.0f %% off figure %c)",
          name, own, name, other, "ba"[clip]);
    } else {
      warn(
          "clip %c does not fit figure %c: its trunk and legs are otherwise at the template's "
          "instant (%.0f %% of the stature off; figure %c %.0f %%)",
          name, name, own, "ba"[clip], other);
    }
  }
  return warnings;
}

}  // namespace retarget::solver
