#include "io/template_figure.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "io/template_keys.h"
#include "model/geometry/so3.h"

namespace retarget::io {
namespace {

constexpr double kMinStature = 0.5, kMaxStature = 3;  // m
constexpr double kMinLength = 1e-4, kMaxLength = 3;   // m
constexpr double kMaxTurn = 360;                      // degrees, of a rotation vector's component

std::vector<std::string> SideKeys() {
  std::vector<std::string> keys;
  const BodyMeasures::Side side;
  VisitSide(side, [&](const char* key, const auto&) { keys.push_back(key); });
  return keys;
}

std::vector<std::string> LengthKeys() {
  std::vector<std::string> keys;
  const BodyMeasures measures;
  VisitTrunk(measures, [&](const char* key, const auto&) { keys.push_back(key); });
  keys.insert(keys.end(), {"left", "right"});
  return keys;
}

// Without the root, which has keys of its own.
std::vector<std::string> WithoutFirst(std::vector<std::string> names) {
  names.erase(names.begin());
  return names;
}

// A rotation vector in degrees.
Quat ReadRotation(const YamlValue& value) {
  return ExpSo3(kDegree * ReadVector(value, kMaxTurn, "deg"));
}

void ReadLength(const YamlValue& value, double* out) {
  *out = ReadNumber(value, kMinLength, kMaxLength, "m");
}
void ReadLength(const YamlValue& value, Vec3* out) { *out = ReadVector(value, kMaxLength, "m"); }

BodyMeasures::Side ReadSide(const YamlValue& value) {
  CheckKeys(value, SideKeys());
  BodyMeasures::Side side;
  VisitSide(side, [&](const char* key, auto& length) { ReadLength(Require(value, key), &length); });
  return side;
}

BodyMeasures ReadLengths(const YamlValue& value) {
  CheckKeys(value, LengthKeys());
  BodyMeasures measures;
  VisitTrunk(measures,
             [&](const char* key, auto& length) { ReadLength(Require(value, key), &length); });
  measures.left = ReadSide(Require(value, "left"));
  measures.right = ReadSide(Require(value, "right"));
  const double stature = StatureOf(measures);
  if (!(stature >= kMinStature && stature <= kMaxStature)) {
    Refuse(value, fmt::format("expected lengths of a stature from {} to {} m, found {:.3g} m",
                              kMinStature, kMaxStature, stature));
  }
  return measures;
}

// The body of a figure: `stature` or `lengths`, and `radii`.
Body ReadBody(const YamlValue& figure) {
  const YamlValue* lengths = figure.Find("lengths");
  const bool has_stature = figure.Find("stature") != nullptr;
  if (has_stature == (lengths != nullptr)) {
    Refuse(figure, fmt::format("expected either stature or lengths, found {}",
                               has_stature ? "both" : "neither"));
  }
  Body body = StandardBody(lengths ? ReadLengths(*lengths)
                                   : AverageMeasures(ReadNumber(Require(figure, "stature"),
                                                                kMinStature, kMaxStature, "m")));
  if (const YamlValue* radii = figure.Find("radii")) {
    CheckKeys(*radii, WithoutFirst(NodeNames(body)));
    for (const YamlValue& radius : radii->children) {
      body.nodes[body.FindNode(radius.key)].radius = ReadNumber(radius, kMinLength, 1, "m");
    }
  }
  return body;
}

Pose ReadPose(const YamlValue& figure, const Body& body) {
  Pose pose = RestPose(body);
  const YamlValue& root = Require(figure, "root");
  CheckKeys(root, {"position", "rotation"});
  pose.root_position = ReadVector(Require(root, "position"), kMaxPosition, "m");
  if (const YamlValue* rotation = root.Find("rotation")) pose.rotation[0] = ReadRotation(*rotation);
  if (const YamlValue* joints = figure.Find("joints")) {
    CheckKeys(*joints, WithoutFirst(LinkNames(body)));
    for (const YamlValue& joint : joints->children) {
      pose.rotation[body.FindLink(joint.key)] = ReadRotation(joint);
    }
  }
  return pose;
}

}  // namespace

Vec3 ReadVector(const YamlValue& value, double most, const std::string& unit) {
  return ReadNumbers(value, 3, -most, most, unit);
}

void ReadFigure(const YamlValue& value, Body* body, Pose* pose) {
  CheckKeys(value, {"stature", "lengths", "radii", "root", "joints"});
  *body = ReadBody(value);
  *pose = ReadPose(value, *body);
}

}  // namespace retarget::io
