// Strict YAML as a document (io/text/document.h). yaml-cpp parses; what it lets pass is refused
// here: keys given twice, anchors and aliases, tags, a second document, deep nesting.
#pragma once

#include <string>

#include "io/text/document.h"

namespace retarget::io {

// The one document in `text`; `name` stands for the file in messages. Nothing for an empty text.
Document ParseYaml(const std::string& text, const std::string& name);

// The text of a file of at most 4 MB; `expected` says what it should be ("a settings file").
std::string ReadYamlFile(const std::string& path, const std::string& expected);

// `text` as a YAML scalar on one line, in quotes where it needs them.
std::string YamlText(const std::string& text);

}  // namespace retarget::io
