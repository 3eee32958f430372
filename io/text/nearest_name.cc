#include "io/text/nearest_name.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace retarget::io {
namespace {

constexpr size_t kLongestWord = 64;  // characters compared: keeps the cost of odd input small
constexpr size_t kLongestList = 25;  // names that one message lists

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Half of the longer word may differ.
bool IsNear(std::string_view word, std::string_view name) {
  return 2 * EditDistance(word, name) <= std::max(word.size(), name.size());
}

}  // namespace

size_t EditDistance(std::string_view a, std::string_view b) {
  a = a.substr(0, kLongestWord);
  b = b.substr(0, kLongestWord);
  const size_t width = b.size() + 1;
  // Rows i - 2, i - 1 and i of the table of distances of prefixes.
  std::vector<size_t> before(width), last(width), row(width);
  std::iota(last.begin(), last.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j < width; ++j) {
      const char ca = Lower(a[i - 1]), cb = Lower(b[j - 1]);
      row[j] = std::min({last[j - 1] + (ca == cb ? 0 : 1), last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && ca == Lower(b[j - 2]) && Lower(a[i - 2]) == cb) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before.swap(last);
    last.swap(row);
  }
  return last.back();
}

const std::string& NearestName(std::string_view word, const std::vector<std::string>& names) {
  assert(!names.empty());
  return *std::min_element(names.begin(), names.end(), [&](const auto& x, const auto& y) {
    return EditDistance(word, x) < EditDistance(word, y);
  });
}

std::string Suggestion(std::string_view word, const std::vector<std::string>& names,
                       const std::string& prefix) {
  const std::string& nearest = NearestName(word, names);
  if (IsNear(word, nearest) || names.size() > kLongestList) {
    return ", did you mean \"" + prefix + nearest + "\"?";
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return ", expected one of " + list;
}

}  // namespace retarget::io
