#include "model/body/contact.h"

#include <algorithm>
#include <cmath>

#include "model/geometry/quantile.h"

namespace retarget {
namespace {

constexpr double kTimeSlack = 1e-4;  // s; rates such as 1/0.033333 do not cut a run short

std::vector<bool> PlantedFrames(const std::vector<Vec3>& p, double fps,
                                const ContactSettings& settings) {
  const int n = static_cast<int>(p.size());
  std::vector<double> heights;
  for (const Vec3& x : p) heights.push_back(x.y());
  const double ceiling = Quantile(std::move(heights), 0.05) + settings.height;
  std::vector<bool> planted(p.size());
  for (int k = 0; k < n; ++k) {
    const int before = std::max(k - 1, 0), after = std::min(k + 1, n - 1);
    const double speed =
        after > before ? (p[after] - p[before]).norm() * fps / (after - before) : 0;
    planted[k] = speed < settings.speed && p[k].y() <= ceiling;
  }
  return planted;
}

}  // namespace

std::vector<int> FootNodes(const Body& body) {
  std::vector<int> nodes;
  for (int n = 0; n < body.num_nodes(); ++n) {
    const std::string& name = body.nodes[n].name;
    if (name.ends_with("_ankle") || name.ends_with("_toe")) nodes.push_back(n);
  }
  return nodes;
}

std::vector<Contact> DetectContacts(const std::vector<Vec3>& path, double fps, int node,
                                    const ContactSettings& settings) {
  std::vector<Contact> runs;
  const std::vector<bool> planted = PlantedFrames(path, fps, settings);
  for (int k = 0; k < static_cast<int>(path.size()); ++k) {
    if (!planted[k]) continue;
    const int gap = runs.empty() ? 0 : k - runs.back().last - 1;
    const bool joins = !runs.empty() && (gap == 0 || gap / fps < settings.max_gap_s);
    if (joins) {
      runs.back().last = k;
    } else {
      runs.push_back({node, k, k});
    }
  }
  std::erase_if(runs, [&](const Contact& run) {
    return (run.last - run.first + 1) / fps < settings.min_length_s - kTimeSlack;
  });
  return runs;
}

std::vector<Contact> DetectContacts(const Body& body, const Clip& clip,
                                    const std::vector<int>& supports,
                                    const ContactSettings& settings) {
  std::vector<std::vector<Vec3>> path(supports.size());
  PosedBody posed;
  for (const Pose& pose : clip.frames) {
    PoseBody(body, pose, &posed);
    for (size_t s = 0; s < supports.size(); ++s) path[s].push_back(posed.node[supports[s]]);
  }
  std::vector<Contact> contacts;
  for (size_t s = 0; s < supports.size(); ++s) {
    for (const Contact& c : DetectContacts(path[s], clip.fps, supports[s], settings)) {
      contacts.push_back(c);
    }
  }
  return contacts;
}

}  // namespace retarget
