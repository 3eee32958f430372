#include "io/recognition/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/recognition/joint_profiles.h"
#include "io/recognition/limb_words.h"
#include "io/text/quoted.h"
#include "model/rig/points.h"
#include "model/rig/tree.h"

namespace retarget::io {
namespace {

constexpr int kFewest = 9;  // joints of a human: a root and four limbs of two

class FigureFinder {
 public:
  explicit FigureFinder(const RigMotion& motion) : motion_(motion), below_(Below(motion.rig)) {}

  std::vector<FileFigure> Find() {
    for (int j = 0; j < motion_.rig.num_joints(); ++j) {
      if (motion_.rig.joints[j].parent >= 0 || below_[j] < kFewest) continue;
      AddBranch(j);
    }
    return std::move(figures_);
  }

 private:
  // Joints below each, itself counted.
  static std::vector<int> Below(const Rig& rig) {
    std::vector<int> below(rig.joints.size(), 1);
    for (int j = rig.num_joints() - 1; j > 0; --j) {
      if (rig.joints[j].parent >= 0) below[rig.joints[j].parent] += below[j];
    }
    return below;
  }

  bool IsHuman(int top) const {
    const RigMotion branch = MotionOfJoints(motion_, BranchOf(motion_.rig, top));
    if (MatchBestProfile(branch.rig).match.complete()) return true;
    const std::vector<PosedRig> poses = SamplePoses(branch);
    const NameMatch words = MatchWords(branch.rig, ReadJointWords(branch.rig), poses);
    return words.complete() || MatchShape(branch.rig, poses).map.has_value();
  }

  // The figures of a root: of the branches that it forks into where several hold a human, else it.
  void AddBranch(int root) {
    const size_t before = figures_.size();
    AddHumansBelow(root);
    if (figures_.size() - before > 1) return;
    figures_.resize(before);
    figures_.push_back({motion_.rig.joints[root].name, root});
  }

  void AddHumansBelow(int joint) {
    if (below_[joint] < 2 * kFewest) return;
    std::vector<int> branches = motion_.rig.ChildrenOf(joint);
    std::erase_if(branches, [&](int child) { return below_[child] < kFewest; });
    for (const int child : branches) {
      const size_t before = figures_.size();
      AddHumansBelow(child);
      if (branches.size() > 1 && figures_.size() == before && IsHuman(child)) Add(child);
    }
  }

  // A branch below a root, unless it is a layer of a control rig that has another already.
  void Add(int joint) {
    for (const FileFigure& figure : figures_) {
      const bool layers = IsLayer(figure.joint) || IsLayer(joint);
      if (layers && StandTogether(figure.joint, joint)) return;
    }
    figures_.push_back({motion_.rig.joints[joint].name, joint});
  }

  // Whether the names of a branch bear the mark of a layer: "DEF-spine".
  bool IsLayer(int top) const {
    constexpr const char* kMarks[] = {"def", "org", "mch", "ctrl", "ctl", "drv", "ik", "fk"};
    int marked = 0;
    for (int j = top; j < motion_.rig.num_joints(); ++j) {
      if (!DescendsFrom(motion_.rig, j, top)) continue;
      const std::string name = NormalisedName(motion_.rig.joints[j].name);
      marked += std::ranges::any_of(kMarks, [&](const char* m) { return name.starts_with(m); });
    }
    return 2 * marked > below_[top];
  }

  // Whether nearly every joint of one branch is where a joint of the other is.
  bool StandTogether(int a, int b) {
    constexpr double kNear = 1e-3, kNearly = 0.8;
    if (poses_.empty()) poses_ = SamplePoses(motion_);
    int together = 0, count = 0;
    for (int j = 0; j < motion_.rig.num_joints(); ++j) {
      if (!DescendsFrom(motion_.rig, j, b)) continue;
      ++count;
      for (int i = 0; i < motion_.rig.num_joints(); ++i) {
        if (!DescendsFrom(motion_.rig, i, a)) continue;
        const bool near = std::ranges::all_of(poses_, [&](const PosedRig& pose) {
          const double size = (pose.position[j] - pose.position[b]).norm();
          return (pose.position[i] - pose.position[j]).norm() <= kNear * size;
        });
        if (!near) continue;
        ++together;
        break;
      }
    }
    return together > kNearly * count;
  }

  const RigMotion& motion_;
  std::vector<int> below_;
  std::vector<PosedRig> poses_;
  std::vector<FileFigure> figures_;
};

}  // namespace

std::vector<FileFigure> FindFigures(const RigMotion& motion) { return FigureFinder(motion).Find(); }

FileFigure SelectFigure(const RigMotion& motion, const std::string& figure,
                        const std::string& file) {
  const std::vector<FileFigure> figures = FindFigures(motion);
  for (const FileFigure& found : figures) {
    if (found.name == figure) return found;
  }
  std::string list;
  for (size_t n = 0; n < figures.size(); ++n) {
    if (std::to_string(n) == figure) return figures[n];
    list += fmt::format("{}{} {}", n > 0 ? ", " : "", n, Quoted(figures[n].name));
  }
  const int joint = motion.rig.Find(figure);
  if (joint >= 0) return {figure, joint};
  throw InputError(fmt::format("{}: no figure {}, expected {}", file, Quoted(figure),
                               list.empty() ? "none: the file holds no figure" : "one of " + list));
}

}  // namespace retarget::io
