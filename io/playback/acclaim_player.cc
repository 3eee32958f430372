#include <cctype>
#include <cstdlib>
#include <map>
#include <sstream>

#include "io/playback/players.h"

namespace retarget::io::playback {
namespace {

// As the format's definition has it: a bone's transform is that of its parent's end, turned by
// C M C^-1 with the axes C and the motion M, both products of turns about fixed axes.
struct Bone {
  std::string name;
  int parent = -1;
  Vec3 direction = Vec3::Zero();
  double length = 0;
  Quat axes = Quat::Identity();
  std::vector<std::string> dofs;  // "tx", "rz", ..., in the order of the numbers
};

std::string Lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

// A line as words; comments and brackets are not there.
std::vector<std::string> WordsOf(std::string line) {
  line = line.substr(0, line.find('#'));
  for (char& c : line) {
    if (c == '(' || c == ')' || c == ',') c = ' ';
  }
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

double Number(const std::vector<std::string>& words, size_t k) {
  return k < words.size() ? std::strtod(words[k].c_str(), nullptr) : 0;
}

Vec3 Numbers(const std::vector<std::string>& words, size_t k) {
  return {Number(words, k), Number(words, k + 1), Number(words, k + 2)};
}

// Turns by three angles about fixed axes in an order such as "XYZ", the first turn first.
Quat TurnsAbout(const std::string& order, const Vec3& angles) {
  Quat turn = Quat::Identity();
  for (size_t k = 0; k < 3; ++k) {
    turn = Eigen::AngleAxisd(angles[static_cast<long>(k)], Vec3::Unit(order[k] - 'x')) * turn;
  }
  return turn;
}

class AcclaimPlayer {
 public:
  explicit AcclaimPlayer(const PlayedFile& file) : file_(file) {
    bones_.emplace_back();
    bones_.back().name = "root";
    ReadSkeleton();
    ReadMotion();
    if (frames_.empty()) throw InputError(file.name + ": no frames");
  }

  Played Play(const std::vector<PlayedJoint>& joints, const std::vector<double>& times) const {
    std::vector<int> parent;
    std::vector<std::string> names;
    // Parents first: by depth.
    std::vector<int> order;
    std::vector<int> place(bones_.size(), -1);
    for (bool more = true; more;) {
      more = false;
      for (size_t b = 0; b < bones_.size(); ++b) {
        const int above = bones_[b].parent;
        if (place[b] >= 0 || (b > 0 && (above < 0 || place[static_cast<size_t>(above)] < 0)))
          continue;
        place[b] = static_cast<int>(order.size());
        order.push_back(static_cast<int>(b));
        more = true;
      }
    }
    for (const int b : order) {
      const Bone& bone = bones_[static_cast<size_t>(b)];
      parent.push_back(bone.parent < 0 ? -1 : place[static_cast<size_t>(bone.parent)]);
      names.push_back(bone.name);
    }
    std::vector<std::vector<LocalTransform>> frames;
    for (const auto& frame : frames_) {
      frames.emplace_back();
      for (const int b : order) frames.back().push_back(frame[static_cast<size_t>(b)]);
    }
    return PlayFrames(parent, frames, 1 / file_.fps, IndicesOf(joints, names, file_.name), times);
  }

 private:
  void ReadSkeleton() {
    std::istringstream lines(file_.skeleton);
    std::string section;
    std::string root_order = "xyz";
    Vec3 root_angles = Vec3::Zero();
    for (std::string line; std::getline(lines, line);) {
      const std::vector<std::string> words = WordsOf(line);
      if (words.empty()) continue;
      const std::string key = Lower(words[0]);
      if (key[0] == ':') {
        section = key;
      } else if (section == ":units" && key == "angle") {
        degrees_ = words.size() < 2 || Lower(words[1]) != "rad";
      } else if (section == ":root") {
        if (key == "order") bones_[0].dofs = Dofs(words);
        if (key == "position") bones_[0].direction = Numbers(words, 1);
        if (key == "axis" && words.size() > 1) root_order = Lower(words[1]);
        if (key == "orientation") root_angles = Numbers(words, 1);
      } else if (section == ":bonedata") {
        ReadBoneLine(key, words);
      } else if (section == ":hierarchy") {
        for (size_t k = 1; k < words.size(); ++k) {
          bones_[static_cast<size_t>(Find(words[k]))].parent = Find(key);
        }
      }
    }
    bones_[0].axes = TurnsAbout(root_order, Angle() * root_angles);
  }

  void ReadBoneLine(const std::string& key, const std::vector<std::string>& words) {
    if (key == "begin") {
      bones_.emplace_back();
      return;
    }
    Bone& bone = bones_.back();
    if (key == "name" && words.size() > 1) bone.name = words[1];
    if (key == "direction") bone.direction = Numbers(words, 1);
    if (key == "length") bone.length = Number(words, 1);
    if (key == "dof") bone.dofs = Dofs(words);
    if (key == "axis") {
      const std::string order = words.size() > 4 ? Lower(words[4]) : "xyz";
      bone.axes = TurnsAbout(order, Angle() * Numbers(words, 1));
    }
  }

  static std::vector<std::string> Dofs(const std::vector<std::string>& words) {
    std::vector<std::string> dofs;
    for (size_t k = 1; k < words.size(); ++k) dofs.push_back(Lower(words[k]));
    return dofs;
  }

  double Angle() const { return degrees_ ? kDegree : 1; }

  int Find(const std::string& name) const {
    for (size_t b = 0; b < bones_.size(); ++b) {
      if (Lower(bones_[b].name) == Lower(name)) return static_cast<int>(b);
    }
    throw InputError(file_.name + ": no bone " + name + " in its skeleton");
  }

  void ReadMotion() {
    std::vector<LocalTransform> frame(bones_.size());
    for (size_t b = 0; b < bones_.size(); ++b) frame[b] = Transform(b, {});
    bool any = false;
    std::istringstream lines(file_.bytes);
    for (std::string line; std::getline(lines, line);) {
      const std::vector<std::string> words = WordsOf(line);
      if (words.empty()) continue;
      if (words[0][0] == ':') {
        if (Lower(words[0]) == ":degrees") degrees_ = true;
        if (Lower(words[0]) == ":radians") degrees_ = false;
      } else if (words.size() == 1) {
        if (any) frames_.push_back(frame);
        any = true;
      } else {
        const size_t b = static_cast<size_t>(Find(words[0]));
        frame[b] = Transform(b, words);
      }
    }
    if (any) frames_.push_back(frame);
  }

  // The numbers stand behind the bone's name; without any it is at rest.
  LocalTransform Transform(size_t b, const std::vector<std::string>& words) const {
    const Bone& bone = bones_[b];
    LocalTransform out;
    if (b == 0) {
      out.translation = bone.direction;
    } else if (bone.parent > 0) {
      const Bone& above = bones_[static_cast<size_t>(bone.parent)];
      out.translation = above.length * above.direction;
    }
    Vec3 shift = Vec3::Zero();
    Quat turn = Quat::Identity();
    for (size_t k = 0; k < bone.dofs.size(); ++k) {
      const int axis = bone.dofs[k].size() == 2 ? bone.dofs[k][1] - 'x' : -1;
      if (axis < 0 || axis > 2) continue;
      const double value = Number(words, k + 1);
      if (bone.dofs[k][0] == 't') shift[axis] = value;
      if (bone.dofs[k][0] == 'r')
        turn = Eigen::AngleAxisd(Angle() * value, Vec3::Unit(axis)) * turn;
    }
    out.translation += b == 0 ? shift : bone.axes * shift;
    out.rotation = bone.axes * turn * bone.axes.conjugate();
    return out;
  }

  const PlayedFile& file_;
  std::vector<Bone> bones_;  // the root first
  std::vector<std::vector<LocalTransform>> frames_;
  bool degrees_ = true;
};

}  // namespace

Played PlayAcclaim(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
                   const std::vector<double>& times) {
  return AcclaimPlayer(file).Play(joints, times);
}

}  // namespace retarget::io::playback
