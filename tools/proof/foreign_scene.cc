#include "tools/proof/foreign_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/load_clip.h"
#include "io/text/read_file.h"
#include "solver/start/fit_template.h"
#include "tools/report/measured_scene.h"

namespace retarget::proof {
namespace {

// Tags and holds of the template. `holds` are those of the template on the scene's bodies.
void TakeTemplate(const TemplatePosture& posture, const std::vector<Hold>& holds,
                  const TangleSettings& tangle, ForeignScene* scene) {
  for (int f = 0; f < 2; ++f) {
    if (scene->subject.body[f].num_nodes() == posture.body[f].num_nodes()) continue;
    throw InputError(fmt::format("the template's figure {} has {} nodes, the scene's {}",
                                 report::kFigure[f], posture.body[f].num_nodes(),
                                 scene->subject.body[f].num_nodes()));
  }
  scene->subject.tangles = solver::TangleTargets(solver::FindTemplateTangles(posture, tangle).tags,
                                                 posture, tangle.margin);
  for (const Hold& hold : holds) {
    if (hold.from.figure == kWorld || hold.to.figure == kWorld) {
      scene->notes.push_back("a hold to the world is not judged: the scene stands elsewhere");
    } else {
      scene->subject.holds.push_back(hold);
    }
  }
  scene->notes.push_back("planted feet are not judged: no capture says when they are planted");
}

// Lengths at the first key.
void MeasureLengths(ForeignScene* scene) {
  KeyedPosture posture;
  std::vector<int> all = scene->node[0];
  all.insert(all.end(), scene->node[1].begin(), scene->node[1].end());
  PlaceNodes(scene->motion, WithAncestors(scene->motion, all), 0, 0, &posture);
  for (int f = 0; f < 2; ++f) {
    const Body& body = scene->subject.body[f];
    scene->subject.length[f].assign(body.nodes.size(), 0);
    for (int n = 1; n < body.num_nodes(); ++n) {
      scene->subject.length[f][n] =
          (posture.origin[scene->node[f][n]] - posture.origin[scene->node[f][body.nodes[n].parent]])
              .norm();
    }
  }
}

// Instants of either within what both last, each once.
std::vector<double> SharedKeys(const std::array<io::LoadedClip, 2>& clip) {
  std::array<std::vector<double>, 2> times;
  for (int f = 0; f < 2; ++f) {
    const RigMotion& motion = clip[f].file.motion;
    const auto* gltf = std::get_if<io::GltfClip>(&clip[f].file.original);
    const double begin = gltf && !gltf->key_times.empty() ? gltf->key_times[0] : 0;
    for (int k = 0; k < motion.num_frames(); ++k) times[f].push_back(begin + k * motion.frame_time);
  }
  const double first = std::max(times[0].front(), times[1].front());
  const double last = std::min(times[0].back(), times[1].back());
  std::vector<double> keys = times[0];
  keys.insert(keys.end(), times[1].begin(), times[1].end());
  std::sort(keys.begin(), keys.end());
  const double grain =
      1e-3 * std::min(clip[0].file.motion.frame_time, clip[1].file.motion.frame_time);
  std::vector<double> out;
  for (const double t : keys) {
    if (t < first - grain || t > last + grain) continue;
    if (out.empty() || t > out.back() + grain) out.push_back(t);
  }
  if (out.empty()) throw InputError("the two figures have no instant in common");
  return out;
}

// Adds a rig with its motion, in metres and Y up, and finds the body's nodes in it.
class RigAdder {
 public:
  RigAdder(const io::LoadedClip& clip, ForeignScene* scene)
      : clip_(clip), motion_(scene->motion), nodes_(scene->motion.nodes) {}

  // Ids of the body's nodes.
  std::vector<int> Run() {
    KeyedNode world;
    if (clip_.facts.up == 'z') {
      world.rotation = Quat(Eigen::AngleAxisd(-kPi / 2, Vec3::UnitX()));
    }
    nodes_.push_back(world);
    const int top = static_cast<int>(nodes_.size()) - 1;
    const Rig& rig = clip_.file.motion.rig;
    first_ = top + 1;
    for (int j = 0; j < rig.num_joints(); ++j) {
      KeyedNode node;
      node.parent = rig.joints[j].parent < 0 ? top : first_ + rig.joints[j].parent;
      nodes_.push_back(node);
    }
    AddTracks();
    return FindNodes();
  }

  // An offset in the frame of the link that carries a node, in the frame that the scene has there.
  Vec3 OffsetAt(int id, int node, const Vec3& offset) const {
    const Vec3 world = body_at_start_.rotation[clip_.body.nodes[node].link] * offset;
    // The frame that carries it: of the parent, or of a topmost joint its own.
    const int joint = nodes_[id].parent < first_ ? id - first_ : nodes_[id].parent - first_;
    return (UpTurn() * rig_at_start_.rotation[joint]).conjugate() * world;
  }

 private:
  Quat UpTurn() const { return nodes_[first_ - 1].rotation; }

