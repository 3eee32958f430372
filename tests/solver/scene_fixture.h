// A small two-figure scene with everything in it, for tests of terms and solvers: a hugs b from
// behind with hands that nearly meet, both overlap a little, feet are planted.
#pragma once

#include <random>

#include "model/geometry/so3.h"
#include "solver/problem/scene.h"
#include "solver/start/fit_template.h"

namespace retarget::solver {

inline Quat Turn(double x_deg, double y_deg, double z_deg) {
  return ExpSo3(Vec3(x_deg, y_deg, z_deg) * kDegree);
}

// A hug from behind, roughly posed: a's arms go under b's and meet before b's chest.
inline TemplatePosture RoughHug(const Body& a, const Body& b) {
  TemplatePosture posture;
  posture.name = "rough hug";
  posture.body = {a, b};
  posture.pose = {RestPose(a), RestPose(b)};
  Pose& pa = posture.pose[0];
  Pose& pb = posture.pose[1];
  pa.root_position = Vec3(0, 0.52 * a.stature, -0.30);
  pb.root_position = Vec3(0, 0.56 * b.stature, 0);
  const auto set = [](const Body& body, Pose* pose, const std::string& link, const Quat& q) {
    pose->rotation[body.FindLink(link)] = q;
  };
  for (const double x : {1.0, -1.0}) {
    const std::string side = x > 0 ? "left" : "right";
    set(a, &pa, side + "_shoulder", Turn(0, -50 * x, -35 * x));
    set(a, &pa, side + "_elbow", Turn(0, -75 * x, 0));
    set(a, &pa, side + "_hip", Turn(-20, 0, 0));
    set(a, &pa, side + "_knee", Turn(35, 0, 0));
    set(b, &pb, side + "_shoulder", Turn(0, -10 * x, -50 * x));
    set(b, &pb, side + "_elbow", Turn(0, -35 * x, 0));
    set(b, &pb, side + "_knee", Turn(5, 0, 0));
  }
  posture.supports = {StandingNodes(a, PoseBody(a, pa)), StandingNodes(b, PoseBody(b, pb))};
  return posture;
}

// Small smooth motions about the template, random but seeded.
inline Clip Fidget(const Body& body, const Pose& pose, int frames, double fps, unsigned seed,
                   double size_rad) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> axis, phase;
  for (size_t l = 0; l < body.links.size(); ++l) {
    axis.emplace_back(uniform(random), uniform(random), uniform(random));
    phase.emplace_back(uniform(random), uniform(random), uniform(random));
  }
  Clip clip;
  clip.fps = fps;
  for (int t = 0; t < frames; ++t) {
    Pose p = pose;
    for (size_t l = 0; l < body.links.size(); ++l) {
      Vec3 v;
      for (int k = 0; k < 3; ++k) v[k] = axis[l][k] * std::sin(4 * t / fps + 3 * phase[l][k]);
      p.rotation[l] = p.rotation[l] * ExpSo3(size_rad * v);
    }
    p.root_position += 0.1 * size_rad * Vec3(std::sin(2 * t / fps), 0, std::cos(2 * t / fps));
    clip.frames.push_back(p);
  }
  return clip;
}

// A matrix of numbers evenly distributed over [-1, 1].
inline MatX RandomMatrix(long rows, long columns, std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  MatX out(rows, columns);
  for (long i = 0; i < out.size(); ++i) out(i) = uniform(*random);
  return out;
}

// A scene of `frames` frames. Some feet are planted for parts of it, one figure may follow.
inline Scene SmallScene(int frames, double size_rad, bool follow = false) {
  Scene scene;
  scene.body = {StandardBody(AverageMeasures(1.80)), StandardBody(AverageMeasures(1.70))};
  scene.posture = RoughHug(scene.body[0], scene.body[1]);
  for (int f = 0; f < 2; ++f) {
    scene.source[f] = Fidget(scene.body[f], scene.posture.pose[f], frames, 30, 7 + f, size_rad);
    const int ankle = scene.body[f].FindNode("left_ankle"),
              toe = scene.body[f].FindNode("right_toe");
    scene.contacts[f] = {{ankle, 0, frames / 2}, {toe, frames / 3, frames - 1}};
  }
  if (follow) scene.root[0] = RootReference::kPartner;
  const TemplateTangles tangles = FindTemplateTangles(scene.posture, {});
  scene.tangles = TangleTargets(tangles.tags, scene.posture, 0.05);
  // Holds that ask for a little more than the posture shows, so that there is something to solve.
  const std::array<PosedBody, 2> posed = {PoseBody(scene.body[0], scene.posture.pose[0]),
                                          PoseBody(scene.body[1], scene.posture.pose[1])};
  Hold hands;
  hands.from = {0, scene.body[0].FindNode("left_hand"), Vec3(0.01, 0, 0)};
  hands.to = {0, scene.body[0].FindNode("right_wrist"), Vec3::Zero()};
  const Mat3& from = posed[0].rotation[scene.body[0].nodes[hands.from.node].link];
  const Mat3& to = posed[0].rotation[scene.body[0].nodes[hands.to.node].link];
  hands.to.offset =
      to.transpose() * (posed[0].node[hands.from.node] - posed[0].node[hands.to.node]) +
      Vec3(0.01, -0.02, 0.01);
  hands.rotation = true;
  hands.relative_rotation = Quat(to.transpose() * from) * Turn(6, 4, -5);
  Hold to_world;
  to_world.from = {1, scene.body[1].FindNode("head_top"), Vec3::Zero()};
  to_world.to = {kWorld, 0, posed[1].node[to_world.from.node] + Vec3(0.02, -0.01, 0.02)};
  scene.holds = {hands, to_world};
  return scene;
}

}  // namespace retarget::solver
