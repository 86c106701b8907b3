#pragma once

#include <QString>

#include "core/base/math.h"
#include "ui/look/file_dialog.h"

namespace trapwright::pages {

/// Asks for a part file that can be imported.
look::FileQuestion partQuestion();

/// "4 × 8 × 12 mm", from a box in metres.
QString sizeText(const base::Vec3& size);

}  // namespace trapwright::pages
