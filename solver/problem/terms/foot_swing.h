// foot_swing: a free foot goes from footprint to footprint as it does in the capture.
//
// Between the footprints of a foot, with anchors a and a' (solver/problem/foot_path.h):
//   r = w (p - (1 - u) (a + R c(t)) - u (a' + R c'(t))),  r_y less the lift l(D) b(t)
// c and c' are the node's captured way from the one and to the other, which leaves and reaches it
// at rest and at its height: what speed and height the capture has there fades within a short
// time. R is the turn about the vertical by which the edit has turned the root (swing-twist). u
// goes from 0 to 1 with least jerk (T. Flash and N. Hogan, "The coordination of arm movements",
// 1985), so a footprint that has moved asks for no more acceleration than a longer step must have;
// b = (4 tau (1 - tau))^3 with time tau likewise and l, which grows with the distance D by which
// the step is another than the captured one, lift a foot that went low over the floor: it steps
// and does not skate.
//
// Before the first and after the last footprint of a node, where there is one anchor only:
//   d = p - (a_x, h, a_z) - R (s(t) - s(e))
//   r = w(t) (g(p_y - h) m tanh(d_x / m), g(p_y - h) m tanh(d_z / m), c(t) d_y)
// s is the node in the source, e the contact's end. g falls from 1 to 0 as the foot rises, w with
// time from the contact's end once the captured foot has left the floor; c keeps the captured
// height where that is low; m bounds the pull on a foot that is led far away. Without this term a
// foot that is let go returns to its tracked place at once, over the floor.
//
// A foot that is never planted in a clip, though the figure stands on it, keeps its captured height
// where that is low: r = c(t) (p_y - s_y(t)). Heights count less for a foot that is higher.
// 1 frame and its anchors, 1 body. Unit m. YAML: weights.foot_swing.
#pragma once

#include <array>
#include <vector>

#include "solver/problem/foot_path.h"
#include "solver/problem/term.h"

namespace retarget::solver {

class FootSwing : public Term {
 public:
  explicit FootSwing(const Scene& scene);
  const char* name() const override { return "foot_swing"; }
  const char* unit() const override { return "m"; }
  PartKind part_kind() const override { return PartKind::kContact; }
  // Of a contact: the step that follows it, and what it guides alone; of a figure's first contact
  // also the feet that are never planted.
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
    int figure = 0, node = 0;
    double height = 0;                // h (m)
    std::vector<Guided> guided;       // sorted by frame
    std::vector<FootPathPoint> path;  // likewise
  };
  // A node whose foot is never planted.
  struct Free {
    int node = 0;
    std::vector<double> height, weight;  // per frame: s_y (m), c
  };
  // `covered`: frames in which the contact's node has a path.
  void Guide(const Scene& scene, const std::vector<std::vector<Vec3>>& node, const Contact& contact,
             const std::vector<char>& covered, Foot* foot) const;
  void FindFree(const Scene& scene, int figure, const std::vector<std::vector<Vec3>>& node);
  void EvaluateGuided(const Frame& frame, int anchor, const Guided& guided, Rows* rows) const;
  void EvaluatePath(const Frame& frame, int anchor, const FootPathPoint& point, Rows* rows) const;
  void EvaluateFree(const Frame& frame, int figure, Rows* rows) const;

  std::vector<Foot> feet_;  // per anchor
  std::array<std::vector<Free>, 2> free_;
};

}  // namespace retarget::solver
