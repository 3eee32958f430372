// FormatGltf of io/gltf/clip.h. The text of the document is edited, not written anew: what is not
// named here cannot change.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/gltf/clip.h"
#include "io/gltf/container.h"
#include "io/gltf/splice.h"
#include "io/text/base64.h"

namespace retarget::io {
namespace {

using nlohmann::json;

// What the animation says of one node, key by key.
struct NodeKeys {
  int node = -1;
  std::vector<Vec3> translation;  // empty: no track
  std::vector<Quat> rotation;
  std::vector<Vec3> scale;  // empty: no track
};

// The joint's transforms, taken back into the node's own frame and unit.
NodeKeys KeysOf(const GltfJoint& joint, size_t j, const std::vector<RigFrame>& frames) {
  constexpr double kStill = 1e-6;     // m; a track that says no more than the node is not written
  constexpr double kNothing = 1e-12;  // a scale that has made all translations one
  NodeKeys keys;
  keys.node = joint.node;
  bool moves = joint.has_translation_track;
  for (const RigFrame& frame : frames) {
    const Vec3 local = joint.turn.conjugate() * (frame.translation[j] - joint.origin);
    Vec3 t = joint.rest_translation;
    for (int c = 0; c < 3; ++c) {
      if (joint.stretch[c] > kNothing) t[c] = local[c] / joint.stretch[c];
    }
    moves = moves || (joint.stretch.cwiseProduct(t - joint.rest_translation)).norm() > kStill;
    keys.translation.push_back(t);
    Quat q = (joint.turn.conjugate() * frame.rotation[j]).normalized();
    // One side of the double cover throughout, so that interpolation never takes the long way.
    const Quat& before = keys.rotation.empty() ? joint.rest_rotation : keys.rotation.back();
    if (q.dot(before) < 0) q.coeffs() *= -1;
    keys.rotation.push_back(q);
  }
  if (!moves) keys.translation.clear();
  if (joint.changes_scale) {
    for (const RigFrame& frame : frames) {
      keys.scale.push_back(frame.scale.empty() ? joint.scale : Vec3(joint.size * frame.scale[j]));
    }
  } else if ((joint.scale - joint.rest_scale).cwiseAbs().maxCoeff() > kStill) {
    keys.scale.assign(frames.size(), joint.scale);
  }
  return keys;
}

class AnimationWriter {
 public:
  // `view` and `first_accessor`: the indices that the new buffer view and accessors will have.
  AnimationWriter(int view, int first_accessor) : view_(view), first_accessor_(first_accessor) {}

  void AddTimes(const std::vector<double>& times) { input_ = AddAccessor(times, 1, true); }

  void AddNode(const NodeKeys& keys) {
    std::vector<double> numbers;
    const auto add_vectors = [&](const std::vector<Vec3>& values, const char* path) {
      if (values.empty()) return;
      numbers.clear();
      for (const Vec3& v : values) numbers.insert(numbers.end(), v.begin(), v.end());
      AddChannel(keys.node, path, AddAccessor(numbers, 3, false));
    };
    add_vectors(keys.translation, "translation");
    numbers.clear();
    for (const Quat& q : keys.rotation) {
      numbers.insert(numbers.end(), {q.x(), q.y(), q.z(), q.w()});
    }
    AddChannel(keys.node, "rotation", AddAccessor(numbers, 4, false));
    add_vectors(keys.scale, "scale");
  }

  const std::string& data() const { return data_; }
  const std::vector<std::string>& accessors() const { return accessors_; }
  std::string Animation(const std::string& name) const {
    const std::string quoted = json(name).dump(-1, ' ', false, json::error_handler_t::replace);
    return fmt::format("{{\"name\":{},\"channels\":[{}],\"samplers\":[{}]}}", quoted,
                       fmt::join(channels_, ","), fmt::join(samplers_, ","));
  }

