#pragma once

#include <QDialog>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/part/materials.h"

class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSortFilterProxyModel;
class QStandardItemModel;
class QTableView;

namespace trapwright::session {
class StudyDesign;
}

namespace trapwright::pages {

/// Asks for the numbers of one pair of materials. Does not wait: `save` is called when the user saves, and
/// says what is wrong, or nothing.
class PairEditor : public QDialog {
    Q_OBJECT
 public:
    using Save = std::function<std::optional<QString>(const part::MaterialPair&)>;

    PairEditor(const part::MaterialPair& pair, const QString& title, Save save, QWidget* parent);

 private:
    struct Row {
        part::MaterialNumber part::MaterialPair::*number;
        QDoubleSpinBox* value;
        QDoubleSpinBox* spread;
        QLineEdit* source;
    };

    void save();

    part::MaterialPair pair_;
    Save save_;
    QLineEdit* material_;
    QLineEdit* surface_;
    std::vector<Row> rows_;
    QLabel* problem_;
};

/// The library of materials: every pair with its numbers and their sources, searched; the user's own are
/// made, edited, imported and removed here; one can be used for the study.
class MaterialsDialog : public QDialog {
    Q_OBJECT
 public:
    /// `own` is the user's folder; `search` is what is searched for at first. Without `canUse` the study
    /// takes no pair.
    MaterialsDialog(std::filesystem::path own, const QString& search, bool canUse, QWidget* parent);

 signals:
    /// The user wants this pair for the study: friction and restitution, material and density.
    void pairWanted(const trapwright::part::MaterialPair& pair);
    /// The user's own entries have changed.
    void libraryChanged();

 private:
    void addActions();
    void read(const std::string& select = {});
    [[nodiscard]] const part::MaterialPair* current() const;
    void showCurrent();
    void edit(const part::MaterialPair& pair, const QString& title,
              const std::optional<part::MaterialPair>& before);
    void makeNew();
    void editCurrent();
    void removeCurrent();
    void import();
    void use();
    void tell(const QString& message);

    std::filesystem::path own_;
    bool canUse_;
    bool reading_ = false;
    part::MaterialLibrary library_;
    QStandardItemModel* model_;
    QSortFilterProxyModel* found_;
    QLineEdit* search_;
    QTableView* table_;
    QLabel* details_;
    QLabel* problems_;
    QPushButton* edit_;
    QPushButton* remove_;
    QPushButton* use_;
};

/// The library of a study's user, and what is wrong with it.
part::MaterialLibrary readMaterials(const session::StudyDesign& design);
/// Has the study take a pair: friction and restitution, and the part's material and density where they are
/// others. Each can be undone.
void usePair(session::StudyDesign& design, const part::MaterialPair& pair);
/// "POM on printed PLA: friction 0.3 static, 0.25 kinetic; restitution 0.2"
QString pairText(const part::MaterialPair& pair);

}  // namespace trapwright::pages
