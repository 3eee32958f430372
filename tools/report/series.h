// The curves of a run as JSON, for the report page. Numbers are rounded: they are drawn, not
// reckoned with. Described in docs/report.md.
#pragma once

#include "solver/metrics/frame_metrics.h"
#include "tools/report/report.h"

namespace retarget::report {

// Source, baseline and result of one scene; the baseline may be null.
Json SeriesJson(const solver::MetricsContext& subject, const solver::FrameMetrics& source,
                const solver::FrameMetrics* baseline, const solver::FrameMetrics& result);

}  // namespace retarget::report
