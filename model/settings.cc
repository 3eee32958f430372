#include "model/settings.h"

namespace retarget {

double JointShare(const JointWeights& w, const std::string& link_name) {
  const size_t side = link_name.find('_');
  const std::string joint = side == std::string::npos ? link_name : link_name.substr(side + 1);
  if (joint == "root") return 1;
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
