#pragma once

#include <QWidget>
#include <vector>

#include "core/drive/profile.h"
#include "core/drive/transport.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace trapwright::feeder {

class DriveLink;

/// Which drive, where it is, and the connection to it. What was typed is remembered for each drive.
class ConnectionCard : public QWidget {
    Q_OBJECT
 public:
    ConnectionCard(DriveLink& link, QWidget* parent);

    /// Reads the profiles, bundled and the user's own.
    void readProfiles();

 signals:
    void failed(const QString& what, const QString& message);

 private:
    [[nodiscard]] const drive::Profile* chosen() const;
    [[nodiscard]] drive::Address address() const;
    void showProfile();
    void showLink();
    void toggle();
    void remember() const;

    DriveLink& link_;
    std::vector<drive::Profile> profiles_;
    QComboBox* list_;
    QLabel* about_;
    QWidget* place_;
    QFormLayout* form_;
    QLineEdit* host_;
    QSpinBox* port_;
    QLineEdit* line_;
    QSpinBox* unit_;
    QPushButton* button_;
};

}  // namespace trapwright::feeder
