// foot_swing: near the floor a free foot leaves its footprint, and comes to the next, along the
// path that it takes in the capture.
//   r = w(t) (p - (a_x, h, a_z) - Ry(theta) (s(t) - s(e)))   (m)
// e is the first or last frame of the contact, a its anchor, h its mean height in the source, s the
// node in the source, theta the heading by which the edit has turned the root (swing-twist about
// the vertical). w fades from 1 to 0 with the foot's height over the contact and with time from its
// end, so that an edited stride is made up for where the foot is high. Without it a foot that is
// let go returns to its tracked place at once, over the floor. 1 frame and the anchor, 1 body.
// YAML: weights.foot_swing.
#pragma once

#include <vector>

#include "solver/problem/term.h"

namespace retarget::solver {

class FootSwing : public Term {
 public:
  explicit FootSwing(const Scene& scene);
  const char* name() const override { return "foot_swing"; }
  const char* unit() const override { return "m"; }
  PartKind part_kind() const override { return PartKind::kContact; }
  int parts(const Scene&) const override { return static_cast<int>(feet_.size()); }
  int row_slots(const Frame& frame) const override;
  bool staged() const override { return true; }
  void EvaluatePart(const Frame& frame, int anchor, Rows* rows) const override;

  // The frames in which the term may read the anchor of a contact, the contact included.
  static Contact Reach(const Scene& scene, int figure, const Contact& contact);

 private:
  struct Guided {
    int t;
    double weight;
    Vec3 way;  // s(t) - s(e), in the source
  };
  struct Foot {
    int figure, node;
    double height;               // h (m)
    std::vector<Guided> guided;  // sorted by frame
  };
  std::vector<Foot> feet_;  // per anchor
};

}  // namespace retarget::solver
