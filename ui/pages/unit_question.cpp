#include "ui/pages/unit_question.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <filesystem>

#include "ui/look/text.h"
#include "ui/pages/part_files.h"

namespace trapwright::pages {

UnitQuestion::UnitQuestion(QWidget* parent)
    : QFrame(parent), text_(new QLabel(this)), buttons_(new QWidget(this)), list_(new QVBoxLayout(buttons_)) {
    setObjectName("unitQuestion");
    setStyleSheet("#unitQuestion { border: 1px solid palette(highlight); border-radius: 4px; background: palette(base); }");
    text_->setWordWrap(true);
    list_->setContentsMargins(0, 0, 0, 0);
    list_->setSpacing(4);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 12, 12, 12);
    layout->setSpacing(8);
    layout->addWidget(text_);
    layout->addWidget(buttons_);
    hide();
}

void UnitQuestion::ask(const work::PartRequest& request, const std::vector<work::UnitCandidate>& candidates) {
    qDeleteAll(buttons_->findChildren<QPushButton*>(Qt::FindDirectChildrenOnly));
    const QString file = look::toText(std::filesystem::path(request.part).filename());
    text_->setText("<b>" + tr("In which unit is %1?").arg(file.toHtmlEscaped()) + "</b><br>" +
                   tr("The file does not say. The part would be this large:"));
    for (const work::UnitCandidate& candidate : candidates) {
        auto* button = new QPushButton(QString("%1    %2").arg(QString::fromStdString(candidate.name), sizeText(candidate.size)), buttons_);
        button->setObjectName("unit." + QString::fromStdString(candidate.name));
        button->setStyleSheet("text-align: left; padding: 5px 10px;");
        list_->addWidget(button);
        work::PartRequest answer = request;
        answer.units = candidate.name;
        // The answer may take this very button away.
        connect(button, &QPushButton::clicked, this, [this, answer] { emit answered(answer); }, Qt::QueuedConnection);
    }
    auto* cancel = new QPushButton(tr("Do not import it"), buttons_);
    cancel->setObjectName("unit.cancel");
    cancel->setFlat(true);
    list_->addWidget(cancel);
    connect(cancel, &QPushButton::clicked, this, &UnitQuestion::cancelled, Qt::QueuedConnection);
    setVisible(true);
}

}  // namespace trapwright::pages
