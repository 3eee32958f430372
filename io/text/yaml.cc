// The one place that knows yaml-cpp.
#include "io/text/yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "io/text/quoted.h"
#include "io/text/read_file.h"

namespace retarget::io {
namespace {

using Kind = DocumentNode::Kind;

constexpr size_t kMaxFile = size_t{4} << 20;  // bytes
constexpr size_t kMaxDepth = 32;              // open lists and maps
constexpr size_t kMaxKey = 64;                // bytes of a key

// Builds the tree of a document from yaml-cpp's events.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& name) : name_(name) { root_.line = 1; }

  DocumentNode TakeRoot() { return std::move(root_); }

  [[noreturn]] void Fail(const YAML::Mark& mark, const std::string& message) const {
    throw InputError(Place(mark) + ": " + message);
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) Fail(mark, "expected the end of the file, found a second document");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Close(Open(Kind::kNothing, mark, "", anchor));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    Fail(mark, "expected a value, found an alias (*name): write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    if (ExpectsKey()) return TakeKey(mark, tag, anchor, text);
    DocumentNode value = Open(Kind::kScalar, mark, tag, anchor);
    value.text = text;
    value.quoted = tag == "!";
    Close(std::move(value));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Push(Open(Kind::kList, mark, tag, anchor), mark);
  }
  void OnSequenceEnd() override { Pop(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Push(Open(Kind::kMap, mark, tag, anchor), mark);
  }
  void OnMapEnd() override { Pop(); }

 private:
  // A list or map whose end has not come yet.
  struct Unfinished {
    DocumentNode value;
    std::optional<std::string> key;  // read, its value not yet
    int key_line = 0;
    std::map<std::string, int> first_line;  // of every key so far
  };

  static int LineOf(const YAML::Mark& mark) { return std::max(mark.line, 0) + 1; }
  std::string Place(const YAML::Mark& mark) const {
    return fmt::format("{}:{}", name_, LineOf(mark));
  }

  // "a.root.position", of a key of the innermost map.
  std::string KeyPath(const std::string& key) const {
    std::string path;
    for (const Unfinished& unfinished : open_) {
      const DocumentNode& open = unfinished.value;
      if (!open.key.empty()) path += (path.empty() ? "" : ".") + open.key;
      if (open.kind == Kind::kList) path += fmt::format("[{}]", open.children.size());
    }
    return path + (path.empty() ? "" : ".") + key;
  }

  bool ExpectsKey() const {
    return !open_.empty() && open_.back().value.kind == Kind::kMap && !open_.back().key;
  }

  void CheckPlain(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) const {
    if (anchor != YAML::NullAnchor) Fail(mark, "expected a value, found an anchor (&name)");
    if (!tag.empty() && tag != "?" && tag != "!") {
      Fail(mark, "expected a value, found the tag " + Quoted(tag));
    }
  }

  void TakeKey(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
               const std::string& key) {
    CheckPlain(mark, tag, anchor);
    if (key.empty() || key.size() > kMaxKey || std::any_of(key.begin(), key.end(), IsControl)) {
      Fail(mark, "expected a key, found " + Quoted(key));
    }
    Unfinished& map = open_.back();
    const auto [first, is_new] = map.first_line.emplace(key, mark.line + 1);
    if (!is_new) {
      Fail(mark,
           fmt::format("key \"{}\" is given twice, first in line {}", KeyPath(key), first->second));
    }
    map.key = key;
    map.key_line = mark.line + 1;
  }

  // A value with its place in the tree.
  DocumentNode Open(Kind kind, const YAML::Mark& mark, const std::string& tag,
                    YAML::anchor_t anchor) {
    CheckPlain(mark, tag, anchor);
    if (ExpectsKey()) Fail(mark, "expected a plain word as key");
    DocumentNode value;
    value.kind = kind;
    value.line = LineOf(mark);
    if (open_.empty() || open_.back().value.kind == Kind::kList) return value;
    Unfinished& parent = open_.back();
    value.key = *std::exchange(parent.key, std::nullopt);
    value.line = parent.key_line;
    return value;
  }

  void Close(DocumentNode value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else {
      open_.back().value.children.push_back(std::move(value));
    }
  }

  void Push(DocumentNode value, const YAML::Mark& mark) {
    if (open_.size() == kMaxDepth) Fail(mark, "lists and maps are nested too deeply");
    open_.push_back({std::move(value), std::nullopt, 0, {}});
  }
  void Pop() {
    DocumentNode value = std::move(open_.back().value);
    open_.pop_back();
    Close(std::move(value));
  }

  const std::string name_;
  DocumentNode root_;
  std::vector<Unfinished> open_;
  int documents_ = 0;
};

}  // namespace

Document ParseYaml(const std::string& text, const std::string& name) {
  TreeBuilder builder(name);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    builder.Fail(error.mark, "not valid YAML: " + OneLine(error.msg));
  }
  return Document(Notation::kYaml, name, builder.TakeRoot());
}

std::string ReadYamlFile(const std::string& path, const std::string& expected) {
  return ReadFile(path, expected, kMaxFile);
}

}  // namespace retarget::io
