#include "model/rig/jumps.h"

#include <algorithm>
#include <cmath>

#include "model/geometry/quantile.h"

namespace retarget {
namespace {

// Faster than joints turn in anything but a throw (rad/s), and than what is usual about that time
// by so many times: a fast motion is fast for longer.
constexpr double kFast = 35, kTimes = 6;
constexpr double kAround = 0.5;   // s either way that say what is usual
constexpr double kLongest = 0.1;  // s that may stand apart together

struct Step {
  double speed = 0;  // rad/s
  int joint = 0;
};

Step FastestStep(const RigMotion& motion, const std::vector<int>& joints, int from, int to) {
  Step out;
  for (const int j : joints) {
    const double angle =
        motion.frames[from].rotation[j].angularDistance(motion.frames[to].rotation[j]);
    const double speed = angle / ((to - from) * motion.frame_time);
    if (speed > out.speed) out = {speed, j};
  }
  return out;
}

// The median of the steps about step t, itself left out.
double Usual(const std::vector<Step>& steps, int t, int reach) {
  std::vector<double> around;
  const int last = static_cast<int>(steps.size()) - 1;
  for (int s = std::max(0, t - reach); s <= std::min(last, t + reach); ++s) {
    if (s != t) around.push_back(steps[s].speed);
  }
  return around.empty() ? 0 : Median(std::move(around));
}

}  // namespace

std::vector<JumpRun> FindJumps(const RigMotion& motion, const JointMap& map) {
  std::vector<int> joints;
  JointMap copy = map;
  VisitJoints(&copy, [&](const int* joint) {
    if (*joint >= 0) joints.push_back(*joint);
  });
  const int frames = motion.num_frames();
  std::vector<Step> steps;
  for (int t = 0; t + 1 < frames; ++t) steps.push_back(FastestStep(motion, joints, t, t + 1));
  const auto frames_in = [&](double seconds) {
    return std::max(4, static_cast<int>(std::ceil(seconds / motion.frame_time)));
  };
  const int longest = frames_in(kLongest);
  const auto is_jump = [&](int t) {
    return steps[t].speed > kFast && steps[t].speed > kTimes * Usual(steps, t, frames_in(kAround));
  };
  std::vector<JumpRun> runs;
  for (int t = 0; t + 1 < frames; ++t) {
    if (!is_jump(t)) continue;
    int last = t;  // of the steps that belong together
    Step fastest = steps[t];
    for (int s = t + 1; s + 1 < frames && s - t <= longest; ++s) {
      if (!is_jump(s)) continue;
      last = s;
      if (steps[s].speed > fastest.speed) fastest = steps[s];
    }
    const bool from_start = t < longest && frames > 3 * longest;
    const bool to_end = frames - 2 - last < longest && frames > 3 * longest;
    const bool returns =
        last > t && FastestStep(motion, joints, t, last + 1).speed < kFast / kTimes;
    if (returns) {
      runs.push_back({t + 1, last, fastest.joint, fastest.speed});
    } else if (from_start) {
      runs.push_back({0, last, fastest.joint, fastest.speed});
    } else if (to_end) {
      runs.push_back({t + 1, frames - 1, fastest.joint, fastest.speed});
    } else {
      runs.push_back({last + 1, last, fastest.joint, fastest.speed});
    }
    t = last;
  }
  return runs;
}

void RepairJumps(const std::vector<JumpRun>& runs, RigMotion* motion) {
  const int frames = motion->num_frames();
  for (const JumpRun& run : runs) {
    if (run.is_cut()) continue;
    const int before = run.first - 1, after = run.last + 1;
    for (int t = run.first; t <= run.last; ++t) {
      if (before < 0 || after >= frames) {
        motion->frames[t] = motion->frames[before < 0 ? after : before];
        continue;
      }
      const RigFrame &a = motion->frames[before], &b = motion->frames[after];
      const double u = static_cast<double>(t - before) / (after - before);
      RigFrame& frame = motion->frames[t];
      for (size_t j = 0; j < frame.rotation.size(); ++j) {
        frame.rotation[j] = a.rotation[j].slerp(u, b.rotation[j]);
        frame.translation[j] = (1 - u) * a.translation[j] + u * b.translation[j];
        if (!frame.scale.empty()) frame.scale[j] = (1 - u) * a.scale[j] + u * b.scale[j];
      }
    }
  }
}

}  // namespace retarget
