// The interface of a residual term. A term measures in natural units and knows neither weights nor
// solvers; it reads one frame of both figures (and, for planted feet, the anchors).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/problem/frame.h"
#include "solver/problem/rows.h"

namespace retarget::solver {

class Term {
 public:
  virtual ~Term() = default;
  // Name: the YAML key under `weights:`, the row of the report, the stem of the file.
  virtual const char* name() const = 0;
  virtual const char* unit() const = 0;
  // Adds the rows of one frame. Hinges add a row only where they are active.
  virtual void Evaluate(const Frame& frame, Rows* rows) const = 0;
  // Contact terms are raised in stages (solve.stages: weak contacts first).
  virtual bool staged() const { return false; }
};

}  // namespace retarget::solver
