#include "io/template_figure.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "io/template_keys.h"
#include "io/template_parts.h"
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
Quat ReadRotation(const Value& value) { return ExpSo3(kDegree * value.Vector(kMaxTurn, "deg")); }

void ReadLength(const Value& value, double* out) {
  *out = value.Number(kMinLength, kMaxLength, "m");
}
void ReadLength(const Value& value, Vec3* out) { *out = value.Vector(kMaxLength, "m"); }

BodyMeasures::Side ReadSide(const Value& value) {
  value.CheckKeys(SideKeys());
  BodyMeasures::Side side;
  VisitSide(side, [&](const char* key, auto& length) { ReadLength(value.Require(key), &length); });
  return side;
}

BodyMeasures ReadLengths(const Value& value) {
  value.CheckKeys(LengthKeys());
  BodyMeasures measures;
  VisitTrunk(measures,
             [&](const char* key, auto& length) { ReadLength(value.Require(key), &length); });
  measures.left = ReadSide(value.Require("left"));
  measures.right = ReadSide(value.Require("right"));
  const double stature = StatureOf(measures);
  if (!(stature >= kMinStature && stature <= kMaxStature)) {
    value.Refuse(fmt::format("expected lengths of a stature from {} to {} m, found {:.3g} m",
                             kMinStature, kMaxStature, stature));
  }
  return measures;
}

// The body of a figure: `stature` or `lengths`, and `radii`.
Body ReadBody(const Value& figure) {
  const auto lengths = figure.Find("lengths");
  const bool has_stature = figure.Has("stature");
  if (has_stature == lengths.has_value()) {
    figure.Refuse(fmt::format("expected either stature or lengths, found {}",
                              has_stature ? "both" : "neither"));
  }
  Body body = StandardBody(
      lengths ? ReadLengths(*lengths)
              : AverageMeasures(figure.Require("stature").Number(kMinStature, kMaxStature, "m")));
  if (const auto radii = figure.Find("radii")) {
    radii->CheckKeys(WithoutFirst(NodeNames(body)));
    for (const Value& radius : radii->Items()) {
      body.nodes[body.FindNode(radius.key())].radius = radius.Number(kMinLength, 1, "m");
    }
  }
  return body;
}

Pose ReadPose(const Value& figure, const Body& body) {
  Pose pose = RestPose(body);
  const Value root = figure.Require("root");
  root.CheckKeys({"position", "rotation"});
  pose.root_position = root.Require("position").Vector(kMaxPosition, "m");
  if (const auto rotation = root.Find("rotation")) pose.rotation[0] = ReadRotation(*rotation);
  if (const auto joints = figure.Find("joints")) {
    joints->CheckKeys(WithoutFirst(LinkNames(body)));
    for (const Value& joint : joints->Items()) {
      pose.rotation[body.FindLink(joint.key())] = ReadRotation(joint);
    }
  }
  return pose;
}

}  // namespace

void ReadFigure(const Value& value, Body* body, Pose* pose) {
  value.CheckKeys({"stature", "lengths", "radii", "root", "joints"});
  *body = ReadBody(value);
  *pose = ReadPose(value, *body);
}

}  // namespace retarget::io
