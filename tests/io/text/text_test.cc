// Documents in both notations, and the ways to read a file and to show a text.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "io/text/json.h"
#include "io/text/quoted.h"
#include "io/text/read_file.h"
#include "io/text/yaml.h"

namespace retarget::io {
namespace {

std::string MessageOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Document, ReadsTheSameFromBothNotations) {
  const Document yaml = ParseYaml("x: 1.5\nlist: [1, -2, 3e2]\nname: head\non: true\n", "f");
  const Document json = ParseJson(R"({"x":1.5,"list":[1,-2,3e2],"name":"head","on":true})");
  for (const Document* document : {&yaml, &json}) {
    const Value root = document->root();
    root.CheckKeys({"x", "list", "name", "on"});
    EXPECT_EQ(root.Require("x").Number(0, 2), 1.5);
    EXPECT_EQ(root.Require("list").Vector(1000), Vec3(1, -2, 300));
    EXPECT_EQ(root.Require("name").Name("node", {"neck", "head"}), 1);
    EXPECT_EQ(root.Require("name").Text(10), "head");
    EXPECT_TRUE(root.Flag("on"));
    EXPECT_FALSE(root.Flag("off"));
    EXPECT_FALSE(root.Find("off"));
  }
}

TEST(Document, RefusesInTheWordsOfItsNotation) {
  const Document yaml = ParseYaml("a:\n  x: \"1\"\n  list: [1, 2]\n  name: hed\n", "f");
  const Document json = ParseJson(R"({"a":{"x":"1","list":[1,2],"name":"hed"}})");
  struct Refusal {
    std::function<void(const Value&)> read;
    const char *yaml, *json;
  };
  const Refusal refusals[] = {
      {[](const Value& a) { a.Require("x").Number(0, 2, "m"); },
       "f:2: a.x: expected a number from 0 to 2 (m), found the text \"1\"",
       "a.x: expected a number from 0 to 2, found \"1\""},
      {[](const Value& a) { a.Require("list").Vector(2, "m"); },
       "f:3: a.list: expected a list of 3 numbers (m), found a list of 2",
       "a.list: expected 3 numbers from -2 to 2, found a list of 2"},
      {[](const Value& a) {
         a.Require("name").Name("node", {"head", "neck"});
       },
       "f:4: a.name: unknown node \"hed\", did you mean \"head\"?",
       "a.name: unknown name \"hed\", did you mean \"head\"?"},
      {[](const Value& a) { a.Require("y"); }, "f:1: missing key \"a.y\"", "a.y is missing"},
      {[](const Value& a) {
         a.CheckKeys({"x", "lists", "name"});
       },
       "f:3: unknown key \"a.list\", did you mean \"a.lists\"?",
       "a.list: unknown field, did you mean \"lists\"?"},
      {[](const Value& a) { a.Require("list").Require("x"); },
       "f:3: a.list: expected a map of keys and values, found a list of 2",
       "a.list: expected an object {...}, found a list of 2"}};
  for (const Refusal& refusal : refusals) {
    EXPECT_EQ(MessageOf([&] { refusal.read(yaml.root().Require("a")); }), refusal.yaml);
    EXPECT_EQ(MessageOf([&] { refusal.read(json.root().Require("a")); }), refusal.json);
  }
}

TEST(Document, WholeNumbersOfJsonMayHaveAPoint) {
  const Document json = ParseJson("[3.0, 3.5, 12345678901]");
  EXPECT_EQ(json.root().Items()[0].Integer(0, 5), 3);
  for (const int k : {1, 2}) EXPECT_THROW(json.root().Items()[k].Integer(0, 5), InputError);
  const Document yaml = ParseYaml("[3, 3.0, +3]", "f");
  EXPECT_EQ(yaml.root().Items()[0].Integer(0, 5), 3);
  for (const int k : {1, 2}) EXPECT_THROW(yaml.root().Items()[k].Integer(0, 5), InputError);
}

// A deep key stands before every item of a list; places are made where they are asked for.
TEST(Document, CostsNoMoreThanItsLength) {
  std::string text = "{\"" + std::string(400'000, 'k') + "\":[0";
  for (int k = 0; k < 200'000; ++k) text += ",0";
  const Document json = ParseJson(text + "]}");
  EXPECT_THROW(json.root().CheckKeys({"x"}), InputError);
}

TEST(Quoted, KeepsALineALine) {
  EXPECT_EQ(Quoted("a\nb\x7f"), "\"a?b?\"");
  EXPECT_EQ(Quoted(std::string(59, 'x') + "\xc3\xbc"), "\"" + std::string(59, 'x') + "...\"");
  EXPECT_EQ(Printable(std::string(80, 'x')), std::string(60, 'x'));
  EXPECT_EQ(QuotedWord(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
  EXPECT_EQ(OneLine("a\r\nb\n"), "a  b");
}

TEST(ReadFile, SaysWhatWasExpected) {
  const std::string folder = testing::TempDir(), path = folder + "/read_file_test.txt";
  std::ofstream(path, std::ios::binary) << std::string(3 << 20, 'x');
  EXPECT_EQ(ReadFile(path).size(), size_t{3} << 20);
  EXPECT_EQ(ReadFile(path, "a file", 3 << 20).size(), size_t{3} << 20);
  EXPECT_EQ(MessageOf([&] { ReadFile(path, "a map", 2 << 20); }),
            path + ": found more than 2 MB, expected a map");
  EXPECT_EQ(MessageOf([&] { ReadFile(folder, "a map"); }),
            folder + ": found no readable file (it is a folder), expected a map");
  EXPECT_EQ(MessageOf([] { ReadFile("/nowhere", "a map"); }),
            "/nowhere: found no readable file, expected a map");
  EXPECT_FALSE(TryReadFile("/nowhere"));
  std::ofstream(path, std::ios::trunc);
  EXPECT_EQ(ReadFile(path), "");
  EXPECT_EQ(MessageOf([&] { ReadFilledFile(path, "a map"); }),
            path + ": found no readable file, expected a map");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace retarget::io
