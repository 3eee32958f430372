// Seeded damage to Acclaim files, and the check of whatever comes out of it.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "io/acclaim/acclaim.h"
#include "io/recognition/recognise.h"
#include "model/geometry/so3.h"
#include "tests/io/bvh/bvh_damage.h"

namespace retarget::io {

// The motion up to and with its frame `num_frames`, of files that number them from 1.
inline std::string CutAmc(const std::string& text, int num_frames) {
  size_t at = text.find("\n" + std::to_string(num_frames + 1) + "\n");
  if (at == std::string::npos) at = text.find("\n" + std::to_string(num_frames + 1) + "\r\n");
  return at == std::string::npos ? text : text.substr(0, at + 1);
}

// Injures one of the two texts, the skeleton more often; sometimes with words of the format.
inline void DamageAcclaim(uint64_t seed, std::string* asf, std::string* amc) {
  static constexpr const char* kWords[] = {"begin", "end",  "dof",  "rx",      "l",   ":root",
                                           "root",  "axis", "#",    ":",       "XYZ", "length",
                                           "order", "name", "rads", ":RADIANS"};
  std::mt19937_64 random(seed);
  std::string* text = random() % 3 > 0 ? asf : amc;
  if (random() % 3 > 0) {
    *text = Damager(seed).Damage(*text);
    return;
  }
  const size_t begin = text->find_first_not_of(" \r\n", random() % text->size());
  if (begin == std::string::npos) return;
  const size_t end = text->find_first_of(" \r\n", begin);
  text->replace(begin, end - begin, kWords[random() % std::size(kWords)]);
}

// As ReadsOrRefuses for BVH.
inline bool ReadsOrRefusesAcclaim(const std::string& asf, const std::string& amc) {
  try {
    const AcclaimFile file = ParseAcclaim(asf, "damaged.asf", amc, "damaged.amc");
    const RigFacts facts = Recognise(file.motion, {}, "damaged.amc");
    if (MapTable(facts, file.motion).empty() || MapJson(facts, file.motion).empty()) {
      throw std::logic_error("empty report");
    }
    RigMotion turned = file.motion;  // farther than its bones can hold
    for (Quat& q : turned.frames[0].rotation) q = q * ExpSo3(Vec3(0.1, -0.2, 0.15));
    ParseAcclaim(FormatAsf(file, 0.5), "again.asf", FormatAmc(file, turned), "again.amc");
    return true;
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.empty() || message.find_first_of("\r\n") != std::string::npos) {
      throw std::logic_error("message is not one line: " + message);
    }
    return false;
  }
}

}  // namespace retarget::io
