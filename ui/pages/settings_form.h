#pragma once

#include <QHash>
#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "core/study/settings.h"
#include "ui/pages/field_texts.h"

class QVBoxLayout;

namespace trapwright::look {
class FoldingGroup;
}

namespace trapwright::pages {

class SettingsRow;

/// Edits settings in groups: a row for each, bad values marked in place with the reason, and each can be
/// reset. Holds no settings but those it was shown last; who owns them is told by edited() what the user
/// wants.
class SettingsForm : public QWidget {
    Q_OBJECT
 public:
    /// `defaults` is what reset goes back to.
    SettingsForm(const std::vector<FieldGroup>& groups, study::Settings defaults, QWidget* parent = nullptr);

    /// What a setting that is a text can be.
    void offer(const std::string& key, const std::vector<Choice>& choices);
    void show(const study::Settings& settings);
    /// Sentences of study::findProblems, findPartProblems (`problems`) and findRecommendations (`advice`).
    /// Those that concern no field of this form are left out.
    void setProblems(const std::vector<std::string>& problems, const std::vector<std::string>& advice);
    /// Only those for which `mayChange` is true can be edited.
    void setLocked(const std::function<bool(const std::string& key)>& mayChange);
    void setVisible(const std::string& key, bool visible);
    using QWidget::setVisible;

    /// Puts a widget at the end or the beginning of a group.
    void addToGroup(const QString& group, QWidget* widget, bool atTheTop = false);
    /// Unfolds the group of the first marked field and gives it the focus.
    void goToProblem();

 signals:
    /// The settings with the user's change, and the change's name for undo.
    void edited(const trapwright::study::Settings& settings, const QString& what);
    /// Help on the field at which the user is.
    void attended(const QString& label, const QString& help);

 private:
    struct Group {
        look::FoldingGroup* widget;
        std::vector<SettingsRow*> rows;
    };

    void addRow(Group& group, const std::string& key);

    study::Settings settings_;
    study::Settings defaults_;
    QHash<QString, Group> groups_;
    std::vector<QString> order_;
    std::vector<SettingsRow*> rows_;
};

}  // namespace trapwright::pages
