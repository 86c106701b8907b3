#pragma once

#include <QPointer>
#include <QWidget>

#include "core/part/materials.h"
#include "core/study/pose_drops.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;

namespace trapwright::session {
class StudyDesign;
}

namespace trapwright::pages {

/// The drop test of the Part page: height, surface and number of drops; start, progress and cancel; and what
/// the last test was made with. Its shares are on the cards of the poses.
class DropCard : public QWidget {
    Q_OBJECT
 public:
    explicit DropCard(QWidget* parent);

    void setDesign(session::StudyDesign* design);
    /// The study's settings, part or drops have changed.
    void refresh(const part::MaterialLibrary& library);

 private:
    QDoubleSpinBox* makeNumber(const QString& name, const QString& title, double high, int decimals);
    void listSurfaces(const part::MaterialLibrary& library);
    void takeSurface();
    void showSettings(const study::DropSettings& settings);
    void showSurface();
    void showState();
    [[nodiscard]] study::DropSettings settings() const;

    QPointer<session::StudyDesign> design_;
    std::vector<part::MaterialPair> pairs_;  // of the part's material
    bool touched_ = false;                   // the user has set something since the study was opened
    QDoubleSpinBox* height_;
    QComboBox* surface_;
    QDoubleSpinBox* static_;
    QDoubleSpinBox* kinetic_;
    QDoubleSpinBox* restitution_;
    QSpinBox* drops_;
    QSpinBox* seed_;
    QPushButton* start_;
    QWidget* busy_;
    QLabel* busyText_;
    QProgressBar* bar_;
    QLabel* last_;
};

}  // namespace trapwright::pages
