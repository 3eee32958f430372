#include "io/settings_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <type_traits>

#include "model/geometry/types.h"

namespace retarget::io {
namespace {

// The message with which `action` refuses; empty if it does not.
std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string ParseError(const std::string& text) {
  return MessageOf([&] { ParseSettings(text, "s.yaml"); });
}

std::string SetError(const std::string& assignment) {
  Settings settings;
  return MessageOf([&] { SetByName(&settings, assignment, "--set"); });
}

// Every key with its exact value.
std::map<std::string, std::string> Table(const Settings& settings) {
  std::map<std::string, std::string> table;
  const auto text = [](const auto& value) {
    if constexpr (!std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      return Written(value);
    } else {
      char buffer[40];
      snprintf(buffer, sizeof buffer, "%.17g", static_cast<double>(value));
      return std::string(buffer);
    }
  };
  VisitSettings(settings,
                [&](const char* key, const auto& value, auto&&...) { table[key] = text(value); });
  return table;
}

// Other values for every setting, in range.
class Perturber {
 public:
  explicit Perturber(unsigned seed) : random_(seed) {}

  void operator()(const char*, double& value, const char*, const char*, double least, double most) {
    const double u = std::uniform_real_distribution<double>(0, 1)(random_);
    value = least + u * (std::min(most, 1000.0) - least);
  }
  void operator()(const char*, int& value, const char*, const char*, double least, double most) {
    value = std::uniform_int_distribution<int>(static_cast<int>(least),
                                               static_cast<int>(most))(random_);
  }
  void operator()(const char*, std::vector<double>& value, const char*, const char*, double,
                  double) {
    value.resize(std::uniform_int_distribution<size_t>(0, 4)(random_));
    for (double& factor : value) factor = std::uniform_real_distribution<double>(0, 1)(random_);
    value.push_back(1);
  }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char*, Enum& value, const char*, const char*, double, double) {
    const size_t last = kNamesOf<Enum>.size() - 1;
    value = static_cast<Enum>(std::uniform_int_distribution<size_t>(0, last)(random_));
  }

 private:
  std::mt19937 random_;
};

TEST(SettingsFileTest, EmptyTextIsTheDefaults) {
  EXPECT_EQ(Table(ParseSettings("", "s.yaml")), Table(Settings()));
  EXPECT_EQ(Table(ParseSettings("# nothing\nweights:\n  # tangle: 20\n", "s.yaml")),
            Table(Settings()));
}

TEST(SettingsFileTest, KeysOverrideDefaults) {
  const Settings settings = ParseSettings(
      "weights: {tangle: 30.5, hold: +4}\nsolve:\n  backend: ceres\n  threads: 3\n"
      "  stages: 0.2 1\nrequirements:\n  penetration_m: 1e-3\n",
      "s.yaml");
  EXPECT_EQ(settings.weights.tangle, 30.5);
  EXPECT_EQ(settings.weights.hold, 4);
  EXPECT_EQ(settings.solve.backend, Backend::kCeres);
  EXPECT_EQ(settings.solve.threads, 3);
  EXPECT_EQ(settings.solve.stages, (std::vector<double>{0.2, 1}));
  EXPECT_EQ(settings.requirements.penetration_m, 1e-3);
  EXPECT_EQ(settings.weights.ground, Settings().weights.ground);
}

TEST(SettingsFileTest, EveryKeySurvivesTheRoundTrip) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Settings settings;
    VisitSettings(settings, Perturber(seed));
    const std::string text = FormatSettings(settings);
    const Settings again = ParseSettings(text, "s.yaml");
    EXPECT_EQ(Table(again), Table(settings)) << text;
    EXPECT_EQ(FormatSettings(again), text);
  }
  EXPECT_EQ(Table(ParseSettings(FormatSettings(Settings()), "s.yaml")), Table(Settings()));
}