  void AddTracks() {
    const RigMotion& motion = clip_.file.motion;
    const auto* gltf = std::get_if<io::GltfClip>(&clip_.file.original);
    const double begin = gltf && !gltf->key_times.empty() ? gltf->key_times[0] : 0;
    std::vector<RigFrame> frames;
    for (const double t : motion_.key_times) frames.push_back(SampleRig(motion, t - begin));
    for (int j = 0; j < motion.rig.num_joints(); ++j) {
      KeyedNode& node = nodes_[first_ + j];
      std::vector<Vec3> translation;
      std::vector<Quat> rotation;
      for (const RigFrame& frame : frames) {
        translation.push_back(frame.translation[j] * clip_.facts.metres_per_unit);
        rotation.push_back(frame.rotation[j].normalized());
      }
      node.translation = translation[0];
      node.rotation_track = static_cast<int>(motion_.rotation_tracks.size());
      motion_.rotation_tracks.push_back(std::move(rotation));
      const bool moves = std::any_of(translation.begin(), translation.end(),
                                     [&](const Vec3& t) { return t != translation[0]; });
      if (!moves) continue;
      node.translation_track = static_cast<int>(motion_.translation_tracks.size());
      motion_.translation_tracks.push_back(std::move(translation));
    }
    rig_at_start_ = PoseRig(motion.rig, frames[0]);
    body_at_start_ = PoseBody(clip_.body, clip_.binding->PoseOf(frames[0]));
  }

  std::vector<int> FindNodes() {
    const Body& body = clip_.body;
    std::vector<int> ids;
    for (int n = 0; n < body.num_nodes(); ++n) {
      int joint = clip_.binding->JointAtNode(n);
      if (joint >= 0) {
        ids.push_back(first_ + joint);
        continue;
      }
      // No joint stands there: a place fixed in the next joint above, as at the first key.
      for (int up = body.nodes[n].parent; joint < 0; up = body.nodes[up].parent) {
        joint = clip_.binding->JointAtNode(up);
      }
      KeyedNode node;
      node.parent = first_ + joint;
      const Vec3 above = UpTurn() * (clip_.facts.metres_per_unit * rig_at_start_.position[joint]);
      node.translation =
          (UpTurn() * rig_at_start_.rotation[joint]).conjugate() * (body_at_start_.node[n] - above);
      ids.push_back(static_cast<int>(nodes_.size()));
      nodes_.push_back(node);
    }
    return ids;
  }

  const io::LoadedClip& clip_;
  KeyedMotion& motion_;
  std::vector<KeyedNode>& nodes_;
  int first_ = 0;
  PosedRig rig_at_start_;
  PosedBody body_at_start_;
};

double MeanLength(const std::vector<double>& length) {
  double sum = 0;
  for (const double l : length) sum += l;
  return sum / static_cast<double>(length.size());
}

}  // namespace

bool HasNamedFigures(const std::string& path) {
  const std::optional<std::string> bytes = io::TryReadFile(path);
  if (!bytes || bytes->compare(0, 4, "glTF") != 0) return false;
  return bytes->find("\"a/root\"") != std::string::npos;
}

ForeignScene ReadNamedFigures(const std::string& path, const TemplatePosture& posture,
                              const TangleSettings& tangle) {
  const io::SceneMotion scene = io::ReadSceneGlb(path);
  ForeignScene out;
  out.motion = scene.Keyed();
  out.subject.body = posture.body;
  out.node = report::SceneNodes(scene, posture.body);
  MeasureLengths(&out);
  for (int f = 0; f < 2; ++f) {
    std::vector<double> posed(posture.body[f].nodes.size(), 0);
    for (int n = 1; n < posture.body[f].num_nodes(); ++n) {
      posed[n] = posture.body[f].SegmentLength(n);
    }
    const double ratio = MeanLength(out.subject.length[f]) / MeanLength(posed);
    out.subject.body[f] = ScaledTo(posture.body[f], posture.body[f].stature * ratio);
  }
  out.notes.push_back("radii are the template's, scaled to the figures' lengths");
  TakeTemplate(posture, OnBodies(posture, out.subject.body).holds, tangle, &out);
  return out;
}

ForeignScene ReadFigures(const std::array<io::ClipOptions, 2>& figures,
                         const TemplatePosture& posture, const TangleSettings& tangle) {
  std::array<io::LoadedClip, 2> clip;
  ForeignScene out;
  for (int f = 0; f < 2; ++f) {
    io::ClipOptions options = figures[f];
    options.keep_in_place = true;  // the file's own motion is judged
    clip[f] = io::LoadClip(options);
    out.subject.body[f] = clip[f].body;
    for (const std::string& note : clip[f].facts.notes) {
      out.notes.push_back(fmt::format("{}: {}", report::kFigure[f], note));
    }
  }
  out.motion.key_times = SharedKeys(clip);
  std::vector<RigAdder> rigs;
  for (int f = 0; f < 2; ++f) {
    rigs.emplace_back(clip[f], &out);
    out.node[f] = rigs[f].Run();
  }
  MeasureLengths(&out);
  std::vector<Hold> holds = OnBodies(posture, out.subject.body).holds;
  for (Hold& hold : holds) {
    for (HoldPoint* point : {&hold.from, &hold.to}) {
      if (point->figure == kWorld) continue;
      point->offset = rigs[point->figure].OffsetAt(out.node[point->figure][point->node],
                                                   point->node, point->offset);
    }
  }
  TakeTemplate(posture, holds, tangle, &out);
  return out;
}

}  // namespace retarget::proof
