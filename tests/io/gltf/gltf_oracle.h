// glTF's rules, written out once more for the tests: containers, accessors, interpolation and node
// transforms straight from JSON and bytes, with 4x4 matrices. Shares nothing with io/gltf_*.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/geometry/types.h"
#include "tests/test_data.h"

namespace retarget::io {

using nlohmann::json;
using Matrix4 = Eigen::Matrix4d;

inline std::string FromBase64(const std::string& text) {
  std::string out;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    count += 6;
    if (count >= 8) out.push_back(static_cast<char>(bits >> (count -= 8) & 0xFF));
  }
  return out;
}

class GltfOracle {
 public:
  explicit GltfOracle(const std::string& bytes, const std::string& folder = "") {
    std::string bin;
    if (bytes.substr(0, 4) == "glTF") {
      json_text = bytes.substr(20, Word(bytes, 12));
      const size_t at = 20 + json_text.size();
      if (at < bytes.size()) bin = bytes.substr(at + 8, Word(bytes, at));
    } else {
      json_text = bytes;
    }
    document = json::parse(json_text);
    for (const json& buffer : document.value("buffers", json::array())) {
      const std::string uri = buffer.value("uri", "");
      if (uri.empty()) {
        buffers.push_back(bin);
      } else if (uri.substr(0, 5) == "data:") {
        buffers.push_back(FromBase64(uri.substr(uri.find(',') + 1)));
      } else {
        buffers.push_back(ReadWholeFile(folder + "/" + uri));
      }
    }
    parent.assign(document["nodes"].size(), -1);
    for (size_t n = 0; n < parent.size(); ++n) {
      for (const int child : document["nodes"][n].value("children", json::array())) {
        parent[static_cast<size_t>(child)] = static_cast<int>(n);
      }
    }
  }

