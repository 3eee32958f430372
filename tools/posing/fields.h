// Fields of operations in JSON: how each kind is read, written and typed. Inner part of the rows of
// tools/posing/operation_table.h.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/template_keys.h"
#include "io/template_parts.h"
#include "model/geometry/so3.h"
#include "tools/posing/operation_table.h"
#include "tools/posing/posture_json.h"

namespace retarget::posing {

template <typename Op>
struct Field {
  std::vector<OperationField> keys;
  std::function<void(const io::Value& op, const TemplatePosture& posture, Op* out)> read;
  std::function<void(const Op& op, const TemplatePosture& posture, report::Json* out)> write;
};

// A field of one key; `get` and `put` turn its value into the member and back.
template <typename Op, typename Get, typename Put>
Field<Op> FieldOf(const char* key, const std::string& type, Get get, Put put) {
  return {{{key, type}},
          [=](const io::Value& op, const TemplatePosture& posture, Op* out) {
            get(op.Require(key), posture, out);
          },
          [=](const Op& op, const TemplatePosture& posture, report::Json* out) {
            (*out)[key] = put(op, posture);
          }};
}

// The same; where the key is not there the member stays as it is.
template <typename Op>
Field<Op> Optional(Field<Op> field) {
  field.keys[0].required = false;
  field.read = [key = field.keys[0].key, read = field.read](
                   const io::Value& op, const TemplatePosture& posture, Op* out) {
    if (op.Has(key)) read(op, posture, out);
  };
  return field;
}

// Nor is it written where there is nothing.
template <typename Op>
Field<Op> OptionalWhere(bool (*is_there)(const Op&), Field<Op> field) {
  field.write = [is_there, write = field.write](const Op& op, const TemplatePosture& posture,
                                                report::Json* out) {
    if (is_there(op)) write(op, posture, out);
  };
  return Optional(field);
}

// One of some names, each of which means a value.
template <typename Op, typename T>
Field<Op> Choice(const char* key, T Op::*member,
                 const std::vector<std::pair<std::string, T>>& choices, std::string type = "") {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  if (type.empty()) {
    for (const std::string& name : names) type += (type.empty() ? "\"" : " | \"") + name + "\"";
  }
  return FieldOf<Op>(
      key, type,
      [=](const io::Value& v, const TemplatePosture&, Op* out) {
        out->*member = choices[v.Name("name", names)].second;
      },
      [=](const Op& op, const TemplatePosture&) {
        for (const auto& [name, value] : choices) {
          if (value == op.*member) return report::Json(name);
        }
        return report::Json();
      });
}

template <typename Op>
Field<Op> Figure() {
  return Choice<Op, int>("figure", &Op::figure, {{"a", 0}, {"b", 1}}, "FigureName");
}

// A node of the figure, which is read before it.
template <typename Op>
Field<Op> Node() {
  return FieldOf<Op>(
      "node", "string",
      [](const io::Value& v, const TemplatePosture& posture, Op* out) {
        out->node = io::ReadNode(v, posture.body[out->figure]);
      },
      [](const Op& op, const TemplatePosture& posture) -> report::Json {
        return posture.body[op.figure].nodes[op.node].name;
      });
}

// The same of a joint.
template <typename Op>
Field<Op> Joint() {
  return FieldOf<Op>(
      "joint", "string",
      [](const io::Value& v, const TemplatePosture& posture, Op* out) {
        out->link = v.Name("joint", io::LinkNames(posture.body[out->figure]));
      },
      [](const Op& op, const TemplatePosture& posture) -> report::Json {
        return posture.body[op.figure].links[op.link].name;
      });
}

template <typename Op>
Field<Op> Vector(const char* key, Vec3 Op::*member) {
  return FieldOf<Op>(
      key, "Vec",
      [=](const io::Value& v, const TemplatePosture&, Op* out) {
        out->*member = v.Vector(io::kMaxPosition);
      },
      [=](const Op& op, const TemplatePosture&) { return VectorJson(op.*member); });
}

template <typename Op>
Field<Op> Quaternion(Quat Op::*member) {
  return FieldOf<Op>(
      "rotation", "Quat",
      [=](const io::Value& v, const TemplatePosture&, Op* out) { out->*member = v.Quaternion(); },
      [=](const Op& op, const TemplatePosture&) { return QuatJson(op.*member); });
}

inline Quat DegreesOf(const io::Value& value) {
  return ExpSo3(kDegree * value.Vector(io::kMaxPosition));
}

template <typename Op>
Field<Op> Text(const char* key, std::string Op::*member, size_t most_bytes) {
  return FieldOf<Op>(
      key, "string",
      [=](const io::Value& v, const TemplatePosture&, Op* out) {
        out->*member = v.Text(most_bytes);
      },
      [=](const Op& op, const TemplatePosture&) { return report::Json(op.*member); });
}

template <typename Op>
Field<Op> Integer(const char* key, int Op::*member, int most) {
  return FieldOf<Op>(
      key, "number",
      [=](const io::Value& v, const TemplatePosture&, Op* out) {
        out->*member = v.Integer(0, most);
      },
      [=](const Op& op, const TemplatePosture&) { return report::Json(op.*member); });
}

template <typename Op>
Field<Op> Gesture() {
  return Optional(Integer<Op>("gesture", &Op::gesture, std::numeric_limits<int>::max()));
}

template <typename Op>
Field<Op> Bool(const char* key, bool Op::*member) {
  return FieldOf<Op>(
      key, "boolean",
      [=](const io::Value& v, const TemplatePosture&, Op* out) { out->*member = v.Bool(); },
      [=](const Op& op, const TemplatePosture&) { return report::Json(op.*member); });
}

template <typename Op>
OperationRow Row(const char* name, const char* label, const std::vector<Field<Op>>& fields,
                 std::vector<OperationOption> options) {
  OperationRow row{Operation(Op()).index(), name, label, {}, std::move(options), {}, {}};
  for (const Field<Op>& field : fields) {
    row.fields.insert(row.fields.end(), field.keys.begin(), field.keys.end());
  }
  row.read = [fields](const io::Value& op, const TemplatePosture& posture) -> Operation {
    Op out;
    for (const Field<Op>& field : fields) field.read(op, posture, &out);
    return out;
  };
  row.write = [fields, name](const Operation& operation, const TemplatePosture& posture) {
    report::Json out = {{"op", name}};
    for (const Field<Op>& field : fields) field.write(std::get<Op>(operation), posture, &out);
    return out;
  };
  return row;
}

}  // namespace retarget::posing
