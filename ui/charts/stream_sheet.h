#pragma once

#include "core/study/stream.h"
#include "ui/charts/sheet.h"

namespace trapwright::charts {

/// What streams of parts on a track come to over the inflow: how many leave it as wanted, which share that
/// is, and how long it is jammed.
ChartSheet streamSheet(const study::Streams& streams);

}  // namespace trapwright::charts
