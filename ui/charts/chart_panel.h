#pragma once

#include <QAction>
#include <QImage>
#include <QWidget>
#include <filesystem>

#include "core/base/result.h"
#include "ui/charts/chart_theme.h"
#include "ui/charts/sheet.h"

class QStackedLayout;
class QLabel;
class QToolButton;

namespace trapwright::charts {

class Legend;

/// The frame around a chart: a legend whose entries can be switched, the chart, and what can be done with it.
/// Its QActions (addAction) carry shortcuts that work while the chart has the focus. Colours follow the
/// widget's palette.
class ChartPanel : public QWidget {
    Q_OBJECT
 public:
    /// `name` is stable and becomes the object's name and the proposed name of saved files ("fitness").
    ChartPanel(const QString& name, const QString& title, QWidget* parent);

    [[nodiscard]] const QString& title() const { return title_; }
    /// What is shown instead of the chart while it has nothing to show; an empty state says what to do next.
    void setEmptyText(const QString& text);

    /// The chart as it is on the screen, with its legend, black on white. `size` in logical pixels.
    [[nodiscard]] QImage picture(QSize size, double devicePixelRatio = 2.0);
    /// The numbers behind the chart, one line per generation or pose; a heading first, point as decimal sign.
    [[nodiscard]] virtual QString csv() const = 0;

    /// By the ending of the name: .svg, or .png at twice the pixels of the screen. Errors name the file.
    base::Status savePicture(const std::filesystem::path& path);
    base::Status saveCsv(const std::filesystem::path& path) const;

    [[nodiscard]] QAction* savePictureAction() { return savePicture_; }
    [[nodiscard]] QAction* saveCsvAction() { return saveCsv_; }
    [[nodiscard]] QAction* copyPictureAction() { return copyPicture_; }

 signals:
    /// For the window's message bar: what was tried and what was wrong.
    void failed(const QString& what, const QString& message);
    /// A file was written.
    void saved(const QString& path);

 protected:
    void changeEvent(QEvent* event) override;

    /// The widget that holds the chart, and what of it is on pictures, if that is not all (where it scrolls).
    /// Called once by the subclass; the panel owns it from then on.
    void setBody(QWidget* body, QWidget* content = nullptr);
    void showEmpty(bool empty);
    [[nodiscard]] Legend* legend() { return legend_; }
    [[nodiscard]] const ChartTheme& theme() const { return theme_; }
    /// Draws everything of the chart in the theme's colours from now on.
    virtual void applyTheme(const ChartTheme& theme) = 0;
    /// Shown as a button beside the legend.
    void setFitAction(QAction* action);

 private:
    /// As large as the panel, and as wide as all that scrolls.
    [[nodiscard]] QSize pictureSize() const;
    QAction* addPanelAction(const QString& text, const QKeySequence& key, void (ChartPanel::*act)());
    void paintPicture(QPainter& painter, QSize size);
    void report(const QString& what, const base::Status& status, const std::filesystem::path& path);
    void askAndSavePicture();
    void askAndSaveCsv();
    void copyPicture();

    QString title_;
    ChartTheme theme_;
    Legend* legend_;
    QLabel* empty_;
    QStackedLayout* stack_;
    QToolButton* fitButton_;
    QToolButton* more_;
    QWidget* body_ = nullptr;
    QWidget* content_ = nullptr;  // with a layout
    QAction* savePicture_;
    QAction* saveCsv_;
    QAction* copyPicture_;
};

}  // namespace trapwright::charts
