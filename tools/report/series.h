// The curves of a run as JSON, for the report page. Numbers are rounded: they are drawn, not
// reckoned with. Described in docs/report.md.
#pragma once

#include "solver/metrics/frame_metrics.h"
#include "tools/report/report.h"

namespace retarget::report {

// Source, baseline and result of one scene; the baseline may be null.
Json SeriesJson(const solver::MeasureSubject& subject, const solver::FrameSeries& source,
                const solver::FrameSeries* baseline, const solver::FrameSeries& result);

}  // namespace retarget::report
