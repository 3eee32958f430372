#include "solver/simulation/physics_world.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <stdexcept>

namespace retarget::solver {
namespace {

constexpr double kMostSpeed = 100;  // m/s or rad/s of a coordinate: the run has come apart

void Throw(const char* message) { throw std::runtime_error(message); }

// MuJoCo's own handlers end the process and write a log file into the current folder.
void TakeOverMessages() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_error = Throw;
    mju_user_warning = [](const char*) {};  // counted in mjData::warning, see IsStable()
  });
}

mjModel* LoadModel(const std::string& mjcf) {
  TakeOverMessages();
  const auto files = std::make_unique<mjVFS>();  // 2 MB: not for the stack
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "figures.xml", static_cast<int>(mjcf.size()));
  const int file = mj_findFileVFS(files.get(), "figures.xml");
  std::memcpy(files->filedata[file], mjcf.data(), mjcf.size());
  char error[500] = "";
  mjModel* model = mj_loadXML("figures.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (model == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + error);
  return model;
}

Vec3 VectorAt(const mjtNum* p) { return Vec3(p[0], p[1], p[2]); }
Quat QuaternionAt(const mjtNum* p) { return Quat(p[0], p[1], p[2], p[3]); }
void Store(const Vec3& v, mjtNum* p) { std::copy(v.data(), v.data() + 3, p); }
void Store(const Quat& q, mjtNum* p) { p[0] = q.w(), p[1] = q.x(), p[2] = q.y(), p[3] = q.z(); }

}  // namespace

struct PhysicsWorld::Engine {
  std::vector<Body> body;
  std::unique_ptr<mjModel, void (*)(mjModel*)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data{nullptr, mj_deleteData};
  std::vector<std::vector<int>> body_id, position, velocity;  // [figure][link]
  std::vector<int> tie;

  void Index() {
    for (size_t f = 0; f < body.size(); ++f) {
      body_id.emplace_back();
      position.emplace_back();
      velocity.emplace_back();
      for (int l = 0; l < body[f].num_links(); ++l) {
        const std::string name = LinkName(static_cast<int>(f), l);
        const int joint = mj_name2id(model.get(), mjOBJ_JOINT, name.c_str());
        body_id[f].push_back(mj_name2id(model.get(), mjOBJ_BODY, name.c_str()));
        position[f].push_back(model->jnt_qposadr[joint]);
        velocity[f].push_back(model->jnt_dofadr[joint]);
      }
    }
  }

  void Apply(int figure, int link, const Vec3& point, const Vec3& force, const Vec3& torque) {
    mj_applyFT(model.get(), data.get(), force.data(), torque.data(), point.data(),
               body_id[figure][link], data->qfrc_applied);
  }

  // Sum of m (x x v) and spin over all bodies about the origin, and of m v.
  void Momentum(Vec3* linear, Vec3* angular) const {
    *linear = *angular = Vec3::Zero();
    for (size_t f = 0; f < body.size(); ++f) {
      for (const int b : body_id[f]) {
        mjtNum twist[6];  // angular, then linear, at the centre of mass, in world axes
        mj_objectVelocity(model.get(), data.get(), mjOBJ_BODY, b, twist, 0);
        const Vec3 omega = VectorAt(twist), v = VectorAt(twist + 3);
        const Vec3 centre = VectorAt(data->xipos + 3 * b);
        const Mat3 axes =
            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data->ximat + 9 * b);
        const Vec3 inertia = VectorAt(model->body_inertia + 3 * b);
        *linear += model->body_mass[b] * v;
        *angular += model->body_mass[b] * centre.cross(v) +
                    axes * inertia.asDiagonal() * axes.transpose() * omega;
      }
    }
  }
};

PhysicsWorld::PhysicsWorld(const std::vector<PhysicsFigure>& figures,
                           const std::vector<EqualityConstraint>& ties,
                           const PhysicsOptions& options)
    : engine_(std::make_unique<Engine>()) {
  for (const PhysicsFigure& figure : figures) engine_->body.push_back(figure.body);
  engine_->model.reset(LoadModel(FormatMjcf(figures, ties, options)));
  engine_->data.reset(mj_makeData(engine_->model.get()));
  if (!engine_->data) throw std::runtime_error("MuJoCo: out of memory");
  engine_->Index();
  for (size_t f = 0; f < figures.size(); ++f) {
    // MJCF knows one damping for all six of a free joint.
    mjtNum* damping = engine_->model->dof_damping + engine_->velocity[f][0];
    std::fill(damping, damping + 3, figures[f].root_damping);
    damping[1] = figures[f].root_height_damping;
    std::fill(damping + 3, damping + 6, figures[f].damping[0]);
  }
  for (size_t k = 0; k < ties.size(); ++k) {
    engine_->tie.push_back(
        mj_name2id(engine_->model.get(), mjOBJ_EQUALITY, TieName(static_cast<int>(k)).c_str()));
  }
}

PhysicsWorld::~PhysicsWorld() = default;
PhysicsWorld::PhysicsWorld(PhysicsWorld&&) noexcept = default;

double PhysicsWorld::time_step() const { return engine_->model->opt.timestep; }

void PhysicsWorld::SetPose(int figure, const Pose& pose) {
  const Engine& e = *engine_;
  Store(pose.root_position, e.data->qpos + e.position[figure][0]);
  Store(pose.rotation[0], e.data->qpos + e.position[figure][0] + 3);
  for (size_t l = 1; l < pose.rotation.size(); ++l) {
    Store(pose.rotation[l], e.data->qpos + e.position[figure][l]);
  }
  SetVelocity(figure, Vec3::Zero(), std::vector<Vec3>(pose.rotation.size(), Vec3::Zero()));
}

