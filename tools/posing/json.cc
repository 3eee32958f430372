#include "tools/posing/json.h"

#include <algorithm>

#include "tools/posing/operation_table.h"

namespace retarget::posing {
namespace {

// In the order of the table, then undo and redo.
const std::vector<std::string>& Names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const OperationRow& row : OperationTable()) {
      if (!row.name.empty()) all.push_back(row.name);
    }
    for (const HistoryRow& row : HistoryTable()) all.push_back(row.name);
    return all;
  }();
  return names;
}

bool IsCalled(const OperationRow& row, const std::string& name) {
  if (row.name.empty() || row.options.empty()) return !name.empty() && row.name == name;
  std::string option = row.options.front().name;
  std::replace(option.begin(), option.end(), '-', '_');
  return name == row.name || name == option;
}

}  // namespace

PoseStep ParsePoseJson(const io::Value& op, const TemplatePosture& posture) {
  const io::Value name = op.Require("op");
  for (const OperationRow& row : OperationTable()) {
    if (!IsCalled(row, name.text())) continue;
    std::vector<std::string> keys;
    for (const OperationField& field : row.fields) keys.push_back(field.key);
    keys.push_back("op");
    op.CheckKeys(keys);
    return row.read(op, posture);
  }
  const std::string& step = Names()[static_cast<size_t>(name.Name("operation", Names()))];
  op.CheckKeys({"op"});
  return step == HistoryTable()[0].name ? HistoryTable()[0].step : HistoryTable()[1].step;
}

report::Json PoseJson(const Operation& operation, const TemplatePosture& posture) {
  return RowOf(operation).write(operation, posture);
}

}  // namespace retarget::posing
