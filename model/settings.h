// Every number that a user can turn, with its default, unit and meaning in one table
// (VisitSettings). The YAML reader, `--set`, `retarget config` and the report all walk that table.
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

namespace retarget {

// Settings that are one of a few; kNamesOf has their texts, in the order of the values.
enum class Backend { kBanded, kCeres };
enum class Start { kSimulated, kTemplate, kBest };  // initial guess of the solve
enum class TangleForceKind { kElastic, kGli };

template <typename Enum>
inline constexpr auto kNamesOf = nullptr;
template <>
inline constexpr std::array kNamesOf<Backend> = {"banded", "ceres"};
template <>
inline constexpr std::array kNamesOf<Start> = {"simulated", "template", "best"};
template <>
inline constexpr std::array kNamesOf<TangleForceKind> = {"elastic", "gli"};

template <typename Enum>
requires std::is_enum_v<Enum>
const char* NameOf(Enum value) { return kNamesOf<Enum>[static_cast<size_t>(value)]; }

// Factors of the contact weights (solve.stages) as text, "0.03 0.1 0.3 1", and back. A list ends
// with 1: else ParseStages and CheckStages throw InputError.
std::string StagesText(const std::vector<double>& stages);
std::vector<double> ParseStages(const std::string& text);
void CheckStages(const std::vector<double>& stages);

// Weights of the residual terms: cost = 1/2 sum (weight * residual)^2, residuals in natural units.
struct Weights {
  double pose_tracking = 1;
  double root_tracking = 6;
  double smoothness = 10;
  double root_smoothness = 0;
  double foot_lock = 300;
  double foot_swing = 60;
  double hold = 60;
  double penetration = 60;
  double self_penetration = 60;
  double ground = 100;
  double tangle = 20;
  double tangle_aim = 8;
  double hand_contact = 30;
  double joint_limit = 10;
  double rig_turn = 100;
};

// Shares of weights.pose_tracking and of weights.smoothness, by joint group; that of the root is of
// smoothness alone.
struct JointWeights {
  double waist = 2, chest = 2, neck = 1, head = 1, clavicle = 1, shoulder = 0.7, elbow = 0.7,
         wrist = 0.7, hip = 1, knee = 1, ankle = 0.5, other = 0.3, root = 4;
};
// Share of the group that a link belongs to ("left_elbow" -> elbow).
double JointShare(const JointWeights& weights, const std::string& link_name);

struct TangleSettings {
  double margin = 0.05;  // turns over one half that a tag aims for
  double min_rho = 0.08;
  double min_rho_share = 0.3;
  int max_tags = 6;
};

// Hands that touch in the template (model/body/hand_contact.h).
struct HandContactSettings {
  double reach_m = 0.03;  // a hand no further from a surface touches it
  double slide_m = 0.04;  // that it may slide
};

// What a solved scene must show (docs/metrics.md).
struct Requirements {
  double gli = 0.5;  // turns, every tag, every instant
  int pass_throughs = 0;
  double penetration_m = 0.02;         // largest, between the bodies
  double penetration_1cm_percent = 1;  // share of frames over 1 cm
  double foot_drift_m = 0.01;
  double foot_travel_m = 0.06;         // near the floor in one swing, or ...
  double foot_travel_ratio = 2;        // ... this many times the source's, whichever is more
  double foot_acceleration = 30;       // m/s^2 where a contact begins or ends, or ...
  double foot_acceleration_ratio = 2;  // ... this many times the source's
  double floor_m = 0.01;
  double hold_m = 0.02;
  double segment_length_percent = 0.5;  // largest change of a segment as it is written
  double write_back_m = 0.005;          // of the written rig from the scene
  // What no result may ask of a person, whatever the template (group `plausible`).
  struct Plausible {
    double pose_error_m = 0.25;  // mean over the nodes of no tagged path, of any frame
    double trunk_tilt_deg = 45;
    double floating_m = 0.05;
    double joint_limit_deg = 10;  // beyond a joint's range
    double jerk_ratio = 4;
  } plausible;
};

struct SolveSettings {
  Backend backend = Backend::kBanded;
  Start start = Start::kSimulated;
  int threads = 0;                  // 0: all cores
  int max_iterations = 120;         // over all stages
  double max_seconds = 0;           // 0: no limit
  double relative_decrease = 3e-3;  // of the cost; twice in a row ends a stage
  double polish_decrease = 1e-3;    // the same for the last stage
  double step_limit_m = 0.10;       // no node moves further in one iteration
  double gli_jump = 0.4;            // turns; a larger jump of a segment pair is a pass-through
  double initial_damping = 1e-3;    // of Levenberg-Marquardt, times diag(J^T J)
  std::vector<double> stages = {0.1, 1};  // factors of the contact weights, warm started; the last
                                          // is 1
};

struct ContactSettings {
  double speed = 0.15;        // m/s: a planted node is slower
  double height = 0.03;       // m over the node's 5th percentile
  double max_gap_s = 0.1;     // gaps shorter than this are closed
  double min_length_s = 0.2;  // then runs shorter than this are dropped
};

// The forward simulation (solver/simulation): baseline, and one of the starts.
struct SimulationSettings {
  double time_step = 0.004;            // s
  double gravity = 9.81;               // m/s^2
  double stiffness = 600;              // N m/rad, of the joints' control towards the capture
  double damping = 0.1;                // s, of the same: damping over stiffness
  double armature = 0.02;              // kg m^2, added to every joint's inertia
  double root_stiffness = 10000;       // N/m, of the roots' control
  double root_turn_stiffness = 1500;   // N m/rad, of the same
  double root_height_stiffness = 1e5;  // N/m, of the same in height, against all loads
  double root_damping = 0.1;           // s, of the same: damping over stiffness
  double friction = 1;
  double contact_time = 0.01;  // s: contacts give way for about this long
  double tie_time = 0.01;      // s, the same of holds and planted feet
  TangleForceKind tangle_force = TangleForceKind::kElastic;
  double tangle_stiffness = 400;      // N/m, of the elastic pull
  double tangle_max_force = 150;      // N
  double tangle_slack_m = 0;          // gap that the pull leaves
  double tangle_gli_stiffness = 100;  // J/turn^2, of the pull along the GLI's gradient
  double settle_max_s = 3;
  double settle_speed = 0.02;  // m/s: at rest, every node is slower
  JointWeights gains{1, 1, 1, 1, 1, 0.5, 0.3, 0.1, 1.5, 1.5, 0.8, 0.3};
};

struct Settings {
  Weights weights;
  JointWeights joint_weights;
  TangleSettings tangle;
  HandContactSettings hand_contact;
  Requirements requirements;
  SolveSettings solve;
  ContactSettings contact;
  SimulationSettings simulation;
};

// What is written of a setting: the number itself, or its text.
template <typename T>
auto Written(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    return value;
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(NameOf(value));
  } else {
    return StagesText(value);
  }
}

