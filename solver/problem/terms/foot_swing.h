// foot_swing: a free foot goes from footprint to footprint as it does in the capture.
//
// Between two contacts of a node (a step), with anchors a and a', mean heights h and h', ends e,
// e':
//   r = p - (1 - u) (a + R c(t)) - u (a' + R c'(t)),  r_y less the lift l(D) b(t)
// c and c' are the node's captured way from e and from e', which leaves and reaches the footprint
// at rest and at the height h: what speed and height the capture has there fades within a short
// time. R is the turn about the vertical by which the edit has turned the root (swing-twist). u
// goes from 0 to 1 with least jerk while the whole foot is free (T. Flash and N. Hogan, "The
// coordination of arm movements", 1985), so a footprint that has moved asks for no more
// acceleration than a longer step must have; b = (4 tau (1 - tau))^3 with time tau likewise and l,
// which grows with the distance D by which the step is another than the captured one, lift a foot
// that went low over the floor: it steps and does not skate.
//
// At the first and last footprint of a clip, where there is one anchor only:
//   d = p - (a_x, h, a_z) - R (s(t) - s(e))
//   r = w(t) (g(p_y - h) m tanh(d_x / m), g(p_y - h) m tanh(d_z / m), c(t) d_y)
// g falls from 1 to 0 as the foot rises, w with time from the contact's end once the captured foot
// has left the floor; c keeps the captured height, softly, where that is low; m bounds the pull on
// a foot that is led far away. Without this term a foot that is let go returns to its tracked place
// at once, over the floor.
// 1 frame and its anchors, 1 body. Unit m. YAML: weights.foot_swing.
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
  // Of a contact: the step that follows it, and what it guides alone.
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
  struct Stepping {
    double u;          // share of the next footprint
    double lift;       // b
    double height;     // of the path without the lift (m)
    Vec3 way, before;  // c and c' over the floor
  };
  struct Foot {
    int figure = 0, node = 0;
    double height = 0;               // h (m)
    std::vector<Guided> guided;      // sorted by frame
    int next = -1;                   // anchor that the step leads to, -1: no step
    Vec3 stride = Vec3::Zero();      // s(e') - s(e) over the floor
    double most_lift = 0;            // m
    int first = 0;                   // frame of steps[0]
    std::vector<Stepping> stepping;  // frame by frame
  };
  void Guide(const Scene& scene, const std::vector<std::vector<Vec3>>& node, const Contact& contact,
             bool before, bool after, Foot* foot) const;
  void EvaluateGuided(const Frame& frame, int anchor, const Guided& guided, Rows* rows) const;
  void EvaluateStep(const Frame& frame, int anchor, const Stepping& step, Rows* rows) const;

  std::vector<Foot> feet_;  // per anchor
};

}  // namespace retarget::solver
