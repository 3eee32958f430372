// The interface of a residual term. A term measures in natural units and knows neither weights nor
// solvers; it reads one frame of both figures (and, for planted feet, the anchors).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/problem/frame.h"
#include "solver/problem/rows.h"

namespace retarget::solver {

// What the parts of a term are: things of the scene that ask for something each by itself.
enum class PartKind {
  kWhole,    // one part, the term
  kHold,     // part k is Scene::holds[k]
  kTag,      // Scene::tangles[k]
  kContact,  // the contact of anchor k (column of Unknowns::anchor)
};

class Term {
 public:
  virtual ~Term() = default;
  // Name: the YAML key under `weights:`, the row of the report, the stem of the file.
  virtual const char* name() const = 0;
  virtual const char* unit() const = 0;

  virtual PartKind part_kind() const { return PartKind::kWhole; }
  virtual int parts(const Scene&) const { return 1; }
  // Adds the rows of one part in one frame. Hinges add a row only where they are active.
  virtual void EvaluatePart(const Frame& frame, int part, Rows* rows) const = 0;
  // Adds the rows of all parts, in order.
  void Evaluate(const Frame& frame, Rows* rows) const {
    const int n = parts(*frame.scene);
    for (int part = 0; part < n; ++part) EvaluatePart(frame, part, rows);
  }

  // Rows (Rows::Add) to set aside for one frame, for a back end that wants their number fixed.
  // Where rows are always on it is their number; hinges take a guess, and what is active beyond it
  // is put together in the last. 0: the term has coordinate rows only.
  virtual int row_slots(const Frame&) const { return kHingeSlots; }
  // Contact terms are raised in stages (solve.stages: weak contacts first).
  virtual bool staged() const { return false; }

 protected:
  // More hinges of one term are seldom active in one frame of a clip.
  static constexpr int kHingeSlots = 12;
};

}  // namespace retarget::solver
