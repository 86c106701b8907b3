#pragma once

#include <QColor>
#include <QIcon>
#include <QPixmap>
#include <QString>

namespace trapwright::look {

/// The drawing icons/<name>.svg in the colours of the application's palette, which it follows; sharp at any
/// size and pixel ratio.
QIcon icon(const QString& name);

/// The program's own, for windows.
QIcon programIcon();

/// A drawing as a picture in one colour, for a label. `size` in logical pixels.
QPixmap signPixmap(const QString& name, const QColor& colour, int size, qreal pixelRatio);

}  // namespace trapwright::look
