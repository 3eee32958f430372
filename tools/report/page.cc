#include "tools/report/page.h"

#include "io/text/base64.h"
#include "tools/report/embedded_page.h"
#include "tools/report/tables.h"
#include "tools/report/verdict.h"

namespace retarget::report {
namespace {

// JSON that cannot end the script element it stands in: every "<" lies inside of a string.
std::string ScriptJson(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

std::string Element(const char* type, const char* id, const std::string& text) {
  return std::string("<script type=\"") + type + "\" id=\"" + id + "\">" + text + "</script>\n";
}

// Replaces the one place called `marker`; the page's own build guarantees it.
void Fill(std::string* page, const std::string& marker, const std::string& text) {
  const std::string comment = "<!--retarget:" + marker + "-->";
  const size_t at = page->find(comment);
  if (at != std::string::npos) page->replace(at, comment.size(), text);
}

}  // namespace

std::string FormatReportPage(const ReportPageData& data) {
  Json report = data.report;
  report["verdict"] = VerdictSentences(report);
  if (EmbeddedReportPage().empty()) return FormatPlainPage(report, data.series);
  std::string elements = Element("application/json", "report", ScriptJson(report)) +
                         Element("application/json", "series", ScriptJson(data.series)) +
                         Element("text/plain", "source-glb", io::EncodeBase64(data.source_glb));
  if (!data.baseline_glb.empty()) {
    elements += Element("text/plain", "baseline-glb", io::EncodeBase64(data.baseline_glb));
  }
  elements += Element("text/plain", "result-glb", io::EncodeBase64(data.result_glb));
  std::string page(EmbeddedReportPage());
  // The data last: nothing in it is searched for markers.
  Fill(&page, "verdict", VerdictHtml(report));
  Fill(&page, "tables", TablesHtml(report));
  Fill(&page, "data", elements);
  return page;
}

}  // namespace retarget::report