// Calls visit(key, value&, unit, meaning, least, most) for every setting, in order; `value` is a
// double, int, enum (of kNamesOf) or std::vector<double>. The range is of numbers only.
template <typename SettingsT, typename Visitor>
void VisitSettings(SettingsT& s, Visitor&& visit) {
  const double kMax = 1e6;
  auto& w = s.weights;
  visit("weights.pose_tracking", w.pose_tracking, "1/rad", "joint rotations stay as captured", 0,
        kMax);
  visit("weights.root_tracking", w.root_tracking, "1/m, 1/rad",
        "root stays with its placed clip, or with its partner", 0, kMax);
  visit("weights.smoothness", w.smoothness, "1/rad",
        "the edit changes evenly: its second difference, per (1/30 s)^2", 0, kMax);
  visit("weights.root_smoothness", w.root_smoothness, "1/m, 1/rad",
        "more of the same for the roots alone", 0, kMax);
  visit("weights.foot_lock", w.foot_lock, "1/m", "planted feet stay where they are", 0, kMax);
  visit("weights.foot_swing", w.foot_swing, "1/m",
        "free feet near the floor move along the path of the capture", 0, kMax);
  visit("weights.hold", w.hold, "1/m, 1/rad", "hands hold what the template holds", 0, kMax);
  visit("weights.penetration", w.penetration, "1/m", "the bodies do not overlap", 0, kMax);
  visit("weights.self_penetration", w.self_penetration, "1/m",
        "no body overlaps itself more than captured", 0, kMax);
  visit("weights.ground", w.ground, "1/m", "nothing below the floor", 0, kMax);
  visit("weights.tangle", w.tangle, "1/turn", "tagged tangles stay above one half", 0, kMax);
  visit("weights.tangle_aim", w.tangle_aim, "1/turn",
        "tagged tangles are drawn to their value in the template", 0, kMax);
  visit("weights.hand_contact", w.hand_contact, "1/m",
        "hands touch what they touch in the template", 0, kMax);
  visit("weights.joint_limit", w.joint_limit, "1/rad",
        "joints bend no further than the limit or the capture", 0, kMax);
  visit("weights.rig_turn", w.rig_turn, "1/rad",
        "joints turn only as the clip's own rig can, where that has fewer axes", 0, kMax);
  auto& j = s.joint_weights;
  visit("joint_weights.waist", j.waist, "", "share of pose_tracking and smoothness", 0, kMax);
  visit("joint_weights.chest", j.chest, "", "the same", 0, kMax);
  visit("joint_weights.neck", j.neck, "", "the same", 0, kMax);
  visit("joint_weights.head", j.head, "", "the same", 0, kMax);
  visit("joint_weights.clavicle", j.clavicle, "", "the same", 0, kMax);
  visit("joint_weights.shoulder", j.shoulder, "", "the same", 0, kMax);
  visit("joint_weights.elbow", j.elbow, "", "the same", 0, kMax);
  visit("joint_weights.wrist", j.wrist, "", "the same", 0, kMax);
  visit("joint_weights.hip", j.hip, "", "the same", 0, kMax);
  visit("joint_weights.knee", j.knee, "", "the same", 0, kMax);
  visit("joint_weights.ankle", j.ankle, "", "the same", 0, kMax);
  visit("joint_weights.other", j.other, "", "joints of a larger body table", 0, kMax);
  visit("joint_weights.root", j.root, "", "the root's share of smoothness", 0, kMax);
  auto& t = s.tangle;
  visit("tangle.margin", t.margin, "turns",
        "a tag aims this far over one half (never over the template)", 0, 0.5);
  visit("tangle.min_rho", t.min_rho, "rad, m", "weaker tangles are not tagged", 0, 10);
  visit("tangle.min_rho_share", t.min_rho_share, "",
        "nor those this much weaker than the most robust", 0, 1);
  visit("tangle.max_tags", t.max_tags, "", "largest number of tags", 1, 100);
  auto& hand = s.hand_contact;
  visit("hand_contact.reach_m", hand.reach_m, "m",
        "a hand no further from a surface of the partner in the template touches it", 0, 1);
  visit("hand_contact.slide_m", hand.slide_m, "m", "that a touching hand may slide", 0, 1);
  auto& r = s.requirements;
  visit("requirements.gli", r.gli, "turns", "every tag, signed, at every instant", 0, 2);
  visit("requirements.pass_throughs", r.pass_throughs, "", "limbs that went through limbs", 0,
        1000000);
  visit("requirements.penetration_m", r.penetration_m, "m", "largest depth between the bodies", 0,
        1);
  visit("requirements.penetration_1cm_percent", r.penetration_1cm_percent, "%",
        "share of frames over 1 cm", 0, 100);
  visit("requirements.foot_drift_m", r.foot_drift_m, "m",
        "of a planted node from where its contact began", 0, 1);
  visit("requirements.foot_travel_m", r.foot_travel_m, "m",
        "of a free foot near the floor in one swing, or:", 0, 10);
  visit("requirements.foot_travel_ratio", r.foot_travel_ratio, "",
        "the same, times the source's, whichever is more", 0, kMax);
  visit("requirements.foot_acceleration", r.foot_acceleration, "m/s^2",
        "of a foot where a contact begins or ends, or:", 0, kMax);
  visit("requirements.foot_acceleration_ratio", r.foot_acceleration_ratio, "",
        "the same, times the source's, whichever is more", 0, kMax);
  visit("requirements.floor_m", r.floor_m, "m", "deepest point below the floor", 0, 1);
  visit("requirements.hold_m", r.hold_m, "m", "largest distance of held points", 0, 1);
  visit("requirements.segment_length_percent", r.segment_length_percent, "%",
        "largest change of a segment's length", 0, 100);
  visit("requirements.write_back_m", r.write_back_m, "m",
        "largest distance of the written rig's joints to the scene's", 0, 1);
  auto& p = r.plausible;
  visit("plausible.pose_error_m", p.pose_error_m, "m",
        "of any frame from its clip, mean over the nodes of no tagged path", 0, 10);
  visit("plausible.trunk_tilt_deg", p.trunk_tilt_deg, "deg",
        "of the trunk from its clip, of a figure that is not carried", 0, 180);
  visit("plausible.floating_m", p.floating_m, "m",
        "over the floor, or over its clip, of a figure that is not carried", 0, 10);
  visit("plausible.joint_limit_deg", p.joint_limit_deg, "deg",
        "beyond the end of a joint's range, or its clip's own value", 0, 180);
  visit("plausible.jerk_ratio", p.jerk_ratio, "", "mean jerk, to that of its own clip", 0, kMax);
  auto& v = s.solve;
  visit("solve.backend", v.backend, "", "linear algebra of the clip's solve", 0, 0);
  visit("solve.start", v.start, "", "initial guess; best: solve from both, keep the better", 0, 0);
  visit("solve.threads", v.threads, "", "0: all cores", 0, 256);
  visit("solve.max_iterations", v.max_iterations, "", "over all stages", 1, 100000);
  visit("solve.max_seconds", v.max_seconds, "s", "0: no limit", 0, kMax);
  visit("solve.relative_decrease", v.relative_decrease, "",
        "of the cost; twice in a row ends a stage", 0, 1);
  visit("solve.polish_decrease", v.polish_decrease, "", "the same for the last stage", 0, 1);
  visit("solve.step_limit_m", v.step_limit_m, "m", "no node moves further in one iteration", 1e-4,
        10);
  visit("solve.gli_jump", v.gli_jump, "turns", "a larger jump of a segment pair rejects the step",
        0.05, 2);
  visit("solve.initial_damping", v.initial_damping, "", "of Levenberg-Marquardt, times diag(J^T J)",
        1e-12, kMax);
  visit("solve.stages", v.stages, "",
        "factors of the contact weights, warm started one after the other", 0, 0);
  auto& c = s.contact;
  visit("contact.speed", c.speed, "m/s", "a planted node is slower", 0, 10);
  visit("contact.height", c.height, "m", "over the node's 5th percentile", 0, 1);
  visit("contact.max_gap_s", c.max_gap_s, "s", "shorter gaps are closed", 0, 10);
  visit("contact.min_length_s", c.min_length_s, "s", "then shorter runs are dropped", 0, 10);
  auto& m = s.simulation;
  visit("simulation.time_step", m.time_step, "s", "of the physics", 1e-4, 0.02);
  visit("simulation.gravity", m.gravity, "m/s^2", "downwards", 0, 100);
  visit("simulation.stiffness", m.stiffness, "N m/rad", "joints turn towards the capture", 0, kMax);
  visit("simulation.damping", m.damping, "s", "of the same, over its stiffness", 0, 10);
  visit("simulation.armature", m.armature, "kg m^2", "added to every joint's inertia", 0, 10);
  visit("simulation.root_stiffness", m.root_stiffness, "N/m",
        "roots move towards the capture, or to their place on the partner", 0, kMax);
  visit("simulation.root_turn_stiffness", m.root_turn_stiffness, "N m/rad", "roots turn likewise",
        0, kMax);
  visit("simulation.root_height_stiffness", m.root_height_stiffness, "N/m",
        "roots keep the height of the capture", 0, kMax);
  visit("simulation.root_damping", m.root_damping, "s", "of the same, over its stiffness", 0, 10);
  visit("simulation.friction", m.friction, "", "of figures and floor", 0, 10);
  visit("simulation.contact_time", m.contact_time, "s", "contacts give way for about this long",
        1e-3, 1);
  visit("simulation.tie_time", m.tie_time, "s", "the same of holds and planted feet", 1e-3, 1);
  visit("simulation.tangle_force", m.tangle_force, "",
        "elastic: pull between crossing segments; gli: along the gradient of the tag", 0, 0);
  visit("simulation.tangle_stiffness", m.tangle_stiffness, "N/m", "of the elastic pull", 0, kMax);
  visit("simulation.tangle_max_force", m.tangle_max_force, "N", "of the elastic pull", 0, kMax);
  visit("simulation.tangle_slack_m", m.tangle_slack_m, "m", "gap that the elastic pull leaves", 0,
        1);
  visit("simulation.tangle_gli_stiffness", m.tangle_gli_stiffness, "J/turn^2",
        "of the pull along the gradient", 0, kMax);
  visit("simulation.settle_max_s", m.settle_max_s, "s", "longest time to come to rest", 0, 60);
  visit("simulation.settle_speed", m.settle_speed, "m/s", "at rest every node is slower", 0, 10);
  auto& g = m.gains;
  visit("simulation.gain_waist", g.waist, "", "share of simulation.stiffness", 0, kMax);
  visit("simulation.gain_chest", g.chest, "", "the same", 0, kMax);
  visit("simulation.gain_neck", g.neck, "", "the same", 0, kMax);
  visit("simulation.gain_head", g.head, "", "the same", 0, kMax);
  visit("simulation.gain_clavicle", g.clavicle, "", "the same", 0, kMax);
  visit("simulation.gain_shoulder", g.shoulder, "", "the same", 0, kMax);
  visit("simulation.gain_elbow", g.elbow, "", "the same", 0, kMax);
  visit("simulation.gain_wrist", g.wrist, "", "the same", 0, kMax);
  visit("simulation.gain_hip", g.hip, "", "the same", 0, kMax);
  visit("simulation.gain_knee", g.knee, "", "the same", 0, kMax);
  visit("simulation.gain_ankle", g.ankle, "", "the same", 0, kMax);
  visit("simulation.gain_other", g.other, "", "joints of a larger body table", 0, kMax);
}

}  // namespace retarget
