#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "io/playback/players.h"
#include "io/text/base64.h"
#include "io/text/read_file.h"

namespace retarget::io::playback {
namespace {

using nlohmann::json;

struct Track {
  std::vector<double> times;
  std::vector<double> values;  // [keys x width]
  size_t width = 3;
};

struct Node {
  int parent = -1;
  Affine fixed = Affine::Identity();  // of a node with a matrix
  bool has_matrix = false;
  LocalTransform rest;
  const Track* translation = nullptr;
  const Track* rotation = nullptr;
  const Track* scale = nullptr;
};

class GltfPlayer {
 public:
  explicit GltfPlayer(const PlayedFile& file) : file_(file) {
    try {
      Open();
      ReadNodes();
      ReadAnimation();
    } catch (const json::exception& error) {
      throw InputError(file.name + ": " + error.what());
    }
  }

  Played Play(const std::vector<PlayedJoint>& joints, const std::vector<double>& times) const {
    const std::vector<int> nodes = IndicesOf(joints, names_, file_.name);
    Played out;
    out.seconds = last_ - first_;
    for (const double time : times) {
      out.position.emplace_back();
      for (const int n : nodes) {
        Affine world = Affine::Identity();
        for (int k = n; k >= 0; k = nodes_[static_cast<size_t>(k)].parent) {
          world = LocalAt(nodes_[static_cast<size_t>(k)], first_ + time) * world;
        }
        out.position.back().push_back(world.translation());
      }
    }
    return out;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(file_.name + ": " + what);
  }

  std::uint32_t WordAt(size_t at) const {
    if (at + 4 > file_.bytes.size()) Fail("ends in the middle of a chunk");
    std::uint32_t word = 0;
    for (size_t i = 0; i < 4; ++i) {
      word |= static_cast<std::uint32_t>(static_cast<unsigned char>(file_.bytes[at + i])) << 8 * i;
    }
    return word;
  }

  // JSON, or the chunks of a GLB: length, type, data.
  void Open() {
    const std::string& bytes = file_.bytes;
    if (bytes.rfind("glTF", 0) != 0) {
      document_ = json::parse(bytes);
      return;
    }
    for (size_t at = 12; at + 8 <= bytes.size();) {
      const std::uint32_t length = WordAt(at), type = WordAt(at + 4);
      if (length > bytes.size() - at - 8) Fail("ends in the middle of a chunk");
      const std::string chunk = bytes.substr(at + 8, length);
      constexpr std::uint32_t kJson = 0x4E4F534A, kBin = 0x004E4942;
      if (type == kJson) document_ = json::parse(chunk);
      if (type == kBin && chunk_.empty()) chunk_ = chunk;
      at += 8 + length;
    }
  }

  const std::string& Buffer(size_t index) {
    const auto known = buffers_.find(index);
    if (known != buffers_.end()) return known->second;
    const json& buffer = document_.at("buffers").at(index);
    std::string data = chunk_;
    if (buffer.contains("uri")) {
      const std::string uri = buffer.at("uri").get<std::string>();
      const size_t comma = uri.find(',');
      data = uri.rfind("data:", 0) == 0 && comma != std::string::npos
                 ? DecodeBase64(uri.substr(comma + 1))
                 : ReadFile(file_.folder + "/" + uri);
    }
    return buffers_.emplace(index, std::move(data)).first->second;
  }

  std::vector<double> Floats(size_t index, size_t width) {
    const json& accessor = document_.at("accessors").at(index);
    const json& view = document_.at("bufferViews").at(accessor.at("bufferView").get<size_t>());
    constexpr int kFloat = 5126;
    if (accessor.at("componentType") != kFloat || accessor.contains("sparse")) {
      Fail("an animation's numbers are not plain floats");
    }
    const std::string& data = Buffer(view.at("buffer").get<size_t>());
    const size_t stride = view.value("byteStride", 4 * width),
                 count = accessor.at("count").get<size_t>();
    const size_t begin =
        view.value("byteOffset", size_t{0}) + accessor.value("byteOffset", size_t{0});
    std::vector<double> out;
    for (size_t i = 0; i < count; ++i) {
      for (size_t c = 0; c < width; ++c) {
        const size_t at = begin + i * stride + 4 * c;
        if (at + 4 > data.size()) Fail("an accessor reaches beyond its data");
        float value;
        std::memcpy(&value, data.data() + at, sizeof value);
        out.push_back(value);
      }
    }
    return out;
  }

  static double At(const json& numbers, size_t k) { return numbers.at(k).get<double>(); }
  static Vec3 Vector(const json& v) { return Vec3(At(v, 0), At(v, 1), At(v, 2)); }

