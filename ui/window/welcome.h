#pragma once

#include <QPushButton>
#include <QStringList>
#include <QWidget>
#include <vector>

class QGridLayout;
class QLabel;
class QScrollArea;

namespace trapwright::window {

class StudyCard;
class StudyCovers;

/// What is seen without a study: four ways to begin, and the studies that were open lately as cards. One of
/// them has the focus; arrow keys go from card to card, Return opens one.
class Welcome : public QWidget {
    Q_OBJECT
 public:
    explicit Welcome(QWidget* parent);

    /// Paths, newest first. Those whose file is gone are shown as such.
    void setRecent(const QStringList& studies, const QStringList& drafts);

 signals:
    void importWanted();
    void draftWanted();
    void openWanted();
    void exampleWanted();
    void tourWanted();
    void helpWanted();
    void studyWanted(const QString& path);
    /// Off the list; the file stays.
    void forgetWanted(const QString& path);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void changeEvent(QEvent* event) override;

 private:
    QPushButton* addChoice(const QString& name, const QString& icon, const QString& title,
                           const QString& text);
    QWidget* makeNotes();
    [[nodiscard]] std::vector<QPushButton*> cards() const;
    void arrange(int columns);
    void goTo(QPushButton* from, int key);
    void focusFirst();
    void focusLater();
    void askForCovers();
    void showCovers();

    QScrollArea* area_;
    int columns_ = 0;  // of cards
    QWidget* choices_;
    QGridLayout* choiceGrid_ = nullptr;
    std::vector<QPushButton*> choiceCards_;
    QWidget* recent_;
    QGridLayout* recentGrid_;
    std::vector<StudyCard*> recentCards_;
    StudyCovers* covers_;
};

}  // namespace trapwright::window
