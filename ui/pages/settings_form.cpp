#include "ui/pages/settings_form.h"

#include <QVBoxLayout>
#include <algorithm>
#include <map>

#include "core/study/field_text.h"
#include "ui/look/folding_group.h"
#include "ui/pages/problem_text.h"
#include "ui/pages/settings_row.h"

namespace trapwright::pages {

namespace {

QString helpOf(const SettingsRow& row) {
    const study::FieldInfo& field = row.field();
    QString help = row.text().help;
    if (field.kind == study::FieldKind::number || field.kind == study::FieldKind::count) {
        help += ' ' +
                SettingsForm::tr("%1 to %2 %3")
                    .arg(QString::number(field.low), QString::number(field.high, 'g', 10), unitOf(field.key))
                    .trimmed() +
                '.';
    }
    return help;
}

}  // namespace

SettingsForm::SettingsForm(const std::vector<FieldGroup>& groups, study::Settings defaults, QWidget* parent)
    : QWidget(parent), settings_(defaults), defaults_(std::move(defaults)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    for (const FieldGroup& face : groups) {
        Group group{new look::FoldingGroup(face.name, face.title, face.foldedAtFirst, this), {}};
        for (const std::string_view key : face.keys)
            addRow(group, std::string(key));
        layout->addWidget(group.widget);
        groups_.insert(face.name, group);
        order_.push_back(face.name);
    }
    show(settings_);
}

void SettingsForm::addRow(Group& group, const std::string& key) {
    static const std::vector<study::FieldInfo> fields = study::listFields();
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [&](const study::FieldInfo& info) { return info.key == key; });
    Q_ASSERT(field != fields.end());
    auto* row = new SettingsRow(*field, group.widget);
    group.widget->body()->addWidget(row);
    group.rows.push_back(row);
    rows_.push_back(row);
    connect(row, &SettingsRow::attended, this,
            [this, row] { emit attended(row->text().label, helpOf(*row)); });
    connect(row, &SettingsRow::edited, this, [this, row](const QString& text) {
        study::Settings changed = settings_;
        if (study::setField(changed, row->field().key, text.toStdString()))
            emit edited(changed, row->text().label);
    });
}

void SettingsForm::offer(const std::string& key, const std::vector<Choice>& choices) {
    for (SettingsRow* row : rows_)
        if (row->field().key == key) row->offer(choices);
}

void SettingsForm::show(const study::Settings& settings) {
    settings_ = settings;
    for (SettingsRow* row : rows_)
        row->show(settings, defaults_);
}

void SettingsForm::setProblems(const std::vector<std::string>& problems,
                               const std::vector<std::string>& advice) {
    std::map<std::string, std::pair<QString, bool>> reasons;  // by key: text, and whether it is only advice
    const auto add = [&](const std::vector<std::string>& sentences, bool isAdvice) {
        for (const std::string& sentence : sentences) {
            const ProblemText problem = describeProblem(sentence);
            const auto [place, isNew] = reasons.try_emplace(problem.key, problem.text, isAdvice);
            if (!isNew && !isAdvice) place->second.first += "\n" + problem.text;
        }
    };
    add(problems, false);
    add(advice, true);
    for (const QString& name : order_) {
        const Group& group = groups_[name];
        int bad = 0;
        for (SettingsRow* row : group.rows) {
            const auto reason = reasons.find(row->field().key);
            const bool found = reason != reasons.end();
            row->setProblem(found ? reason->second.first : QString(), found && reason->second.second);
            if (found && !reason->second.second) ++bad;
        }
        group.widget->setSummary(bad == 0   ? QString()
                                 : bad == 1 ? tr("1 problem")
                                            : tr("%1 problems").arg(bad));
    }
}

void SettingsForm::setLocked(const std::function<bool(const std::string& key)>& mayChange) {
    for (SettingsRow* row : rows_)
        row->setLocked(!mayChange(row->field().key));
}

void SettingsForm::setVisible(const std::string& key, bool visible) {
    for (SettingsRow* row : rows_)
        if (row->field().key == key) row->setVisible(visible);
}

void SettingsForm::addToGroup(const QString& group, QWidget* widget, bool atTheTop) {
    groups_[group].widget->body()->insertWidget(atTheTop ? 0 : -1, widget);
}

void SettingsForm::goToProblem() {
    for (const QString& name : order_) {
        for (SettingsRow* row : groups_[name].rows) {
            if (row->problem().isEmpty()) continue;
            groups_[name].widget->setFolded(false);
            row->findChild<QWidget*>("field." + QString::fromStdString(row->field().key))->setFocus();
            return;
        }
    }
}

}  // namespace trapwright::pages