  // Items of an accessor (plain, without sparse parts).
  std::vector<std::vector<double>> Items(int accessor) const {
    const json& a = document["accessors"][static_cast<size_t>(accessor)];
    const json& v = document["bufferViews"][a["bufferView"].get<size_t>()];
    const std::map<std::string, size_t> sizes = {
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const size_t n = sizes.at(a["type"]);
    const int type = a["componentType"];
    const size_t bytes = type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
    const size_t stride = v.value("byteStride", n * bytes);
    const std::string& data = buffers[v["buffer"].get<size_t>()];
    const size_t start = v.value("byteOffset", 0U) + a.value("byteOffset", 0U);
    std::vector<std::vector<double>> out;
    for (size_t i = 0; i < a["count"].get<size_t>(); ++i) {
      std::vector<double> item;
      for (size_t c = 0; c < n; ++c) {
        const char* at = data.data() + start + i * stride + c * bytes;
        item.push_back(Number(at, type, a.value("normalized", false)));
      }
      out.push_back(item);
    }
    return out;
  }

  int AnimationNamed(const std::string& name) const {
    for (size_t a = 0; a < document["animations"].size(); ++a) {
      if (document["animations"][a].value("name", "") == name) return static_cast<int>(a);
    }
    return -1;
  }

  // First and last key time over an animation's translations and rotations (s).
  std::pair<double, double> Span(int animation) const {
    std::pair<double, double> span = {1e300, -1e300};
    const json& a = document["animations"][static_cast<size_t>(animation)];
    for (const json& channel : a["channels"]) {
      if (channel["target"]["path"] != "translation" && channel["target"]["path"] != "rotation") {
        continue;
      }
      const auto times = Items(a["samplers"][channel["sampler"].get<size_t>()]["input"]);
      span.first = std::min(span.first, times.front()[0]);
      span.second = std::max(span.second, times.back()[0]);
    }
    return span;
  }

  // Global transforms of all nodes at a time of an animation (-1: at rest). [nodes]
  std::vector<Matrix4> Globals(int animation, double time) const {
    std::vector<std::map<std::string, std::vector<double>>> properties(parent.size());
    for (size_t n = 0; n < parent.size(); ++n) {
      for (const char* key : {"matrix", "translation", "rotation", "scale"}) {
        const json& node = document["nodes"][n];
        if (node.contains(key)) properties[n][key] = node[key].get<std::vector<double>>();
      }
    }
    if (animation >= 0) {
      const json& a = document["animations"][static_cast<size_t>(animation)];
      for (const json& channel : a["channels"]) {
        if (!channel["target"].contains("node")) continue;
        const std::string path = channel["target"]["path"];
        if (path == "weights") continue;
        properties[channel["target"]["node"].get<size_t>()][path] =
            Value(a["samplers"][channel["sampler"].get<size_t>()], time, path == "rotation");
      }
    }
    std::vector<Matrix4> globals(parent.size());
    for (size_t n = 0; n < parent.size(); ++n) {
      globals[n] = Local(properties[n]);
      for (int p = parent[n]; p >= 0; p = parent[static_cast<size_t>(p)]) {
        globals[n] = Local(properties[static_cast<size_t>(p)]) * globals[n];
      }
    }
    return globals;
  }

  json document;
  std::string json_text;
  std::vector<std::string> buffers;
  std::vector<int> parent;

 private:
  static size_t Word(const std::string& bytes, size_t at) {
    unsigned word;
    std::memcpy(&word, bytes.data() + at, 4);
    return word;
  }

  static double Number(const char* at, int type, bool normalised) {
    const auto as = [&](auto value, double largest) {
      std::memcpy(&value, at, sizeof value);
      return normalised ? std::max(double(value) / largest, -1.0) : double(value);
    };
    switch (type) {
      case 5120:
        return as(std::int8_t(), 127);
      case 5121:
        return as(std::uint8_t(), 255);
      case 5122:
        return as(std::int16_t(), 32767);
      case 5123:
        return as(std::uint16_t(), 65535);
      case 5125:
        return as(std::uint32_t(), 1);
      default:
        return as(float(), 1);
    }
  }

  std::vector<double> Value(const json& sampler, double time, bool rotates) const {
    const auto times = Items(sampler["input"]), values = Items(sampler["output"]);
    const std::string kind = sampler.value("interpolation", "LINEAR");
    const size_t per_key = kind == "CUBICSPLINE" ? 3 : 1, middle = kind == "CUBICSPLINE" ? 1 : 0;
    const size_t last = times.size() - 1;
    size_t k = 0;
    while (k < last && time >= times[k + 1][0]) ++k;
    if (time <= times[0][0] || k == last || kind == "STEP") return values[per_key * k + middle];
    const double span = times[k + 1][0] - times[k][0], u = (time - times[k][0]) / span;
    std::vector<double> a = values[per_key * k + middle], b = values[per_key * (k + 1) + middle];
    if (rotates && kind == "LINEAR") {  // rounded to bytes they are not quite unit
      for (auto* q : {&a, &b}) Eigen::Map<Eigen::Vector4d>(q->data()).normalize();
    }
    std::vector<double> out(a.size());
    double dot = 0, norm = 0;
    for (size_t c = 0; c < a.size(); ++c) dot += a[c] * b[c];
    const double angle = std::acos(std::min(1.0, std::abs(dot)));
    for (size_t c = 0; c < a.size(); ++c) {
      if (kind == "CUBICSPLINE") {
        const double m = span * values[3 * k + 2][c], n = span * values[3 * k + 3][c];
        out[c] = (2 * u * u * u - 3 * u * u + 1) * a[c] + (u * u * u - 2 * u * u + u) * m +
                 (-2 * u * u * u + 3 * u * u) * b[c] + (u * u * u - u * u) * n;
      } else if (rotates && angle > 1e-6) {
        out[c] =
            (std::sin((1 - u) * angle) * a[c] + (dot < 0 ? -1 : 1) * std::sin(u * angle) * b[c]) /
            std::sin(angle);
      } else {
        out[c] = (1 - u) * a[c] + u * (rotates && dot < 0 ? -1 : 1) * b[c];
      }
      norm += out[c] * out[c];
    }
    if (rotates) {
      for (double& c : out) c /= std::sqrt(norm);
    }
    return out;
  }

  static Matrix4 Local(const std::map<std::string, std::vector<double>>& p) {
    const bool trs = p.count("translation") + p.count("rotation") + p.count("scale") > 0;
    if (p.count("matrix") > 0 && !trs) {
      return Eigen::Map<const Matrix4>(p.at("matrix").data());
    }
    Matrix4 t = Matrix4::Identity(), r = t, s = t;
    if (p.count("translation") > 0)
      t.topRightCorner<3, 1>() = Vec3::Map(p.at("translation").data());
    if (p.count("scale") > 0) s.diagonal().head<3>() = Vec3::Map(p.at("scale").data());
    if (p.count("rotation") > 0) {
      const auto& q = p.at("rotation");
      const double x = q[0], y = q[1], z = q[2], w = q[3], n = x * x + y * y + z * z + w * w;
      r.topLeftCorner<3, 3>() << 1 - 2 * (y * y + z * z) / n, 2 * (x * y - z * w) / n,
          2 * (x * z + y * w) / n, 2 * (x * y + z * w) / n, 1 - 2 * (x * x + z * z) / n,
          2 * (y * z - x * w) / n, 2 * (x * z - y * w) / n, 2 * (y * z + x * w) / n,
          1 - 2 * (x * x + y * y) / n;
    }
    return t * r * s;
  }
};

}  // namespace retarget::io
