#include "tools/posing/command_line.h"

#include <algorithm>

#include "tools/posing/argument_parser.h"
#include "tools/posing/operation_table.h"

namespace retarget::posing {
namespace {

// "add_hold" as an option, where it has another name there; of the first option alone.
std::string AliasOf(const OperationRow& row, const OperationOption& option) {
  std::string alias = row.name;
  std::replace(alias.begin(), alias.end(), '_', '-');
  return &option == &row.options.front() && alias != option.name ? alias : "";
}

}  // namespace

std::vector<PoseWord> PoseWords() {
  std::vector<PoseWord> words;
  for (const OperationRow& row : OperationTable()) {
    for (const OperationOption& option : row.options) {
      words.push_back({option.name, AliasOf(row, option), option.value, option.help});
    }
  }
  for (const HistoryRow& row : HistoryTable()) words.push_back({row.name, "", "", row.help});
  return words;
}

PoseStep ParsePoseStep(const std::string& name, const std::string& value, const PoseState& state) {
  for (const OperationRow& row : OperationTable()) {
    for (const OperationOption& option : row.options) {
      if (name != option.name && name != AliasOf(row, option)) continue;
      return option.read(ArgumentParser(value, state));
    }
  }
  for (const HistoryRow& row : HistoryTable()) {
    if (name == row.name) return row.step;
  }
  throw InputError("unknown operation");
}

}  // namespace retarget::posing
