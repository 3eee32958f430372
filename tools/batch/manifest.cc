#include "tools/batch/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "io/text/csv.h"
#include "io/text/json.h"
#include "io/text/nearest_name.h"
#include "io/text/read_file.h"
#include "io/text/yaml.h"
#include "model/settings.h"
#include "tools/batch/manifest_paths.h"

namespace retarget::batch {
namespace {

using Kind = io::DocumentNode::Kind;

// A cell before its sweep is taken apart.
struct Cell {
  std::string column, text;
  std::vector<std::string> list;  // JSON and YAML may say several values themselves
};

struct Row {
  std::string place;
  std::vector<Cell> cells;
};

class Columns {
 public:
  explicit Columns(const std::vector<Option>& options) : options_(options) {
    names_ = {"id"};
    for (const Option& option : options) names_.push_back(option.name);
    const Settings defaults;
    VisitSettings(defaults, [&](const char* key, auto&&...) { names_.push_back(key); });
  }

  // "clip_a", "--clip-a" and "clip-a" are one.
  std::string Canonical(const std::string& written, const std::string& place) const {
    std::string name = written;
    if (name.find('.') == std::string::npos) std::replace(name.begin(), name.end(), '_', '-');
    name.erase(0, std::min(name.find_first_not_of('-'), name.size()));
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
      throw InputError(
          fmt::format("{}: unknown column \"{}\"{}", place, written, io::Suggestion(name, names_)));
    }
    return name;
  }

  bool IsFlag(const std::string& name) const {
    return std::any_of(options_.begin(), options_.end(),
                       [&](const Option& o) { return o.name == name && o.is_flag; });
  }

