#pragma once

class QHeaderView;

namespace trapwright::look {

/// No column becomes narrower than its title: not by the texts below, not by a new title, not by hand.
/// Columns that share what room is left (QHeaderView::Stretch) stay as they are.
void keepHeadersWhole(QHeaderView& header);

}  // namespace trapwright::look