void PhysicsWorld::SetVelocity(int figure, const Vec3& root, const std::vector<Vec3>& joint) {
  const Engine& e = *engine_;
  Store(root, e.data->qvel + e.velocity[figure][0]);
  Store(joint[0], e.data->qvel + e.velocity[figure][0] + 3);
  for (size_t l = 1; l < joint.size(); ++l) {
    Store(joint[l], e.data->qvel + e.velocity[figure][l]);
  }
  // What the constraint solver starts from belongs to the motion before.
  mju_zero(e.data->qacc_warmstart, e.model->nv);
}

Pose PhysicsWorld::PoseOf(int figure) const {
  const Engine& e = *engine_;
  Pose pose;
  pose.root_position = VectorAt(e.data->qpos + e.position[figure][0]);
  pose.rotation.push_back(QuaternionAt(e.data->qpos + e.position[figure][0] + 3).normalized());
  for (size_t l = 1; l < e.position[figure].size(); ++l) {
    pose.rotation.push_back(QuaternionAt(e.data->qpos + e.position[figure][l]).normalized());
  }
  return pose;
}

Vec3 PhysicsWorld::RootVelocity(int figure) const {
  return VectorAt(engine_->data->qvel + engine_->velocity[figure][0]);
}

Vec3 PhysicsWorld::JointVelocity(int figure, int link) const {
  const int at = engine_->velocity[figure][link] + (link == 0 ? 3 : 0);
  return VectorAt(engine_->data->qvel + at);
}

void PhysicsWorld::UpdateKinematics() {
  mj_kinematics(engine_->model.get(), engine_->data.get());
  mj_comPos(engine_->model.get(), engine_->data.get());
}

PosedBody PhysicsWorld::Posed(int figure) const {
  const Engine& e = *engine_;
  const Body& body = e.body[figure];
  PosedBody posed;
  for (const int b : e.body_id[figure]) {
    posed.centre.push_back(VectorAt(e.data->xpos + 3 * b));
    posed.rotation.emplace_back(
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(e.data->xmat + 9 * b));
  }
  for (const Node& node : body.nodes) {
    posed.node.push_back(posed.centre[node.link] + posed.rotation[node.link] * node.offset);
  }
  return posed;
}

void PhysicsWorld::EnableEquality(int tie, const Vec3& point, const Vec3& to_point,
                                  const Quat& relative) {
  const Engine& e = *engine_;
  const int id = e.tie[tie];
  mjtNum* value = e.model->eq_data + mjNEQDATA * id;
  if (e.model->eq_type[id] == mjEQ_WELD) {
    // Anchor in the second body, the same point in the first, the second's turn in the first.
    Store(to_point, value);
    Store(point, value + 3);
    Store(relative.conjugate(), value + 6);
  } else {
    Store(point, value);
    Store(to_point, value + 3);
  }
  e.model->eq_active[id] = 1;
}

void PhysicsWorld::DisableEquality(int tie) { engine_->model->eq_active[engine_->tie[tie]] = 0; }

void PhysicsWorld::SetFloorContact(int figure, int node, bool collides) {
  const Engine& e = *engine_;
  const int geom = mj_name2id(e.model.get(), mjOBJ_GEOM, SegmentName(figure, node).c_str());
  int& bits = e.model->geom_conaffinity[geom];
  bits = collides ? bits | kFloorBit : bits & ~kFloorBit;
}

void PhysicsWorld::BeginStep() {
  mju_zero(engine_->data->qfrc_applied, engine_->model->nv);
  mj_step1(engine_->model.get(), engine_->data.get());
}

void PhysicsWorld::AddForce(int figure, int link, const Vec3& world_point, const Vec3& force) {
  engine_->Apply(figure, link, world_point, force, Vec3::Zero());
}

void PhysicsWorld::AddTorque(int figure, int link, const Vec3& torque) {
  const Vec3 origin = VectorAt(engine_->data->xpos + 3 * engine_->body_id[figure][link]);
  engine_->Apply(figure, link, origin, Vec3::Zero(), torque);
}

void PhysicsWorld::AddJointTorque(int figure, int link, const Vec3& torque) {
  Eigen::Map<Vec3>(engine_->data->qfrc_applied + engine_->velocity[figure][link] +
                   (link == 0 ? 3 : 0)) += torque;
}

void PhysicsWorld::EndStep() { mj_step2(engine_->model.get(), engine_->data.get()); }

double PhysicsWorld::Energy() const {
  mj_energyPos(engine_->model.get(), engine_->data.get());
  mj_energyVel(engine_->model.get(), engine_->data.get());
  return engine_->data->energy[0] + engine_->data->energy[1];
}

Vec3 PhysicsWorld::LinearMomentum() const {
  Vec3 linear, angular;
  engine_->Momentum(&linear, &angular);
  return linear;
}

Vec3 PhysicsWorld::AngularMomentum() const {
  Vec3 linear, angular;
  engine_->Momentum(&linear, &angular);
  return angular;
}

double PhysicsWorld::Mass() const { return mj_getTotalmass(engine_->model.get()); }

bool PhysicsWorld::IsStable() const {
  const mjData& d = *engine_->data;
  for (const int kind : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (d.warning[kind].number > 0) return false;
  }
  for (int k = 0; k < engine_->model->nv; ++k) {
    if (!(std::abs(d.qvel[k]) < kMostSpeed)) return false;
  }
  return true;
}

}  // namespace retarget::solver
