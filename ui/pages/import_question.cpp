#include "ui/pages/import_question.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <filesystem>

#include "ui/look/text.h"
#include "ui/pages/part_files.h"

namespace trapwright::pages {

namespace {

QString fileName(const workflow::PartRequest& request) {
    return look::toText(std::filesystem::path(request.part).filename());
}

}  // namespace

ImportQuestion::ImportQuestion(QWidget* parent)
    : QFrame(parent), text_(new QLabel(this)), buttons_(new QWidget(this)), list_(new QVBoxLayout(buttons_)) {
    setObjectName("importQuestion");
    setStyleSheet(
        "#importQuestion { border: 1px solid palette(highlight); border-radius: 4px; background: "
        "palette(base); }");
    text_->setObjectName("importQuestion.text");
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

void ImportQuestion::askUnit(const workflow::PartRequest& request,
                             const std::vector<workflow::UnitCandidate>& candidates) {
    begin(tr("In which unit is %1?").arg(fileName(request)),
          tr("The file does not say. The part would be this large:"));
    // What a feeder can feed comes first.
    std::vector<workflow::UnitCandidate> ordered = candidates;
    std::stable_partition(ordered.begin(), ordered.end(), [](const workflow::UnitCandidate& candidate) {
        constexpr double kSmallest = 0.5e-3;
        constexpr double kLargest = 0.2;
        const double extent = candidate.size.maxCoeff();
        return extent >= kSmallest && extent <= kLargest;
    });
    for (const workflow::UnitCandidate& candidate : ordered) {
        const QString unit = QString::fromStdString(candidate.name);
        workflow::PartRequest answer = request;
        answer.units = candidate.name;
        addAnswer("unit." + unit, QString("%1:  %2").arg(unit, sizeText(candidate.size)), answer);
    }
    end();
}

void ImportQuestion::askRepair(const workflow::PartRequest& request, const geometry::MeshReport& found,
                               const QString& message) {
    begin(tr("Close the holes of %1?").arg(fileName(request)), message);
    workflow::PartRequest answer = request;
    answer.closeLargeHoles = true;
    addAnswer("repair",
              found.holes.size() == 1 ? tr("Close the hole and import it")
                                      : tr("Close the %1 holes and import it").arg(found.holes.size()),
              answer);
    end();
}

void ImportQuestion::begin(const QString& question, const QString& text) {
    qDeleteAll(buttons_->findChildren<QPushButton*>(Qt::FindDirectChildrenOnly));
    text_->setText("<b>" + question.toHtmlEscaped() + "</b><br>" + text.toHtmlEscaped());
}

QPushButton* ImportQuestion::addAnswer(const QString& name, const QString& text,
                                       const workflow::PartRequest& answer) {
    auto* button = new QPushButton(text, buttons_);
    button->setObjectName(name);
    button->setStyleSheet("text-align: left; padding: 5px 10px;");
    list_->addWidget(button);
    // The answer may take this very button away.
    connect(
        button, &QPushButton::clicked, this, [this, answer] { emit answered(answer); }, Qt::QueuedConnection);
    return button;
}

void ImportQuestion::end() {
    auto* cancel = new QPushButton(tr("Do not import it"), buttons_);
    cancel->setObjectName("import.cancel");
    cancel->setFlat(true);
    list_->addWidget(cancel);
    connect(cancel, &QPushButton::clicked, this, &ImportQuestion::cancelled, Qt::QueuedConnection);
    setVisible(true);
}

}  // namespace trapwright::pages
