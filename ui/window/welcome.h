#pragma once

#include <QStringList>
#include <QWidget>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace trapwright::window {

/// What is seen without a study: three ways to begin, and the studies that were open lately.
class Welcome : public QWidget {
    Q_OBJECT
 public:
    explicit Welcome(QWidget* parent);

    /// Paths, newest first.
    void setRecent(const QStringList& studies, const QStringList& drafts);

 signals:
    void importWanted();
    void openWanted();
    void exampleWanted();
    void studyWanted(const QString& path);

 private:
    QPushButton* addChoice(const QString& name, const QString& icon, const QString& title,
                           const QString& text);

    QWidget* choices_;
    QWidget* recent_;
    QVBoxLayout* recentList_;
};

}  // namespace trapwright::window