  void ReadNodes() {
    for (const json& node : document_.at("nodes")) {
      Node out;
      if (node.contains("matrix")) {
        out.has_matrix = true;
        for (int i = 0; i < 16; ++i) {
          out.fixed.matrix()(i % 4, i / 4) = At(node.at("matrix"), static_cast<size_t>(i));
        }
      }
      if (node.contains("translation")) out.rest.translation = Vector(node.at("translation"));
      if (node.contains("scale")) out.rest.scale = Vector(node.at("scale"));
      if (node.contains("rotation")) {
        const json& q = node.at("rotation");
        out.rest.rotation = Quat(At(q, 3), At(q, 0), At(q, 1), At(q, 2)).normalized();
      }
      nodes_.push_back(out);
      names_.push_back(node.value("name", ""));
    }
    size_t n = 0;
    for (const json& node : document_.at("nodes")) {
      for (const json& child : node.value("children", json::array())) {
        nodes_.at(child.get<size_t>()).parent = static_cast<int>(n);
      }
      ++n;
    }
    for (size_t k = 0; k < nodes_.size(); ++k) {
      size_t depth = 0;
      for (int up = nodes_[k].parent; up >= 0; up = nodes_[static_cast<size_t>(up)].parent) {
        if (++depth > nodes_.size()) Fail("the node hierarchy has a loop");
      }
    }
  }

  void ReadAnimation() {
    const json* animation = nullptr;
    for (const json& a : document_.at("animations")) {
      if (a.value("name", "") == file_.animation) animation = &a;
    }
    if (animation == nullptr) Fail("no animation " + file_.animation);
    first_ = HUGE_VAL;
    const json& channels = animation->at("channels");
    tracks_.reserve(channels.size());
    for (const json& channel : channels) {
      const json& target = channel.at("target");
      const std::string path = target.at("path").get<std::string>();
      if (!target.contains("node") || path == "weights") continue;
      const json& sampler = animation->at("samplers").at(channel.at("sampler").get<size_t>());
      if (sampler.value("interpolation", "LINEAR") != "LINEAR") Fail("a track is not LINEAR");
      Track track;
      track.width = path == "rotation" ? 4 : 3;
      track.times = Floats(sampler.at("input").get<size_t>(), 1);
      track.values = Floats(sampler.at("output").get<size_t>(), track.width);
      if (track.times.empty() || track.values.size() < track.width * track.times.size()) {
        Fail("a track has fewer values than keys");
      }
      first_ = std::min(first_, track.times.front());
      last_ = std::max(last_, track.times.back());
      tracks_.push_back(std::move(track));
      Node& node = nodes_.at(target.at("node").get<size_t>());
      (path == "rotation" ? node.rotation
       : path == "scale"  ? node.scale
                          : node.translation) = &tracks_.back();
    }
    if (tracks_.empty()) Fail("the animation " + file_.animation + " moves nothing");
  }

  // The keys about a time and the share of the way.
  static void Locate(const Track& track, double time, size_t* from, size_t* to, double* share) {
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), time);
    *to = static_cast<size_t>(after - track.times.begin());
    *from = *to > 0 ? *to - 1 : 0;
    *to = std::min(*to, track.times.size() - 1);
    const double span = track.times[*to] - track.times[*from];
    *share = span > 0 ? std::clamp((time - track.times[*from]) / span, 0.0, 1.0) : 0;
  }

  static Vec3 VectorAt(const Track& track, double time) {
    size_t from, to;
    double share;
    Locate(track, time, &from, &to, &share);
    return (1 - share) * Vec3(&track.values[3 * from]) + share * Vec3(&track.values[3 * to]);
  }

  static Quat QuaternionAt(const Track& track, double time) {
    size_t from, to;
    double share;
    Locate(track, time, &from, &to, &share);
    const auto at = [&](size_t k) {
      const double* q = &track.values[4 * k];
      return Quat(q[3], q[0], q[1], q[2]).normalized();
    };
    return at(from).slerp(share, at(to));
  }

  static Affine LocalAt(const Node& node, double time) {
    if (node.has_matrix) return node.fixed;
    LocalTransform local = node.rest;
    if (node.translation != nullptr) local.translation = VectorAt(*node.translation, time);
    if (node.rotation != nullptr) local.rotation = QuaternionAt(*node.rotation, time);
    if (node.scale != nullptr) local.scale = VectorAt(*node.scale, time);
    return Between(local, local, 0);
  }

  const PlayedFile& file_;
  json document_;
  std::string chunk_;
  std::map<size_t, std::string> buffers_;
  std::vector<Node> nodes_;
  std::vector<std::string> names_;
  std::vector<Track> tracks_;
  double first_ = 0, last_ = 0;
};

}  // namespace

Played PlayGltf(const PlayedFile& file, const std::vector<PlayedJoint>& joints,
                const std::vector<double>& times) {
  return GltfPlayer(file).Play(joints, times);
}

}  // namespace retarget::io::playback
