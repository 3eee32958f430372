#include "io/recognition/figure_tree.h"

#include <algorithm>

#include "model/rig/tree.h"

namespace retarget::io {

bool ArrangeTrunk(const Rig& rig, const std::function<std::vector<int>(int)>& named_necks,
                  JointMap* map, bool* neck_named) {
  *neck_named = false;
  const int hips = CommonAncestor(rig, map->left.hip, map->right.hip);
  const int shoulders = CommonAncestor(rig, map->left.shoulder, map->right.shoulder);
  map->root = CommonAncestor(rig, hips, shoulders);
  if (map->root < 0) return false;
  if (!DescendsFrom(rig, map->head, map->root) || map->head == map->root) map->head = -1;
  const auto fork = [&](const JointMap::Side& s) {  // carries the arm
    return CommonAncestor(rig, s.shoulder, map->head >= 0 ? map->head : map->right.shoulder);
  };
  int arms = std::max(fork(map->left), fork(map->right));
  if (map->head < 0) arms = CommonAncestor(rig, map->left.shoulder, map->right.shoulder);
  const std::vector<int> named = named_necks(map->root);
  int top = map->head;
  if (top < 0) {  // the last neck bone, else the bone that carries the arms
    for (const int joint : named) {
      if (DescendsFrom(rig, joint, arms) && joint > top) top = joint;
    }
  }
  std::vector<int> chain;
  if (top >= 0) chain = Between(rig, map->root, top);
  if (map->head < 0 && top > map->root) chain.push_back(top);
  if (top < 0 && arms > map->root) {
    chain = Between(rig, map->root, arms);
    chain.push_back(arms);
  }
  auto neck = std::find_if(chain.begin(), chain.end(), [&](int j) {
    return j > arms && std::find(named.begin(), named.end(), j) != named.end();
  });
  if (neck == chain.end()) {
    neck = std::find_if(chain.begin(), chain.end(), [&](int j) { return j > arms; });
  } else {
    *neck_named = true;
  }
  map->spine.assign(chain.begin(), neck);
  map->neck.assign(neck, chain.end());
  return true;
}

int HeadByWords(const Rig& rig, const std::vector<JointWords>& words, const JointMap& map) {
  const int arms = CommonAncestor(rig, map.left.shoulder, map.right.shoulder);
  for (int j = 0; arms >= 0 && j < rig.num_joints(); ++j) {
    const bool on_arm =
        DescendsFrom(rig, j, map.left.shoulder) || DescendsFrom(rig, j, map.right.shoulder);
    if (words[j].part == BodyPart::kHead && j != arms && !on_arm && DescendsFrom(rig, j, arms)) {
      return j;
    }
  }
  return -1;
}

bool ArrangeByWords(const Rig& rig, const std::vector<JointWords>& words, JointMap* map) {
  const auto named_necks = [&](int root) {
    std::vector<int> named;
    for (int j = 0; j < rig.num_joints(); ++j) {
      if (words[j].part == BodyPart::kNeck && DescendsFrom(rig, j, root)) named.push_back(j);
    }
    return named;
  };
  bool neck_named = false;
  return ArrangeTrunk(rig, named_necks, map, &neck_named);
}

}  // namespace retarget::io
