#pragma once

#include <QObject>

namespace trapwright::look {

/// The wheel changes nothing that has not the focus: over a list of choices, a field, a slider or tabs
/// without it, it goes on to what they lie in, which scrolls. Nor does the wheel give the focus to anything.
///
/// Holds for the whole application, its dialogs too, as long as this lives.
class WheelFocus : public QObject {
    Q_OBJECT
 public:
    explicit WheelFocus(QObject* parent = nullptr);

    bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace trapwright::look
