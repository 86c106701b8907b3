#include "ui/feeder/report_card.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/study/pose_weights.h"
#include "ui/feeder/placing_scene.h"
#include "ui/feeder/trial_guide.h"
#include "ui/look/file_dialog.h"
#include "ui/look/icon.h"
#include "ui/look/text.h"
#include "ui/scene/picture_maker.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_session.h"

namespace trapwright::feeder {

ReportCard::ReportCard(TrialGuide& guide, PlacingScene& placing, const std::string& program, QWidget* parent)
    : QWidget(parent),
      guide_(guide),
      placing_(placing),
      program_(program),
      save_(new QPushButton(look::icon("export"), tr("Save the report..."), this)),
      text_(new QLabel(this)) {
    save_->setObjectName("feeder.report.save");
    save_->setToolTip(
        tr("Part, track, drive, settings, tables and charts, for print; beside it the table and "
           "every trial as CSV"));
    text_->setObjectName("feeder.report.text");
    text_->setWordWrap(true);
    text_->setForegroundRole(QPalette::PlaceholderText);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    column->addWidget(save_);
    column->addWidget(text_);
    connect(save_, &QPushButton::clicked, this, &ReportCard::askAndWrite);
    connect(&guide_, &TrialGuide::changed, this, &ReportCard::update);
    connect(&guide_, &TrialGuide::chosen, this, &ReportCard::update);
    update();
}

void ReportCard::setSession(const session::StudySession* session) {
    session_ = session;
    update();
}

void ReportCard::write(const std::filesystem::path& pdf) {
    if (!session_ || guide_.validation() == nullptr) return;
    const base::Status written = writeReport(makeReport(), pdf);
    if (!written) {
        emit failed(tr("The report cannot be saved"), QString::fromStdString(written.error().message));
        return;
    }
    text_->setText(tr("Wrote %1, and beside it the table and the trials as CSV.").arg(look::pathText(pdf)));
}

Report ReportCard::makeReport() const {
    const study::PhysicalValidation& physical = *guide_.validation();
    Report report;
    report.study = look::toText(session_->path().filename());
    report.part = session_->design().part();
    report.settings = session_->design().settings();
    report.physical = physical;
    if (const study::ValidationRecord* found = study::findSimulated(session_->runs().validations(), physical))
        report.simulated = *found;
    report.table = study::comparePhysical(report.simulated ? &*report.simulated : nullptr, physical,
                                          study::weighPoseGroups(*report.part, report.settings));
    report.calibrations = session_->feeder().calibrations();
    scene::PictureMaker pictures;
    pictures.setTheme(scene::SceneTheme::light());
    if (placing_.track()) report.track = pictures.trackPicture(placing_.track(), kTrackPicture).result();
    const ExpectedExit expected = placing_.expected();
    report.goal = expected.goal;
    report.expected = expectedPicture(pictures, expected, kExpectedPicture).result();
    for (const part::StablePose& pose : report.part->stablePoses)
        report.poses.push_back(pictures.partPicture(report.part, pose.rotation, kPosePicture).result());
    report.program = QString::fromStdString(program_);
    report.written = QDateTime::currentDateTime();
    return report;
}

void ReportCard::askAndWrite() {
    if (!session_ || guide_.validation() == nullptr) return;
    const QString name = tr("validation-%1").arg(guide_.validation()->number + 1);
    look::askForNewFile(this, {"report", tr("Save the report"), tr("Save"), tr("PDF (*.pdf)"), "pdf", name},
                        [this](const std::filesystem::path& file) { write(file); });
}

void ReportCard::update() {
    save_->setEnabled(guide_.made() > 0);
    text_->setText(guide_.made() > 0 ? tr("The report covers the trials made so far.")
                                     : tr("There is a report as soon as there is a trial."));
}

}  // namespace trapwright::feeder
