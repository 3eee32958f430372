#include "tools/report/requirement_json.h"

#include <charconv>
#include <regex>

#include "tools/report/json_reading.h"
#include "tools/report/requirement_text.h"

namespace retarget::report {
namespace {

using Kind = solver::RequirementKind;

constexpr Kind kKinds[] = {
    Kind::kTangle,    Kind::kPassThroughs,  Kind::kPenetration,      Kind::kPenetrationOver1cm,
    Kind::kFootDrift, Kind::kFootTravel,    Kind::kFootAcceleration, Kind::kFloor,
    Kind::kHold,      Kind::kSegmentLength, Kind::kWriteBack,        Kind::kPoseError,
    Kind::kTrunkTilt, Kind::kFloating,      Kind::kJointLimit,       Kind::kJerk};

Json OrNull(int number) { return number < 0 ? Json(nullptr) : Json(number); }

int NumberOr(const Json& json, const char* key, int otherwise) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number_integer() ? at->get<int>() : otherwise;
}

// What reports without `kind` say in their names: "tangle 2", "foot drift a".
void ReadOldName(ReadRequirement* out) {
  for (const Kind kind : kKinds) {
    solver::RequirementCheck check{.kind = kind};
    const std::string all = NameOf(check);
    if (out->name == all) out->kind = kind;
    if (out->name.size() < all.size() + 2 || out->name.compare(0, all.size() + 1, all + " ") != 0) {
      continue;
    }
    const std::string rest = out->name.substr(all.size() + 1);
    int number = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    const bool numbered = error == std::errc() && end == rest.data() + rest.size() && number > 0;
    if (!numbered && rest != kFigure[0] && rest != kFigure[1]) continue;
    out->kind = kind;
    if (numbered) out->item = number - 1;
    if (!numbered) out->figure = rest == kFigure[0] ? 0 : 1;
  }
  static const std::regex frame("frame ([0-9]{1,9})");
  std::smatch match;
  if (std::regex_search(out->where, match, frame)) out->frame = std::stoi(match[1]);
}

}  // namespace

Json LimbsJson(const std::vector<solver::LimbNode>& limbs, const std::array<Body, 2>& body) {
  Json out = Json::array();
  for (const solver::LimbNode& limb : limbs) {
    out.push_back(
        {{"figure", kFigure[limb.figure]}, {"node", body[limb.figure].nodes[limb.node].name}});
  }
  return out;
}

void AddPlace(const solver::RequirementCheck& check, Json* to) {
  (*to)["kind"] = KindName(check.kind);
  (*to)["item"] = OrNull(check.item);
  (*to)["figure"] = check.figure < 0 ? Json(nullptr) : Json(kFigure[check.figure]);
  (*to)["frame"] = OrNull(check.frame);
}

Json ChecksJson(const std::vector<solver::RequirementCheck>& checks,
                const std::array<Body, 2>& body) {
  Json out = Json::array();
  for (const solver::RequirementCheck& c : checks) {
    Json check = {{"name", NameOf(c)},
                  {"value", c.judged() ? Json(c.value) : Json(nullptr)},
                  {"limit", c.limit},
                  {"unit", UnitOf(c.kind)},
                  {"met", c.met},
                  {"judged", c.judged()},
                  {"where", WorstPlace(c, body)}};
    AddPlace(c, &check);
    check["bound"] = c.bound ? Json(*c.bound) : Json(nullptr);
    check["limbs"] = LimbsJson(c.limbs, body);
    out.push_back(check);
  }
  return out;
}

ReadRequirement RequirementFromJson(const Json& json) {
  ReadRequirement out;
  json.at("met");  // throws where this is no requirement
  out.value = NumberAt(json, "/value");
  out.limit = NumberAt(json, "/limit");
  out.met = json.value("met", true);
  out.name = TextAt(json, "/name");
  out.unit = TextAt(json, "/unit");
  out.where = TextAt(json, "/where");
  if (!json.contains("kind")) {
    ReadOldName(&out);
    return out;
  }
  const std::string kind = TextAt(json, "/kind"), figure = TextAt(json, "/figure");
  for (const Kind k : kKinds) {
    if (kind == KindName(k)) out.kind = k;
  }
  out.item = NumberOr(json, "item", -1);
  out.frame = NumberOr(json, "frame", -1);
  for (int f = 0; f < 2; ++f) {
    if (figure == kFigure[f]) out.figure = f;
  }
  return out;
}

std::vector<ReadRequirement> RequirementsOf(const Json& report) {
  std::vector<ReadRequirement> out;
  if (!report.contains("requirements")) return out;
  for (const Json& check : report.at("requirements").get_ref<const Json::array_t&>()) {
    out.push_back(RequirementFromJson(check));
  }
  return out;
}

double LimitOf(const std::vector<ReadRequirement>& requirements, Kind kind, int figure, int item) {
  for (const ReadRequirement& r : requirements) {
    const bool same =
        r.Is(kind) && (figure < 0 || r.figure == figure) && (item < 0 || r.item == item);
    if (same) return r.limit;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace retarget::report
