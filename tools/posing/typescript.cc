#include "tools/posing/typescript.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/posing/operation_table.h"

namespace retarget::posing {
namespace {

constexpr size_t kLineLength = 100;

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

// A union of types, on one line where it fits.
std::string UnionOf(const char* name, const std::vector<std::string>& types) {
  const std::string line = fmt::format("  {};", fmt::join(types, " | "));
  const bool fits = line.size() <= kLineLength;
  return fmt::format("export type {} =\n{}\n", name,
                     fits ? line : fmt::format("  | {};", fmt::join(types, "\n  | ")));
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
  std::string types;
  std::vector<std::string> all, with_gesture;
  const auto add = [&](const std::string& name, const std::vector<OperationField>& fields) {
    types += TypeOf(name, fields);
    all.push_back(TypeName(name) + "Op");
    if (!fields.empty() && fields.back().key == "gesture") with_gesture.push_back(all.back());
  };
  for (const OperationRow& row : OperationTable()) {
    if (!row.name.empty()) add(row.name, row.fields);
  }
  for (const HistoryRow& row : HistoryTable()) add(row.name, {});
  return "// The operations of tools/posing/operation_table.h. Made from them by\n"
         "// `cmake --build build/release --target operations_ts`: not to be edited.\n\n"
         "import type { FigureName } from \"../../shared/names\";\n"
         "import type { Camera, HoldEnd, Photo, Quat, Ray, Tangle, Vec } from \"./protocol\";\n\n" +
         OptionNames() + "\n" + types + "\n" + UnionOf("Op", all) +
         "\n// Steps of one gesture are one step of the history.\n" +
         UnionOf("GestureOp", with_gesture);
}

}  // namespace retarget::posing