TEST(SettingsFileTest, FormatExplainsEveryKey) {
  Settings settings;
  settings.weights.tangle = 0.1;
  const std::string text = FormatSettings(settings);
  EXPECT_NE(text.find("weights:\n  pose_tracking: 1  # default 1, 1/rad: joint rotations stay as "
                      "captured\n"),
            std::string::npos);
  EXPECT_NE(text.find("  tangle: 0.1  # default 20, 1/turn: "), std::string::npos);
  EXPECT_NE(text.find("  waist: 2  # default 2: share of"), std::string::npos);
  EXPECT_NE(text.find("  backend: banded  # default banded: linear algebra of the clip's solve "
                      "(banded|ceres)\n"),
            std::string::npos);
  EXPECT_NE(text.find("  stages: \"0.1 1\"  # default 0.1 1: "), std::string::npos);
}

TEST(SettingsFileTest, RefusesBadTexts) {
  const struct {
    const char* text;
    const char* message;
  } cases[] = {
      {"weights:\n  tangel: 3\n",
       "s.yaml:2: unknown key \"weights.tangel\", did you mean \"weights.tangle\"?"},
      {"weihgts: {tangle: 3}\n", "s.yaml:1: unknown key \"weihgts\", did you mean \"weights\"?"},
      {"colour: 3\n",
       "s.yaml:1: unknown key \"colour\", expected one of weights, joint_weights, "
       "tangle, hand_contact, requirements, plausible, solve, contact"},
      {"weights:\n  hold: 1\n  tangle: 3\n  hold: 2\n",
       "s.yaml:4: key \"weights.hold\" is given twice, first in line 2"},
      {"weights: 3\n", "s.yaml:1: weights: expected a map of keys and values, found \"3\""},
      {"- 3\n", "s.yaml:1: expected a map of keys and values, found a list of 1"},
      {"weights:\n  hold: yes\n",
       "s.yaml:2: weights.hold: expected a number from 0 to 1000000 (1/m, 1/rad), found \"yes\""},
      {"weights:\n  hold: \"3\"\n",
       "s.yaml:2: weights.hold: expected a number from 0 to 1000000 (1/m, 1/rad), found the text "
       "\"3\""},
      {"weights:\n  hold: 3 m\n", "found \"3 m\""},
      {"weights:\n  hold: 0x10\n", "found \"0x10\""},
      {"weights:\n  hold: .nan\n", "found \".nan\""},
      {"weights:\n  hold: nan\n", "found \"nan\""},
      {"weights:\n  hold: inf\n", "found \"inf\""},
      {"weights:\n  hold: 1e999\n", "found \"1e999\""},
      {"weights:\n  hold: [1]\n", "found a list of 1"},
      {"weights:\n  hold: {a: 1}\n", "found a map"},
      {"weights:\n  hold:\n", "s.yaml:2: weights.hold: expected a number"},
      {"weights:\n\n  hold: -1\n", "s.yaml:3: weights.hold: expected a number from 0 to"},
      {"tangle: {max_tags: 2.5}\n",
       "s.yaml:1: tangle.max_tags: expected a whole number from 1 to 100, found \"2.5\""},
      {"tangle: {max_tags: 0}\n", "expected a whole number from 1 to 100, found \"0\""},
      {"solve: {max_iterations: 99999999999}\n", "found \"99999999999\""},
      {"solve: {backend: band}\n",
       "s.yaml:1: solve.backend: unknown value \"band\", did you mean \"banded\"?"},
      {"solve: {stages: [0.1, 1]}\n", "s.yaml:1: solve.stages: expected text, found a list of 2"},
      {"solve: {stages: \"0.1 0.5\"}\n",
       "solve.stages: \"0.1 0.5\" is not a list of factors that ends with 1"},
      {"weights: &w {hold: 1}\n", "s.yaml:1: expected a value, found an anchor"},
      {"weights: *w\n", "s.yaml:1: not valid YAML: "},
      {"weights: {hold: !!int 3}\n", "s.yaml:1: expected a value, found the tag"},
      {"weights: {}\n---\nweights: {}\n", "found a second document"},
      {"weights: {hold: 1\n", "s.yaml:2: not valid YAML: "},
      {"weights:\n\thold: 1\n", "s.yaml:2: not valid YAML: "},
      {"[a, b]: 3\n", "s.yaml:1: expected a plain word as key"},
      {"\"we\\x07ights\": 3\n", "s.yaml:1: expected a key, found \"we?ights\""},
  };
  for (const auto& c : cases) {
    const std::string message = ParseError(c.text);
    EXPECT_NE(message.find(c.message), std::string::npos) << c.text << "gave: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(SettingsFileTest, SurvivesDeepAndLongInput) {
  for (const char* piece : {"[", "{", "{a: ", "- ", "? ", "\"", "&a [*a, ", "a: ", "\xFF", "!"}) {
    std::string text;
    while (text.size() < 100'000) text += piece;
    EXPECT_NE(ParseError(text), "") << piece;
    EXPECT_LT(ParseError(text).size(), 300u) << piece;
  }
  EXPECT_NE(ParseError(std::string(1000, '\0')), "");
}

TEST(SettingsFileTest, SetByNameSetsOneKey) {
  Settings settings;
  SetByName(&settings, "weights.tangle=30");
  SetByName(&settings, " solve.backend = ceres ");
  SetByName(&settings, "solve.stages=0.2 1");
  SetByName(&settings, "tangle.max_tags=7");
  EXPECT_EQ(settings.weights.tangle, 30);
  EXPECT_EQ(settings.solve.backend, Backend::kCeres);
  EXPECT_EQ(settings.solve.stages, (std::vector<double>{0.2, 1}));
  EXPECT_EQ(settings.tangle.max_tags, 7);
  EXPECT_EQ(settings.weights.hold, Settings().weights.hold);
}

TEST(SettingsFileTest, SetByNameRefuses) {
  EXPECT_EQ(SetError("weights.tangel=20"),
            "--set: unknown key \"weights.tangel\", did you mean \"weights.tangle\"?");
  EXPECT_EQ(SetError("weights.Tangle=20"),
            "--set: unknown key \"weights.Tangle\", did you mean \"weights.tangle\"?");
  EXPECT_EQ(SetError("margin=0.1"),
            "--set: unknown key \"margin\", did you mean \"tangle.margin\"?");
  EXPECT_EQ(SetError("weights.tangle"), "--set: expected key=value, found \"weights.tangle\"");
  EXPECT_EQ(SetError("weights.tangle="),
            "--set: weights.tangle: expected a number from 0 to 1000000 (1/turn), found \"\"");
  EXPECT_EQ(SetError("weights.tangle=-1"),
            "--set: weights.tangle: expected a number from 0 to 1000000 (1/turn), found \"-1\"");
  EXPECT_EQ(SetError("solve.backend=x"),
            "--set: solve.backend: unknown value \"x\", expected one of banded, ceres");
  EXPECT_EQ(
      SetError("simulation.tangle_force=rubber"),
      "--set: simulation.tangle_force: unknown value \"rubber\", expected one of elastic, gli");
  EXPECT_EQ(SetError("solve.stages=banana"),
            "solve.stages: \"banana\" is not a list of factors that ends with 1");
  EXPECT_EQ(SetError("solve.stages="),
            "solve.stages: \"\" is not a list of factors that ends with 1");
  EXPECT_NE(SetError(""), "");
  EXPECT_NE(SetError("="), "");
}

TEST(SettingsFileTest, ReadsFiles) {
  const auto path = std::filesystem::temp_directory_path() / "retarget_settings_file_test.yaml";
  std::ofstream(path) << "weights:\n  hold: 7\n";
  EXPECT_EQ(ReadSettings(path.string()).weights.hold, 7);
  std::ofstream(path) << "weights:\n  hold: x\n";
  const std::string message = MessageOf([&] { ReadSettings(path.string()); });
  EXPECT_EQ(message.find(path.string() + ":2: weights.hold: expected a number"), 0u) << message;
  std::ofstream(path) << std::string(5 << 20, '#');
  EXPECT_NE(MessageOf([&] { ReadSettings(path.string()); }).find("more than 4 MB"),
            std::string::npos);
  std::filesystem::remove(path);
  EXPECT_EQ(MessageOf([&] { ReadSettings(path.string()); }),
            path.string() + ": found no readable file, expected a settings file");
  EXPECT_NE(MessageOf([] { ReadSettings("/"); }).find("no readable file"), std::string::npos);
}

}  // namespace
}  // namespace retarget::io
