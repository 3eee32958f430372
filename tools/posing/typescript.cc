#include "tools/posing/typescript.h"

#include <fmt/format.h>

#include "tools/posing/operation_table.h"

namespace retarget::posing {
namespace {

// A list as prettier writes it that does not fit on one line.
std::string OptionNames() {
  std::string out = "export const optionNames = [\n";
  for (const SolveOption& option : kSolveOptions) out += fmt::format("  \"{}\",\n", option.name);
  return out + "] as const;\nexport type OptionName = (typeof optionNames)[number];\n";
}

// "add_hold" is AddHold.
std::string TypeName(const std::string& name) {
  std::string out;
  bool upper = true;
  for (const char c : name) {
    if (c != '_') out += upper ? static_cast<char>(c - 'a' + 'A') : c;
    upper = c == '_';
  }
  return out;
}

std::string TypeOf(const std::string& name, const std::vector<OperationField>& fields) {
  std::string out = fmt::format("export interface {}Op {{\n  op: \"{}\";\n", TypeName(name), name);
  for (const OperationField& field : fields) {
    out += fmt::format("  {}{}: {};\n", field.key, field.required ? "" : "?", field.type);
  }
  return out + "}\n";
}

}  // namespace

std::string OperationsTypeScript() {
  std::string types, all, with_gesture;
  const auto add = [&](const std::string& name, const std::vector<OperationField>& fields) {
    types += TypeOf(name, fields);
    const std::string member = fmt::format("\n  | {}Op", TypeName(name));
    all += member;
    if (!fields.empty() && fields.back().key == "gesture") with_gesture += member;
  };
  for (const OperationRow& row : OperationTable()) {
    if (!row.name.empty()) add(row.name, row.fields);
  }
  for (const HistoryRow& row : HistoryTable()) add(row.name, {});
  return "// The operations of tools/posing/operation_table.h. Made from them by\n"
         "// `cmake --build build/release --target operations_ts`: not to be edited.\n\n"
         "import type { FigureName } from \"../shared/names\";\n"
         "import type { Camera, HoldEnd, Photo, Quat, Ray, Tangle, Vec } from \"./protocol\";\n\n" +
         OptionNames() + "\n" + types + "\nexport type Op =" + all + ";\n" +
         "\n// Steps of one gesture are one step of the history.\nexport type GestureOp =" +
         with_gesture + ";\n";
}

}  // namespace retarget::posing
