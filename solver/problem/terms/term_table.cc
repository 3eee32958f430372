#include "solver/problem/term_table.h"

#include "solver/problem/terms/foot_lock.h"
#include "solver/problem/terms/foot_swing.h"
#include "solver/problem/terms/ground.h"
#include "solver/problem/terms/hand_contact.h"
#include "solver/problem/terms/hold.h"
#include "solver/problem/terms/joint_limit.h"
#include "solver/problem/terms/penetration.h"
#include "solver/problem/terms/pose_tracking.h"
#include "solver/problem/terms/rig_turn.h"
#include "solver/problem/terms/root_tracking.h"
#include "solver/problem/terms/tangle.h"
#include "solver/problem/terms/tangle_aim.h"

namespace retarget::solver {

// The table of contents of the objective.
std::vector<WeightedTerm> MakeTerms(const Scene& scene, const Settings& settings) {
  const Weights& w = settings.weights;
  std::vector<WeightedTerm> terms;
  const auto add = [&](std::unique_ptr<Term> term, double weight) {
    terms.push_back({std::move(term), weight});
  };
  add(std::make_unique<PoseTracking>(scene, settings.joint_weights), w.pose_tracking);
  add(std::make_unique<RootTracking>(scene), w.root_tracking);
  add(std::make_unique<FootLock>(scene), w.foot_lock);
  add(std::make_unique<FootSwing>(scene), w.foot_swing);
  add(std::make_unique<HoldTerm>(), w.hold);
  add(std::make_unique<HandContactTerm>(settings.hand_contact.slide_m), w.hand_contact);
  add(std::make_unique<Penetration>(), w.penetration);
  add(std::make_unique<SelfPenetration>(scene), w.self_penetration);
  add(std::make_unique<Ground>(scene), w.ground);
  add(std::make_unique<TangleTerm>(scene), w.tangle);
  add(std::make_unique<TangleAim>(scene), w.tangle_aim);
  add(std::make_unique<JointLimitTerm>(), w.joint_limit);
  add(std::make_unique<RigTurn>(), w.rig_turn);
  return terms;
}

}  // namespace retarget::solver
