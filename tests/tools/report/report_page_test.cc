// The report page as text: what it says, what it holds, and that nothing in it can break it.
#include <regex>

#include "tests/test_data.h"
#include "tools/report/embedded_page.h"
#include "tools/report/html.h"
#include "tools/report/page.h"
#include "tools/report/requirement_json.h"
#include "tools/report/verdict.h"

namespace retarget::report {
namespace {

Json Motion(double kept, double penetration, int passes) {
  return {{"tangle_kept_percent", kept},
          {"smallest_gli", 0.3},
          {"tangles", {{{"min_signed_gli", 0.3}, {"frames_below_half", 2}, {"worst_frame", 7}}}},
          {"pass_throughs", passes},
          {"penetration_m", penetration},
          {"hold_m", {0.001}},
          {"a", {{"joint_edit_deg", 3.61}}},
          {"b", {{"joint_edit_deg", 1.2}}}};
}

Json Requirement(const char* name, double value, double limit, const char* unit, bool met,
                 const char* where) {
  return {{"name", name}, {"value", value}, {"limit", limit},
          {"unit", unit}, {"met", met},     {"where", where}};
}

// A report of ten frames: solved, everything met, no simulation.
Json GoodReport() {
  Json report = {{"generator", "retarget test"}, {"frames", 10}, {"fps", 10.0}};
  report["inputs"] = {{"clip_a", {{"file", "clips/one.bvh"}}},
                      {"clip_b", {{"file", "clips/two.bvh"}}},
                      {"template", {{"file", "holds/rear_choke/template.yaml"}}}};
  report["tangles"] = {
      {{"a", {"left_hand", "neck"}}, {"b", {"chest", "head_top"}}, {"template_gli", -0.9}}};
  report["metrics"] = {
      {"source", Motion(70, 0.05, 1)}, {"baseline", nullptr}, {"result", Motion(100, 0.001, 0)}};
  report["requirements"] = {Requirement("tangle 1", 0.9, 0.5, "turns", true, "frame 7"),
                            Requirement("penetration", 0.001, 0.02, "m", true, "frame 3")};
  report["solve"] = {{"status", "converged"},
                     {"terms", {{{"term", "tangle"}, {"weight", 20}, {"cost", 1.5}}}}};
  return report;
}

Json Series() {
  const Json motion = {{"tangles", {{0.9, 0.3, 0.9}}},
                       {"penetration_cm", {0, 1.5, 0}},
                       {"hold_cm", Json::array()},
                       {"foot_speed_cm_s", {{"a", {0, 1, 0}}, {"b", {0, 2, 0}}}}};
  return {
      {"fps", 10}, {"frames", 3}, {"source", motion}, {"baseline", nullptr}, {"result", motion}};
}

std::string Joined(const std::vector<Sentence>& lines) {
  std::string all;
  for (const Sentence& line : lines) all += line.text + "\n";
  return all;
}

size_t Times(const std::string& text, const std::string& what) {
  size_t count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

// The text of the page's script element `id`.
std::string Element(const std::string& page, const std::string& id) {
  const std::string open = "id=\"" + id + "\">";
  const size_t at = page.find(open);
  if (at == std::string::npos) return "";
  const size_t begin = at + open.size();
  return page.substr(begin, page.find("</script>", begin) - begin);
}

// Straight from RFC 4648: six bits per letter, most significant first.
std::string Unbase64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bits, bytes;
  EXPECT_EQ(text.size() % 4, 0u);
  for (const char c : text) {
    if (c == '=') break;
    for (int k = 5; k >= 0; --k) bits += letters.find(c) >> k & 1 ? '1' : '0';
  }
  for (size_t k = 0; k + 8 <= bits.size(); k += 8) {
    bytes += static_cast<char>(std::stoi(bits.substr(k, 8), nullptr, 2));
  }
  return bytes;
}

TEST(Verdict, SaysWhatWasAskedAndThatItIsMet) {
  const Verdict verdict = VerdictOf(GoodReport());
  EXPECT_TRUE(verdict.met);
  EXPECT_EQ(verdict.outcome, "The tangles are kept in all 10 frames and every requirement is met.");
  const std::string asked = Joined(verdict.asked);
  for (const char* part : {"one.bvh", "two.bvh", "\"rear choke\"", "10 frames (1.0 s)", "1 tangle ",
                           "left hand to neck", "chest to head top"}) {
    EXPECT_NE(asked.find(part), std::string::npos) << part << " in " << asked;
  }
  const std::string compared = Joined(verdict.compared);
  EXPECT_NE(compared.find("7 of 10 frames"), std::string::npos) << compared;
  EXPECT_NE(compared.find("1 pass-through."), std::string::npos) << compared;
  EXPECT_NE(compared.find("no simulated run"), std::string::npos) << compared;
  EXPECT_NE(Joined(verdict.look).find("frame 7"), std::string::npos);
}

TEST(Verdict, NamesWhatIsMissedWithItsPlace) {
  Json report = GoodReport();
  report["metrics"]["result"] = Motion(80, 0.031, 0);
  report["metrics"]["baseline"] = Motion(30, 0.08, 2);
  report["requirements"] = {
      Requirement("tangle 1", 0.3, 0.5, "turns", false, "a (x, y) x b (z, w), frame 7"),
      Requirement("penetration", 0.031, 0.02, "m", false, "frame 3, a left_elbow in b neck"),
      Requirement("hold 1", 0.001, 0.02, "m", true, "")};
  report["solve"]["status"] = "time limit";
  const Verdict verdict = VerdictOf(report);
  EXPECT_FALSE(verdict.met);
  EXPECT_EQ(verdict.outcome,
            "The tangles are lost in 2 of 10 frames; 2 of 3 requirements are missed.");
  ASSERT_EQ(verdict.missed.size(), 2u);
  EXPECT_NE(verdict.missed[0].text.find("0.30"), std::string::npos);
  EXPECT_NE(verdict.missed[0].text.find("frame 7"), std::string::npos);
  EXPECT_NE(verdict.missed[1].text.find("3.1 cm, 2.0 allowed"), std::string::npos);
  EXPECT_NE(verdict.missed[1].text.find("a left elbow in b neck"), std::string::npos);
  EXPECT_NE(Joined(verdict.stopped).find("time limit"), std::string::npos);
  EXPECT_NE(Joined(verdict.compared).find("The simulation lost the tangles in 7 of 10 frames"),
            std::string::npos);
  EXPECT_NE(Joined(verdict.look).find("frame 7 first"), std::string::npos);
}

// The requirement's kind decides, not its name.
TEST(Verdict, ReadsKindAndFrameAndNotNames) {
  Json report = GoodReport();
  report["requirements"] = {{{"name", "penetration 1"},
                             {"value", 0.031},
                             {"limit", 0.02},
                             {"unit", "m"},
                             {"met", false},
                             {"where", "somewhere"},
                             {"kind", "foot_drift"},
                             {"item", nullptr},
                             {"figure", "b"},
                             {"frame", 31},
                             {"limbs", Json::array()}},
                            {{"name", "x"},
                             {"value", 2},
                             {"limit", 1},
                             {"unit", "m"},
                             {"met", false},
                             {"where", "frame 5"},
                             {"kind", "of a later version"},
                             {"frame", nullptr}}};
  const Verdict verdict = VerdictOf(report);
  ASSERT_EQ(verdict.missed.size(), 2u);
  EXPECT_EQ(verdict.missed[0].text,
            "A planted foot of b drifts by 3.1 cm, 2.0 allowed (somewhere).");
  EXPECT_EQ(verdict.missed[0].frame, 31);
  EXPECT_EQ(verdict.missed[1].text, "x: 200 cm, 100 allowed (frame 5).");
  EXPECT_EQ(verdict.missed[1].frame, -1);
  EXPECT_EQ(verdict.look.at(0).text, "Look at frame 31 first.");
}

// A report written before there were kinds reads as one with them.
TEST(Verdict, OldReportsAreReadByTheirNames) {
  const auto read = [](const char* name, const char* where) {
    return RequirementFromJson(Requirement(name, 1, 2, "", true, where));
  };
  using Kind = solver::RequirementKind;
  const ReadRequirement tangle = read("tangle 12", "a (x, y) x b (z, w), frame 7");
  EXPECT_TRUE(tangle.Is(Kind::kTangle));
  EXPECT_EQ(tangle.item, 11);
  EXPECT_EQ(tangle.frame, 7);
  EXPECT_EQ(tangle.figure, -1);
  EXPECT_TRUE(read("penetration", "").Is(Kind::kPenetration));
  EXPECT_TRUE(read("penetration over 1 cm", "").Is(Kind::kPenetrationOver1cm));
  EXPECT_TRUE(read("pass-throughs", "").Is(Kind::kPassThroughs));
  EXPECT_TRUE(read("hold 1", "frame 9").Is(Kind::kHold));
  const ReadRequirement drift = read("foot drift b", "frame 0");
  EXPECT_TRUE(drift.Is(Kind::kFootDrift));
  EXPECT_EQ(drift.figure, 1);
  EXPECT_TRUE(read("floor a", "").Is(Kind::kFloor));
  EXPECT_TRUE(read("segment lengths a", "").Is(Kind::kSegmentLength));
  EXPECT_TRUE(read("write-back b", "b.bvh").Is(Kind::kWriteBack));
  EXPECT_FALSE(read("tangled", "").kind);
  EXPECT_FALSE(read("hold x", "").kind);
}

TEST(Html, TheNamedFrameBecomesAJump) {
  EXPECT_EQ(WithFrame("at frame 3, <b>", 3), "at <span data-frame=\"3\">frame 3</span>, &lt;b&gt;");
  EXPECT_EQ(WithFrame("at frame 31", 3), "at frame 31");
  EXPECT_EQ(WithFrame("at frame 3", -1), "at frame 3");
}

TEST(Verdict, AnEmptyReportIsNoError) {
  EXPECT_FALSE(VerdictSentences(Json::object()).empty());
  EXPECT_FALSE(FormatPlainPage(Json::object(), Json::object()).empty());
}

TEST(ReportPage, HoldsReportSeriesAndScenes) {
  if (EmbeddedReportPage().empty()) GTEST_SKIP() << "built without RETARGET_STUDIO";
  const Json report = GoodReport(), series = Series();
  std::string glb = "glTF";
  for (int k = 0; k < 256; ++k) glb += static_cast<char>(k);
  for (const std::string tail : {"", "x", "xy"}) {
    const std::string page = FormatReportPage({report, series, glb + tail, "", tail + glb});
    EXPECT_EQ(Unbase64(Element(page, "source-glb")), glb + tail);
    EXPECT_EQ(Unbase64(Element(page, "result-glb")), tail + glb);
    EXPECT_EQ(Element(page, "baseline-glb"), "");
    EXPECT_EQ(Json::parse(Element(page, "series")), series);
    Json held = Json::parse(Element(page, "report"));
    EXPECT_EQ(held.at("verdict"), Json(VerdictSentences(report)));
    held.erase("verdict");
    EXPECT_EQ(held, report);
    EXPECT_EQ(Times(page, "<!--retarget:"), 0u);
  }
  const std::string page = FormatReportPage({report, series, glb, "baseline", glb});
  EXPECT_EQ(Unbase64(Element(page, "baseline-glb")), "baseline");
}

// The page asks for nothing: no address in an attribute that loads.
TEST(ReportPage, LoadsNothingFromElsewhere) {
  const Json report = GoodReport(), series = Series();
  for (const std::string& page :
       {FormatReportPage({report, series, "s", "", "r"}), FormatPlainPage(report, series)}) {
    const std::regex loads(R"re(<(script|link|img|iframe)[^>]*(src|href)="(?!data:))re");
    const std::string head = page.substr(0, page.find("<style"));
    EXPECT_FALSE(std::regex_search(head, loads));
    EXPECT_EQ(Times(page, "type=\"module\""), 0u);
    EXPECT_EQ(Times(page, "@import"), 0u);
  }
}

TEST(ReportPage, NamesCannotBreakIt) {
  Json report = GoodReport();
  const std::string evil = "</script><script>alert(1)</script><!--retarget:data--> \"'&\xff";
  report["inputs"]["clip_a"]["file"] = evil;
  report["warnings"] = {evil};
  const Json series = Series();
  for (const std::string& page :
       {FormatReportPage({report, series, "s", "", "r"}), FormatPlainPage(report, series)}) {
    EXPECT_EQ(Times(page, "<script>alert"), 0u);
    EXPECT_GT(Times(page, "&lt;script&gt;alert(1)"), 0u);
    EXPECT_EQ(Times(page, "<!--retarget:data-->"), 0u);
  }
}

TEST(PlainPage, HasVerdictTablesAndPlots) {
  Json report = GoodReport();
  report["requirements"][1]["met"] = false;
  const std::string page = FormatPlainPage(report, Series());
  EXPECT_NE(page.find("1 of 2 requirements is missed"), std::string::npos);
  EXPECT_EQ(Times(page, "<tr class=\"missed\">"), 1u);
  EXPECT_NE(page.find("--set weights.tangle=20"), std::string::npos);
  EXPECT_NE(page.find("data-frame=\"7\""), std::string::npos);
  EXPECT_EQ(Times(page, "<script"), 0u);
  // One line per motion that there is: GLI, penetration, feet, floor, body with itself.
  EXPECT_EQ(Times(page, "<figure"), 5u);
  EXPECT_EQ(Times(page, "<polyline"), 6u);  // floor and self-penetration are not in these series
  EXPECT_EQ(Times(page, "<figure"), Times(page, "</figure>"));
}

}  // namespace
}  // namespace retarget::report