 private:
  const std::vector<Option>& options_;
  std::vector<std::string> names_;
};

std::vector<Row> RowsOfCsv(const std::string& text, const std::string& name) {
  const std::vector<io::CsvRow> table = io::ParseCsv(text, name);
  std::vector<Row> rows;
  for (size_t r = 1; r < table.size(); ++r) {
    Row row{fmt::format("{}:{}", name, table[r].line), {}};
    if (table[r].cells.size() > table[0].cells.size()) {
      throw InputError(fmt::format("{}: found {} cells, expected {} as in the first line",
                                   row.place, table[r].cells.size(), table[0].cells.size()));
    }
    for (size_t c = 0; c < table[r].cells.size(); ++c) {
      row.cells.push_back({table[0].cells[c], table[r].cells[c], {}});
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Row RowOfMap(const io::Value& map, const std::string& place) {
  map.CheckMap();
  Row row{place, {}};
  for (const io::Value& value : map.Items()) {
    Cell cell{value.key(), "", {}};
    if (value.kind() == Kind::kList) {
      for (const io::Value& item : value.List()) {
        if (item.kind() != Kind::kScalar) item.RefuseExpecting("a number or a text");
        cell.list.push_back(item.text());
      }
      if (cell.list.empty()) value.RefuseExpecting("one value or more");
    } else if (value.kind() == Kind::kScalar) {
      cell.text = value.text();
    } else if (!value.is_null()) {
      value.RefuseExpecting("a number, a text or a list of them");
    }
    row.cells.push_back(std::move(cell));
  }
  return row;
}

std::vector<Row> RowsOfJsonLines(const std::string& text, const std::string& name) {
  std::vector<Row> rows;
  int line = 1;
  for (size_t at = 0; at < text.size(); ++line) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string one = text.substr(at, end - at);
    at = end + 1;
    if (one.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = fmt::format("{}:{}", name, line);
    try {
      const io::Document document = io::ParseJson(one);
      rows.push_back(RowOfMap(document.root(), place));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", place, error.what()));
    }
  }
  return rows;
}

std::vector<Row> RowsOfYaml(const std::string& text, const std::string& name) {
  const io::Document document = io::ParseYaml(text, name);
  std::vector<Row> rows;
  for (const io::Value& item : document.root().List()) {
    rows.push_back(RowOfMap(item, fmt::format("{}: {}", name, item.path())));
  }
  return rows;
}

std::vector<Row> RowsOf(const std::string& text, const std::string& name) {
  const size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string::npos) return {};
  if (text[first] == '{') return RowsOfJsonLines(text, name);
  if (text[first] == '-' || text[first] == '[' || text[first] == '#') return RowsOfYaml(text, name);
  return RowsOfCsv(text, name);
}

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    const size_t first = std::min(text.find_first_not_of(' ', at), end);
    size_t last = end;
    while (last > first && text[last - 1] == ' ') --last;
    parts.push_back(text.substr(first, last - first));
    at = end + 1;
  }
  return parts;
}

// For the name of a folder: what a value leaves of itself; its number where that is not unique.
std::vector<std::string> NamesOfValues(const std::vector<std::string>& values) {
  std::vector<std::string> names;
  std::set<std::string> different;
  for (const std::string& value : values) {
    std::string name = std::filesystem::path(value).filename().string();
    for (char& c : name) {
      if (!isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+') c = '_';
    }
    names.push_back(name);
    different.insert(name);
  }
  if (different.size() == names.size()) return names;
  for (size_t k = 0; k < names.size(); ++k) names[k] = std::to_string(k + 1);
  return names;
}

constexpr size_t kLongestId = 200;  // bytes; a file system allows 255

void CheckId(const std::string& id, const std::string& place) {
  const bool plain = std::all_of(id.begin(), id.end(), [](unsigned char c) {
    return c > ' ' && c != '/' && c != '\\' && c != '~' && c != 0x7f;
  });
  if (id.empty()) throw InputError(place + ": id: found nothing, expected a name for the pair");
  if (!plain || id[0] == '.' || id.size() > kLongestId) {
    throw InputError(
        fmt::format("{}: id: found \"{}\", expected the name of a folder: no blanks, "
                    "no slashes, no '~', no dot in front, at most {} bytes",
                    place, id, kLongestId));
  }
  if (id.starts_with("status.") || id.starts_with("index.") || id.starts_with("manifest.")) {
    throw InputError(fmt::format(
        "{}: id: found \"{}\", expected another name: the batch itself writes files called so",
        place, id));
  }
}

class Expansion {
 public:
  Expansion(const Columns& columns, const std::string& folder)
      : columns_(columns), folder_(folder) {}

  void Add(const Row& row, const std::vector<Cell>& common) {
    Pair pair{"", "", row.place};
    std::vector<Cell> cells;
    std::set<std::string> given;
    for (const Cell& cell : row.cells) {
      const std::string name = columns_.Canonical(cell.column, row.place);
      if (!given.insert(name).second) {
        throw InputError(fmt::format("{}: column \"{}\" is given twice", row.place, cell.column));
      }
      if (name == "id") {
        if (!cell.list.empty()) throw InputError(row.place + ": id: found a list, expected a name");
        pair.row_id = cell.text;
      } else if (!cell.text.empty() || !cell.list.empty()) {
        cells.push_back({name, cell.text, cell.list});
      } else {
        given.erase(name);  // an empty cell says nothing
      }
    }
    for (const Cell& cell : common) {
      if (given.insert(cell.column).second) cells.push_back(cell);
    }
    CheckId(pair.row_id, row.place);
    for (const char* name : {"clip-a", "clip-b", "template"}) {
      if (!given.count(name)) {
        throw InputError(fmt::format("{}: column \"{}\" is missing", row.place, name));
      }
    }
    pair.id = pair.row_id;
    Multiply(cells, 0, pair);
  }

  std::vector<Pair> pairs;

 private:
  void Multiply(const std::vector<Cell>& cells, size_t k, const Pair& pair) {
    if (k == cells.size()) {
      CheckId(pair.id, pair.place);
      if (!ids_.insert(pair.id).second) {
        throw InputError(fmt::format("{}: id: \"{}\" is there twice", pair.place, pair.id));
      }
      pairs.push_back(pair);
      return;
    }
    const Cell& cell = cells[k];
    const bool splits = cell.list.empty() && !IsWholeColumn(cell.column);
    const std::vector<std::string> values = !cell.list.empty() ? cell.list
                                            : splits           ? Split(cell.text)
                                                               : std::vector{cell.text};
    const std::vector<std::string> names = NamesOfValues(values);
    for (size_t v = 0; v < values.size(); ++v) {
      if (values[v].empty()) {
        throw InputError(fmt::format("{}: {}: found \"{}\", expected a value between two commas",
                                     pair.place, cell.column, cell.text));
      }
      Pair next = pair;
      next.columns.emplace_back(cell.column, Opened(cell.column, values[v], pair.place));
      if (values.size() > 1) {
        next.swept.push_back(cell.column);
        next.id += fmt::format("@{}={}", cell.column, names[v]);
      }
      Multiply(cells, k + 1, next);
    }
  }

  std::string Opened(const std::string& column, const std::string& value,
                     const std::string& place) const {
    if (columns_.IsFlag(column) && value != "true" && value != "false") {
      throw InputError(
          fmt::format("{}: {}: found \"{}\", expected true or false", place, column, value));
    }
    try {
      return IsPathColumn(column) ? PathFrom(folder_, value) : value;
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}: {}", place, column, error.what()));
    }
  }

  const Columns& columns_;
  const std::string& folder_;
  std::set<std::string> ids_;
};

}  // namespace

std::string Pair::Column(const std::string& name) const {
  for (const auto& [column, value] : columns) {
    if (column == name) return value;
  }
  return "";
}

std::vector<Pair> ParseManifest(const std::string& text, const std::string& name,
                                const std::string& folder, const std::vector<Option>& options,
                                const Common& common) {
  const Columns columns(options);
  std::vector<Cell> shared;
  for (const std::string& assignment : common) {
    const size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals + 1 == assignment.size()) {
      throw InputError(fmt::format("{}: expected column=value", assignment));
    }
    const std::string column = columns.Canonical(assignment.substr(0, equals), assignment);
    if (column == "id") throw InputError(assignment + ": every pair needs an id of its own");
    shared.push_back({column, assignment.substr(equals + 1), {}});
  }
  Expansion expansion(columns, folder);
  for (const Row& row : RowsOf(text, name)) expansion.Add(row, shared);
  if (expansion.pairs.empty()) throw InputError(name + ": found no pairs, expected one or more");
  return expansion.pairs;
}

std::vector<Pair> ReadManifest(const std::string& path, const std::vector<Option>& options,
                               const Common& common) {
  return ParseManifest(io::ReadFilledFile(path, "a manifest"), path,
                       std::filesystem::path(path).parent_path().string(), options, common);
}

}  // namespace retarget::batch
