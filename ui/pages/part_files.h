#pragma once

#include <QString>
#include <string>

#include "core/base/math.h"
#include "core/workflow/part_source.h"
#include "ui/look/file_dialog.h"

namespace trapwright::pages {

/// Asks for a part file that can be imported.
look::FileQuestion partQuestion();

/// The import of a file or a bundled part as a new study begins with it.
workflow::PartRequest partRequest(const std::string& part);

/// "4 × 8 × 12 mm", from a box in metres.
QString sizeText(const base::Vec3& size);

}  // namespace trapwright::pages
