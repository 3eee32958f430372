// What was asked and what came out, in sentences that need no manual: made here alone, for the
// terminal and for the report page.
#pragma once

#include <string>
#include <vector>

#include "tools/report/report.h"

namespace retarget::report {

struct Sentence {
  std::string text;
  int frame = -1;  // that it names or is about; -1: none
};

struct Verdict {
  bool met = true;                 // every requirement
  std::string outcome;             // what came out, one line
  std::vector<Sentence> asked;     // what was asked: clips and hold, then one line per tag
  std::vector<Sentence> missed;    // one line per requirement that is missed, worst place
  std::vector<Sentence> why;       // terms that pull against each other there
  std::vector<Sentence> stopped;   // that the solver or the simulation did not finish
  std::vector<Sentence> compared;  // the clips as captured, the simulated run
  std::vector<Sentence> look;      // where to look first, and the price of the edit
};

// From report.json, of this or an older format: what the report lacks is left unsaid.
Verdict VerdictOf(const Json& report);

// The same as a list: outcome, asked, missed, why, stopped, compared, look.
std::vector<std::string> VerdictSentences(const Json& report);

}  // namespace retarget::report