 private:
  int AddAccessor(const std::vector<double>& numbers, size_t components, bool bounds) {
    static constexpr const char* kTypes[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    std::string text = fmt::format("{{\"bufferView\":{},", view_);
    if (!data_.empty()) text += fmt::format("\"byteOffset\":{},", data_.size());
    text += fmt::format("\"componentType\":5126,\"count\":{},\"type\":\"{}\"",
                        numbers.size() / components, kTypes[components]);
    for (const double number : numbers) {
      if (!(std::abs(number) <= std::numeric_limits<float>::max())) {
        throw InputError("the motion holds a number that float32 cannot hold");
      }
      const float value = static_cast<float>(number);
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      for (int i = 0; i < 4; ++i) data_.push_back(static_cast<char>(bits >> (8 * i) & 0xFF));
    }
    if (bounds) {
      // The bounds of the stored floats, exactly.
      text += fmt::format(",\"min\":[{}],\"max\":[{}]",
                          static_cast<double>(static_cast<float>(numbers.front())),
                          static_cast<double>(static_cast<float>(numbers.back())));
    }
    accessors_.push_back(text + "}");
    return first_accessor_ + static_cast<int>(accessors_.size()) - 1;
  }

  void AddChannel(int node, const char* path, int output) {
    channels_.push_back(fmt::format("{{\"sampler\":{},\"target\":{{\"node\":{},\"path\":\"{}\"}}}}",
                                    samplers_.size(), node, path));
    samplers_.push_back(
        fmt::format("{{\"input\":{},\"interpolation\":\"LINEAR\",\"output\":{}}}", input_, output));
  }

  int view_, first_accessor_, input_ = -1;
  std::string data_;
  std::vector<std::string> accessors_, channels_, samplers_;
};

std::string Numbers(std::initializer_list<double> values) {
  return fmt::format("[{}]", fmt::join(values, ","));
}

// glTF lets no animation move a node that has a matrix.
void SplitMatrices(const GltfClip& clip, const json& document, JsonSplice* splice) {
  const std::vector<JsonSplice::Span> nodes =
      splice->Elements(splice->Member(splice->root(), "nodes").value());
  for (const GltfJoint& joint : clip.joints) {
    if (!document["nodes"][joint.node].contains("matrix")) continue;
    const Vec3 &t = joint.rest_translation, &s = joint.rest_scale;
    const Quat& q = joint.rest_rotation;
    splice->ReplaceMember(
        nodes[joint.node], "matrix",
        fmt::format("\"translation\":{},\"rotation\":{},\"scale\":{}",
                    Numbers({t.x(), t.y(), t.z()}), Numbers({q.x(), q.y(), q.z(), q.w()}),
                    Numbers({s.x(), s.y(), s.z()})));
  }
}

size_t SizeOf(const json& document, const char* key) {
  const auto it = document.find(key);
  return it == document.end() ? 0 : it->size();
}

// The place of an animation with that name; nothing where there is none.
std::optional<JsonSplice::Span> FindAnimation(const json& document, const std::string& name,
                                              const JsonSplice& splice) {
  for (size_t a = 0; a < SizeOf(document, "animations"); ++a) {
    const json& animation = document["animations"][a];
    if (animation.contains("name") && animation["name"] == name) {
      return splice.Elements(splice.Member(splice.root(), "animations").value())[a];
    }
  }
  return std::nullopt;
}

// Players of a VRM animation take a file's first (VRMC_vrm_animation 1.0).
bool PlaysFirstAnimation(const json& document) {
  const auto extensions = document.find("extensions");
  return extensions != document.end() && extensions->is_object() &&
         extensions->contains("VRMC_vrm_animation");
}

// Puts an animation in the place of the one of that name, or after all; or, for players of the
// first alone, before the others.
void PutAnimation(const json& document, const std::string& name, const std::string& animation,
                  JsonSplice* splice) {
  const auto place = FindAnimation(document, name, *splice);
  if (!PlaysFirstAnimation(document)) {
    if (place) {
      splice->Replace(*place, animation);
    } else {
      splice->Append("animations", animation);
    }
    return;
  }
  const auto array = splice->Member(splice->root(), "animations");
  if (!array) {
    splice->Append("animations", animation);
    return;
  }
  std::string all = "[" + animation;
  for (const JsonSplice::Span& other : splice->Elements(*array)) {
    if (!place || other.begin != place->begin) all += "," + splice->Text(other);
  }
  splice->Replace(*array, all + "]");
}

// Key times (s) of the frames to write.
std::vector<double> KeyTimes(const GltfClip& original, const RigMotion& motion, size_t count,
                             double frame_time) {
  const bool same = original.key_times.size() == count && motion.num_frames() == int(count) &&
                    std::abs(frame_time - original.motion.frame_time) <= 1e-9 * frame_time;
  std::vector<double> times = original.key_times;
  if (!same) {
    times.clear();
    for (size_t k = 0; k < count; ++k) times.push_back(static_cast<double>(k) * frame_time);
  }
  for (size_t k = 1; k < times.size(); ++k) {
    if (static_cast<float>(times[k]) <= static_cast<float>(times[k - 1])) {
      throw InputError(fmt::format("{}: {} keys, {:.3g} s apart, are too close for float32",
                                   original.name, count, frame_time));
    }
  }
  return times;
}

}  // namespace

std::string FormatGltf(const GltfClip& original, const RigMotion& motion, double fps,
                       const std::string& animation_name) {
  assert(motion.rig.joints.size() == original.joints.size() && motion.num_frames() > 0);
  double frame_time = motion.frame_time;
  std::vector<RigFrame> frames = motion.frames;
  if (fps > 0 && std::abs(fps * frame_time - 1) > 1e-9) {
    const double span = (motion.num_frames() - 1) * motion.frame_time;
    frame_time = 1 / fps;
    frames.clear();
    for (int k = 0; k == 0 || k * frame_time <= span * (1 + 1e-9); ++k) {
      frames.push_back(SampleRig(motion, k * frame_time));
    }
  }

  const GltfContainer container = SplitGltf(original.bytes, original.name);
  const json document = json::parse(container.json);
  AnimationWriter writer(static_cast<int>(SizeOf(document, "bufferViews")),
                         static_cast<int>(SizeOf(document, "accessors")));
  writer.AddTimes(KeyTimes(original, motion, frames.size(), frame_time));
  for (size_t j = 0; j < original.joints.size(); ++j) {
    writer.AddNode(KeysOf(original.joints[j], j, frames));
  }

  JsonSplice splice(container.json);
  SplitMatrices(original, document, &splice);
  PutAnimation(document, animation_name, writer.Animation(animation_name), &splice);
  for (const std::string& accessor : writer.accessors()) splice.Append("accessors", accessor);

  const size_t buffers = SizeOf(document, "buffers");
  const bool own_chunk =
      container.binary && (buffers == 0 || !document["buffers"][0].contains("uri"));
  const size_t offset = own_chunk ? container.data.size() : 0;
  splice.Append("bufferViews", fmt::format("{{\"buffer\":{},\"byteOffset\":{},\"byteLength\":{}}}",
                                           own_chunk ? 0 : buffers, offset, writer.data().size()));
  std::string data(container.data);
  if (!own_chunk) {
    splice.Append("buffers",
                  fmt::format("{{\"byteLength\":{},\"uri\":\"data:application/octet-stream;base64,"
                              "{}\"}}",
                              writer.data().size(), EncodeBase64(writer.data())));
  } else {
    data += writer.data();
    if (buffers == 0) {
      splice.Append("buffers", fmt::format("{{\"byteLength\":{}}}", data.size()));
    } else {
      const JsonSplice::Span buffer =
          splice.Elements(splice.Member(splice.root(), "buffers").value())[0];
      splice.Replace(splice.Member(buffer, "byteLength").value(), std::to_string(data.size()));
    }
  }
  std::string text = splice.Finish();
  if (!container.binary) return text;
  while (text.ends_with(' ')) text.pop_back();
  return JoinGlb(text, data, container.rest);
}

}  // namespace retarget::io
