// The table on the terminal: columns, units and marks.
#include "tools/report/metrics_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace retarget::report {
namespace {

class MetricsTableTest : public testing::Test {
 protected:
  MetricsTableTest() {
    for (int f = 0; f < 2; ++f) {
      subject_.body[f] = StandardBody(AverageMeasures(1.75));
      subject_.length[f].assign(subject_.body[f].nodes.size(), 1);
      for (solver::Metrics* m : {&source_, &baseline_, &result_}) {
        m->figure[f].path_m.assign(subject_.body[f].nodes.size(), 0);
      }
    }
    subject_.tangles.resize(1);
    subject_.tangles[0].tag.tangle = {{1, 2}, {3, 4}, 0.9};
    source_.tangles = {{-0.2, -0.3, 10, 4}};
    baseline_.tangles = {{0.6, 0.4, 0, 3}};
    result_.tangles = {{0.8, 0.7, 0, 5}};
    for (solver::Metrics* m : {&source_, &baseline_, &result_}) {
      m->smallest_gli = m->tangles[0].min_signed_gli;
      m->smallest_gli_between = m->tangles[0].min_signed_gli_between;
    }
    baseline_.penetration_m = 0.01;
    baseline_.penetration_between_m = 0.021;
    result_.figure[1].foot_drift_m = 0.0123;
    result_.figure[1].foot_drift_frame = 0;
    baseline_.figure[1].foot_drift_m = 0;  // of the source nothing is measured
  }

  // The words of the line that begins with `name`.
  std::vector<std::string> Line(const solver::Metrics* baseline, const std::string& name) const {
    const std::vector<solver::RequirementCheck> checks =
        solver::CheckRequirements(subject_, result_, {});
    std::istringstream table(MetricsTable(subject_, source_, baseline, result_, checks));
    std::string line;
    while (std::getline(table, line)) {
      if (line.rfind(name, 0) != 0) continue;
      std::istringstream words(line.substr(name.size()));
      return {std::istream_iterator<std::string>(words), {}};
    }
    return {};
  }

  solver::MetricsContext subject_;
  solver::Metrics source_, baseline_, result_;
};

using Words = std::vector<std::string>;

TEST_F(MetricsTableTest, SourceBaselineResultAndWhatIsMissed) {
  EXPECT_EQ(Line(&baseline_, " "), (Words{"source", "baseline", "result", "required"}));
  EXPECT_EQ(Line(&baseline_, "smallest s GLI, also between frames"),
            (Words{"-0.30*", "0.40*", "0.70", ">", "0.50", "turns"}));
  EXPECT_EQ(Line(&baseline_, "deepest penetration"),
            (Words{"0.00", "2.10*", "0.00", "<=", "2.00", "cm"}));
  EXPECT_EQ(Line(&baseline_, "foot drift b"), (Words{"none", "0.00", "1.23*", "<=", "1.00", "cm"}));
  EXPECT_EQ(Line(&baseline_, "joint edit a"), (Words{"none", "none", "none", "deg"}));
  EXPECT_EQ(Line(&baseline_, "hold error"),
            (Words{"none", "none", "none", "cm"}));  // the scene has none
  EXPECT_EQ(Line(&baseline_, "MISSED foot drift b:"),
            (Words{"0.0123", "m,", "required", "0.01", "at", "frame", "0"}));
}

TEST_F(MetricsTableTest, WithoutBaselineTwoColumns) {
  EXPECT_EQ(Line(nullptr, " "), (Words{"source", "result", "required"}));
  EXPECT_EQ(Line(nullptr, "foot drift b"), (Words{"none", "1.23*", "<=", "1.00", "cm"}));
}

TEST_F(MetricsTableTest, EveryRequirementHasItsRow) {
  subject_.holds.resize(1);
  for (solver::Metrics* m : {&source_, &result_}) {
    m->hold_m = {0.03};
    m->hold_frame = {0};
  }
  const std::vector<solver::RequirementCheck> checks =
      solver::CheckRequirements(subject_, result_, {});
  const Json requirements = ChecksJson(checks, subject_.body);
  int answered = 0;
  for (const MetricRow& row : MetricRows()) {
    answered += !LimitOf(row, requirements).is_null();
  }
  EXPECT_EQ(answered, static_cast<int>(checks.size()));
  EXPECT_EQ(Line(nullptr, "hold error"), (Words{"3.00*", "3.00*", "<=", "2.00", "cm"}));
}

}  // namespace
}  // namespace retarget::report
