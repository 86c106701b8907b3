#pragma once

#include <QDBusVariant>
#include <QObject>

#include "ui/look/theme.h"

namespace trapwright::look {

/// Whether the desktop prefers light or dark windows, now and whenever that changes. Asked of the settings
/// portal, which GNOME, KDE and others answer; where there is none, the palette that Qt found at the start.
class SystemScheme : public QObject {
    Q_OBJECT
 public:
    explicit SystemScheme(QObject* parent = nullptr);

    [[nodiscard]] Scheme scheme() const { return scheme_; }

 signals:
    void changed();

 private slots:
    void settingChanged(const QString& group, const QString& key, const QDBusVariant& value);

 private:
    void take(const QVariant& value);

    Scheme scheme_;
};

}  // namespace trapwright::look
