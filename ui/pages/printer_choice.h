#pragma once

#include <QDialog>
#include <QWidget>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/track/printer.h"

class QAction;
class QComboBox;
class QLabel;
class QLineEdit;

namespace trapwright::pages {

class ValueEdit;

/// Asks for the numbers of a printer. Does not wait: `save` is called when the user saves, and says what is
/// wrong, or nothing.
class PrinterEditor : public QDialog {
    Q_OBJECT
 public:
    using Save = std::function<std::optional<QString>(const track::Printer&)>;

    PrinterEditor(const track::Printer& printer, const QString& title, Save save, QWidget* parent);

 private:
    struct Row {
        ValueEdit* edit;
        double* target;  // in printer_
        double unit;
    };

    void save();

    track::Printer printer_;
    Save save_;
    QLineEdit* title_;
    std::vector<Row> rows_;
    QLabel* problem_;
};

/// Which printer the track is for: those that come with the program and the user's own, which are made,
/// edited, imported and removed here (base::findOwnFolder). The choice is remembered.
class PrinterChoice : public QWidget {
    Q_OBJECT
 public:
    explicit PrinterChoice(QWidget* parent);

    [[nodiscard]] const track::Printer& printer() const { return printer_; }

 signals:
    /// Another one is chosen, or its numbers have changed.
    void changed();
    void failed(const QString& what, const QString& message);

 private:
    void read(const std::string& wanted);
    void take();
    void edit(const track::Printer& printer, const QString& title);
    void askToRemove();

    std::filesystem::path own_;  // the user's folder
    track::PrinterList list_;
    track::Printer printer_;
    QComboBox* names_;
    QLabel* about_;
    QAction* edit_;
    QAction* remove_;
};

}  // namespace trapwright::pages
