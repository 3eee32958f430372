// Unit and up axis; ParseUnits of io/recognition/recognise.h.
#include "io/recognition/rig_units.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

namespace retarget::io {
namespace {

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {{"m", 1},    {"cm", 0.01},   {"mm", 0.001},
                           {"dm", 0.1}, {"in", 0.0254}, {"cmu", 0.0254 / 0.45}};

// Statures (m): of any human, and of most adults.
constexpr double kSmallest = 0.9, kTallest = 2.3, kUsual = 1.70;
constexpr double kUsualSmallest = 1.4, kUsualTallest = 2.1;

std::string UnitName(double metres) {
  for (const Unit& unit : kUnits) {
    if (std::abs(metres - unit.metres) <= 1e-6 * unit.metres) return unit.name;
  }
  return fmt::format("{:g}", metres);
}

bool IsUsual(double stature) { return stature >= kUsualSmallest && stature <= kUsualTallest; }

// The listed unit that makes `height` (file units) come nearest to the stature that is expected:
// an adult's before any other; none where it makes no human.
const Unit* GuessUnit(double height, double expected) {
  const Unit* best = nullptr;
  const auto rank = [&](const Unit& unit) {
    const double stature = height * unit.metres;
    return std::pair(!IsUsual(stature), std::abs(std::log(stature / expected)));
  };
  for (const Unit& unit : kUnits) {
    const double stature = height * unit.metres;
    if (stature < kSmallest || stature > kTallest) continue;
    if (best == nullptr || rank(unit) < rank(*best)) best = &unit;
  }
  return best;
}

// Where the file does not say its unit. A stature that the user gives settles what the table leaves
// open: a listed unit that comes near to it, else the unit that makes the figure just so tall.
void GuessUnit(double height, const RecogniseOptions& options, const std::string& file,
               RigFacts* facts) {
  constexpr double kNear = 0.1;  // of the stature that was given
  const double given = options.stature;
  const Unit* unit = GuessUnit(height, given > 0 ? given : kUsual);
  if (given > 0) {
    const bool adult = unit != nullptr && IsUsual(height * unit->metres);
    const bool near = unit != nullptr && std::abs(height * unit->metres - given) <= kNear * given;
    if (!adult && !near) {
      facts->metres_per_unit = given / height;
      facts->notes.push_back(
          fmt::format("no unit is known that makes the figure, {:.4g} units tall, an adult: the "
                      "unit is taken from its stature, {:.4g} m",
                      height, facts->metres_per_unit));
      return;
    }
  }
  if (unit == nullptr) {
    throw InputError(
        fmt::format("{}: the figure is {:.4g} units tall, no human height in m, cm, "
                    "mm, dm, in or cmu; give its unit with {}, or its height with {}",
                    file, height, options.words.units, options.words.stature));
  }
  facts->metres_per_unit = unit->metres;
}

// The rig as its offsets draw it: nothing turned.
RigFrame ZeroFrame(const Rig& rig) {
  RigFrame frame;
  for (const RigJoint& joint : rig.joints) {
    frame.translation.push_back(joint.offset);
    frame.rotation.push_back(Quat::Identity());
  }
  return frame;
}

}  // namespace

void FindUnit(double height, const RecogniseOptions& options, const std::string& file,
              RigFacts* facts) {
  if (!std::isfinite(height) || height <= 0) {
    throw InputError(file + ": no human figure: the joints lie in one point");
  }
  if (options.metres_per_unit) {
    facts->metres_per_unit = *options.metres_per_unit;
    if (!std::isfinite(facts->metres_per_unit) || facts->metres_per_unit <= 0) {
      throw InputError(file + ": units must be a positive number of metres");
    }
  } else {
    GuessUnit(height, options, file, facts);
  }
  facts->unit_name = UnitName(facts->metres_per_unit);
  facts->stature = height * facts->metres_per_unit;
  if (!IsUsual(facts->stature) && options.stature <= 0) {
    facts->notes.push_back(fmt::format("a stature of {:.2f} m is unusual", facts->stature) +
                           (options.metres_per_unit ? ""
                                                    : ": if the unit is not " + facts->unit_name +
                                                          ", give it with " + options.words.units));
  }
}

void FindUp(const RigMeasure& figure, const RecogniseOptions& options, const std::string& file,
            RigFacts* facts) {
  if (options.up && *options.up != 'y' && *options.up != 'z') {
    throw InputError(file + ": the up axis must be y or z");
  }
  constexpr double kStands = 0.7;  // cosine
  const auto stature = [&](const PosedRig& pose) -> Vec3 {
    return At(pose, figure.points.neck) - MidAnkle(pose, figure.points);
  };
  const auto along = [](const Vec3& v, char up) { return up == 'y' ? v.y() : v.z(); };
  Vec3 mean = Vec3::Zero();
  for (const PosedRig& pose : figure.poses) mean += stature(pose);
  facts->up = mean.y() >= mean.z() ? 'y' : 'z';
  if (along(mean, facts->up) < kStands * mean.norm()) {  // who lies tells by how he is drawn
    const Vec3 drawn = stature(PoseRig(*figure.rig, ZeroFrame(*figure.rig)));
    for (const char up : {'y', 'z'}) {
      if (along(drawn, up) > kStands * drawn.norm()) facts->up = up;
    }
  }
  facts->up = options.up.value_or(facts->up);
  if (along(mean, facts->up) < kStands * mean.norm()) {
    facts->notes.push_back(
        fmt::format("the figure seldom stands along +{}: if that is not up, give the axis with {}",
                    facts->up, options.words.up));
  }
}

Vec3 UpAxis(const RigFacts& facts) { return facts.up == 'y' ? Vec3::UnitY() : Vec3::UnitZ(); }

std::optional<double> ParseUnits(const std::string& text) {
  for (const Unit& unit : kUnits) {
    if (text == unit.name) return unit.metres;
  }
  double metres = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, metres);
  if (error != std::errc() || stop != end || !std::isfinite(metres) || metres <= 0) {
    return std::nullopt;
  }
  return metres;
}

}  // namespace retarget::io
