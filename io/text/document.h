// Documents of others, YAML or JSON, read strictly: every refusal is one line that names the place
// and says what was expected.
//   YAML  file:line: dotted.path: expected ..., found ...
//   JSON  dotted.path: expected ..., found ...
// Lines count from 1, list items ("holds[0]") from 0. All functions that read throw InputError.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

enum class Notation { kYaml, kJson };

// What a parser makes (io/text/yaml.h, io/text/json.h).
struct DocumentNode {
  enum class Kind { kNothing, kScalar, kList, kMap };
  Kind kind = Kind::kNothing;
  std::string text;     // of a scalar; a number, true and false are text as well
  bool quoted = false;  // a scalar in quotes (YAML: or a block of text): never a number
  std::string key;      // under which it stands in its map
  int line = 0;         // of the key where there is one; 0: not known
  std::vector<DocumentNode> children = {};  // of a list or a map, JSON's by key
};

class Value;

// Values look into their document: it stays where it is.
class Document {
 public:
  // `name` stands for the file in messages.
  Document(Notation notation, std::string name, DocumentNode root);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Value root() const;

 private:
  friend class Value;
  Notation notation_;
  std::string name_;
  DocumentNode root_;
};

// A value and where it stands.
class Value {
 public:
  using Kind = DocumentNode::Kind;

  Kind kind() const { return node_->kind; }
  bool is_null() const { return kind() == Kind::kNothing; }
  const std::string& text() const { return node_->text; }  // of a scalar, as it is
  const std::string& key() const { return node_->key; }
  const std::string& path() const { return path_; }  // "a.root.position"; empty at the top
  size_t size() const { return node_->children.size(); }
  Notation notation() const { return document_->notation_; }

  // Of a map: it must be one.
  std::optional<Value> Find(std::string_view key) const;
  bool Has(std::string_view key) const;
  Value Require(const std::string& key) const;
  bool Flag(std::string_view key) const;  // false where it is not there
  void CheckMap() const;
  // No other keys than these.
  void CheckKeys(const std::vector<std::string>& known) const;

  std::vector<Value> Items() const;            // of a list or map
  std::vector<Value> List() const;             // of a list: it must be one
  std::vector<Value> List(size_t most) const;  // of at most so many

  // A finite decimal number, not in quotes; `unit` may be empty.
  double Number(double least, double most, const std::string& unit = "") const;
  int Integer(int least, int most) const;
  bool Bool() const;
  // YAML: any scalar, as it is written.
  std::string Text(size_t most_bytes = std::string::npos) const;
  std::vector<std::string> Texts(size_t most, size_t most_bytes) const;
  // The index in `names`; `what` says what they are ("node").
  int Name(const std::string& what, const std::vector<std::string>& names) const;
  // So many numbers in a list.
  VecX Numbers(int count, double least, double most, const std::string& unit = "") const;
  Vec3 Vector(double most, const std::string& unit = "") const;  // 3 from -most to most
  Quat Quaternion() const;                                       // [x, y, z, w], normalised

  // Throws "place: message", "place: expected ..., found ...".
  [[noreturn]] void Refuse(const std::string& message) const;
  [[noreturn]] void RefuseExpecting(const std::string& expected) const;

 private:
  friend class Document;
  Value(const Document* document, const DocumentNode* node, std::string path)
      : document_(document), node_(node), path_(std::move(path)) {}

  bool IsYaml() const { return notation() == Notation::kYaml; }
  bool IsPlain() const { return kind() == Kind::kScalar && !node_->quoted; }
  std::string Place() const;  // "file:line"; empty for JSON
  std::string Described() const;
  Value Child(const DocumentNode& child) const;
  std::string PathOf(const std::string& key) const;
  const DocumentNode* FindNode(std::string_view key) const;

  const Document* document_;
  const DocumentNode* node_;
  std::string path_;
};

}  // namespace retarget::io
