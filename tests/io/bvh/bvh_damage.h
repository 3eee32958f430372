// Seeded damage to BVH texts, for the tests and the fuzz program of the reader and the recogniser.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "io/bvh/bvh.h"
#include "io/recognition/recognise.h"

namespace retarget::io {

// The text up to and with its first `num_frames` frames. The declared count stays.
inline std::string CutToFrames(const std::string& text, int num_frames) {
  size_t at = text.find("Frame Time");
  for (int line = 0; line <= num_frames && at != std::string::npos; ++line) {
    at = text.find('\n', at + 1);
  }
  return at == std::string::npos ? text : text.substr(0, at + 1);
}

class Damager {
 public:
  explicit Damager(uint64_t seed) : random_(seed) {}

  // One injury, or a few; mostly one, so that much is still accepted and gets farther.
  std::string Damage(std::string text) {
    do {
      text = DamageOnce(std::move(text));
    } while (Below(3) == 0);
    return text;
  }

 private:
  int Below(size_t count) {
    return static_cast<int>(std::uniform_int_distribution<size_t>(0, count - 1)(random_));
  }

  // Begin of a word or of a line, more often in the hierarchy, where a change has more meanings.
  size_t Place(const std::string& text, char before) {
    const size_t motion = std::min(text.find("MOTION"), text.size());
    const size_t limit = Below(3) > 0 ? motion : text.size();
    const size_t at = text.find(before, static_cast<size_t>(Below(limit + 1)));
    return at == std::string::npos ? text.size() : at + 1;
  }

  std::string DamageOnce(std::string text) {
    if (text.empty()) return text;
    switch (Below(9)) {
      case 0:  // a byte becomes another, or a digit
        text[Below(text.size())] = static_cast<char>(Below(2) == 0 ? Below(256) : '0' + Below(10));
        return text;
      case 1:  // a bit flips in the hierarchy
        text[Below(std::min<size_t>(text.size(), 2000))] ^= static_cast<char>(1 << Below(8));
        return text;
      case 2:  // the end is missing
        return text.substr(0, Below(text.size()));
      case 3:  // a line is missing
        return EditLine(std::move(text), 0);
      case 4:  // a line is there twice, or very often
        return EditLine(std::move(text), Below(8) == 0 ? 500 : 2);
      case 5:
        return ReplaceWord(std::move(text), kOddWords[Below(std::size(kOddWords))]);
      case 6:
        return SwapWords(std::move(text));
      case 7: {  // a piece is missing
        const size_t at = Below(text.size());
        return text.erase(at, Below(200));
      }
      default: {  // a piece moves elsewhere
        const std::string piece = text.substr(Below(text.size()), Below(300));
        return text.insert(Below(text.size()), piece);
      }
    }
  }

  std::string EditLine(std::string text, int copies) {
    const size_t begin = Place(text, '\n');
    const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    if (begin >= end) return text;
    const std::string line = text.substr(begin, end - begin);
    std::string lines;
    for (int c = 0; c < copies; ++c) lines += line;
    return text.replace(begin, end - begin, lines);
  }

  std::string ReplaceWord(std::string text, std::string_view word) {
    const size_t begin = Place(text, ' ');
    const size_t end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
    return begin < end ? text.replace(begin, end - begin, word) : text;
  }

  std::string SwapWords(std::string text) {
    const size_t a = Place(text, ' '), b = Place(text, ' ');
    const size_t a_end = std::min(text.find_first_of(" \t\r\n", a), text.size());
    const size_t b_end = std::min(text.find_first_of(" \t\r\n", b), text.size());
    if (a >= a_end || b >= b_end) return text;
    const std::string word_a = text.substr(a, a_end - a), word_b = text.substr(b, b_end - b);
    text = text.replace(std::max(a, b), (a > b ? a_end : b_end) - std::max(a, b),
                        a > b ? word_b : word_a);
    return text.replace(std::min(a, b), (a < b ? a_end : b_end) - std::min(a, b),
                        a < b ? word_b : word_a);
  }

  static constexpr std::string_view kOddWords[] = {
      "1e308",     "-1e308",     "1e400",      "nan",      "inf",
      "-inf",      "0",          "1e-320",     "1e9",      "1e8",
      "-1",        "2147483648", "0x10",       "--1",      "1,5",
      "{",         "}",          "JOINT",      "End Site", "ROOT",
      "MOTION",    "OFFSET",     "CHANNELS 0", "\n",       "999999999999999999999",
      "Xposition", "Zrotation",  "\xFF\xFE",   "Hips",     "",
      "1.#QNAN"};

  std::mt19937_64 random_;
};

// Reads and recognises damaged text, and writes it back where that succeeds. True if it was
// accepted, false if refused with InputError; anything else escapes. Messages must be one line.
inline bool ReadsOrRefuses(const std::string& text) {
  try {
    const BvhFile file = ParseBvh(text, "damaged.bvh");
    const RigFacts facts = Recognise(file.motion, {}, "damaged.bvh");
    if (MapTable(facts, file.motion).empty() || MapJson(facts, file.motion).empty()) {
      throw std::logic_error("empty report");
    }
    ParseBvh(FormatBvh(file, file.motion), "again.bvh");
    return true;
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.empty() || message.find('\n') != std::string::npos) {
      throw std::logic_error("message is not one line: " + message);
    }
    return false;
  }
}

}  // namespace retarget::io
