#include "model/settings.h"

#include <charconv>
#include <sstream>

#include "model/geometry/types.h"

namespace retarget {

std::string StagesText(const std::vector<double>& stages) {
  std::string text;
  for (const double factor : stages) {
    char number[32];
    const auto end = std::to_chars(number, number + sizeof number, factor).ptr;
    text += (text.empty() ? "" : " ") + std::string(number, end);
  }
  return text;
}

namespace {

[[noreturn]] void RefuseStages(const std::string& text) {
  throw InputError("solve.stages: \"" + text + "\" is not a list of factors that ends with 1");
}

}  // namespace

void CheckStages(const std::vector<double>& stages) {
  if (stages.empty() || stages.back() != 1) RefuseStages(StagesText(stages));
}

std::vector<double> ParseStages(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> stages;
  double factor;
  while (in >> factor) stages.push_back(factor);
  if (!in.eof() || stages.empty() || stages.back() != 1) RefuseStages(text);
  return stages;
}

double JointShare(const JointWeights& w, const std::string& link_name) {
  const size_t side = link_name.find('_');
  const std::string joint = side == std::string::npos ? link_name : link_name.substr(side + 1);
  if (joint == "root") return w.root;
  if (joint == "waist") return w.waist;
  if (joint == "chest") return w.chest;
  if (joint == "neck") return w.neck;
  if (joint == "head") return w.head;
  if (joint == "clavicle") return w.clavicle;
  if (joint == "shoulder") return w.shoulder;
  if (joint == "elbow") return w.elbow;
  if (joint == "wrist") return w.wrist;
  if (joint == "hip") return w.hip;
  if (joint == "knee") return w.knee;
  if (joint == "ankle") return w.ankle;
  return w.other;
}

}  // namespace retarget
