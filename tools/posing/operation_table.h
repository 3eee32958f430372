// The one table of operations: their names on the command line and in JSON, their fields and their
// labels. The command line (command_line.h), the messages of the studio (json.h), its page
// (typescript.h) and the history (label.h) all come from it.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "io/text/document.h"
#include "tools/posing/argument_parser.h"
#include "tools/posing/operations.h"
#include "tools/report/report.h"

namespace retarget::posing {

// Of an operation in JSON.
struct OperationField {
  std::string key;
  std::string type;  // of TypeScript
  bool required = true;
};

// Of the command line.
struct OperationOption {
  std::string name;   // "drag"
  std::string value;  // how its value reads; empty: takes none
  std::string help;
  std::function<Operation(const ArgumentParser&)> read;
};

struct OperationRow {
  size_t index = 0;   // in Operation
  std::string name;   // in JSON: "add_hold"; empty: not to be asked for
  std::string label;  // in the history: "new hold"
  std::vector<OperationField> fields;
  std::vector<OperationOption> options;
  std::function<Operation(const io::Value& op, const TemplatePosture& posture)> read;
  std::function<report::Json(const Operation&, const TemplatePosture& posture)> write;
};

// The rows, by kind; each knows its place in Operation.
std::array<OperationRow, 6> SolverRows();
std::array<OperationRow, 11> HandRows();
std::array<OperationRow, 12> ContentRows();

// In the order of Operation.
const std::array<OperationRow, std::variant_size_v<Operation>>& OperationTable();
inline const OperationRow& RowOf(const Operation& operation) {
  return OperationTable()[operation.index()];
}

// Undo and redo, which have no fields.
struct HistoryRow {
  std::string name;  // on the command line and in JSON
  std::string help;
  HistoryStep step;
};
const std::array<HistoryRow, 2>& HistoryTable();

}  // namespace retarget::posing
