#include "ui/window/study_desk.h"

#include <QDir>
#include <QStandardPaths>
#include <utility>

#include "core/store/replaced_study.h"
#include "core/study/presets.h"
#include "ui/look/text.h"
#include "ui/session/study_design.h"

namespace trapwright::window {

namespace {

std::filesystem::path draftFolder() {
    return std::filesystem::path(
               QFile::encodeName(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation))
                   .toStdString()) /
           "drafts";
}

bool isInDrafts(const std::filesystem::path& file) {
    return file.parent_path() == draftFolder();
}

/// What a new study of this part begins with: Table 1, of the column that is the part's own if it has one.
base::Result<study::Settings> firstSettings(const workflow::LoadedPart& part) {
    auto settings = study::presetSettings(part.settings.file == "cone" ? "cone" : "cuboid");
    if (settings) settings->part = part.settings;
    return settings;
}

void removeStudy(const std::filesystem::path& file) {
    // SQLite's own files beside it go with it.
    for (const char* suffix : {"", "-wal", "-shm"}) {
        std::error_code ignored;
        std::filesystem::remove(file.string() + suffix, ignored);
    }
}

}  // namespace

StudyDesk::StudyDesk(session::Environment environment, QObject* parent)
    : QObject(parent), environment_(std::move(environment)) {}

StudyDesk::~StudyDesk() = default;

bool StudyDesk::isDraft() const {
    return session_ && isInDrafts(session_->path());
}

QString StudyDesk::name() const {
    if (!session_) return {};
    if (isDraft())
        return tr("%1 (not saved yet)").arg(QString::fromStdString(session_->design().part()->name));
    return look::toText(session_->path().filename());
}

QString StudyDesk::publicPath() const {
    if (!session_) return {};
    if (!isDraft()) return look::toText(session_->path());
    return QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + '/' +
           QString::fromStdString(session_->design().part()->name) + ".trap";
}

QStringList StudyDesk::forgottenDrafts() const {
    QStringList drafts;
    const QDir folder(look::toText(draftFolder()));
    for (const QFileInfo& file : folder.entryInfoList({"*.trap"}, QDir::Files, QDir::Time)) {
        if (session_ && file.absoluteFilePath() == look::toText(session_->path())) continue;
        drafts.push_back(file.absoluteFilePath());
    }
    return drafts;
}

base::Status StudyDesk::createDraft(const workflow::LoadedPart& part) {
    auto settings = firstSettings(part);
    if (!settings) return settings.error();
    const auto path = newDraftPath(part.part->name);
    if (!path) return path.error();
    auto created = session::StudySession::create(*path, *settings, part.stored, environment_);
    if (!created) return created.error();
    adopt(std::move(*created));
    return base::success();
}

void StudyDesk::openExample(const workflow::ExampleStudy& example,
                            const std::function<void(const base::Status&)>& opened) {
    const auto path = newDraftPath(std::string(example.name));
    if (!path) return opened(path.error());
    if (const auto copied = workflow::copyExample(example, *path); !copied) return opened(copied.error());
    open(*path, [path = *path, opened](const base::Status& status) {
        if (!status) removeStudy(path);
        opened(status);
    });
}

base::Status StudyDesk::forkToDraft(session::Fork kind) {
    const auto path = newDraftPath(session_->design().part()->name);
    if (!path) return path.error();
    auto forked = session_->fork(*path, kind);
    if (!forked) return forked.error();
    adopt(std::move(*forked));
    return base::success();
}

void StudyDesk::open(const std::filesystem::path& file,
                     const std::function<void(const base::Status&)>& opened) {
    const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
    opening_.start(
        path, environment_, [this, path, opened](base::Result<std::unique_ptr<session::StudySession>> study) {
            if (!study) {
                discarded_ = false;
                return opened(study.error());
            }
            // Shared: a function that can be copied holds nothing else.
            const auto held = std::make_shared<std::unique_ptr<session::StudySession>>(std::move(*study));
            gate_([this, held, path, opened] {
                adopt(std::move(*held));
                if (!isDraft()) recent_.add(path);
                opened(base::success());
            });
        });
}

void StudyDesk::close(bool keepDraft) {
    if (!session_) return;
    if (!keepDraft) discardLater();
    adopt(nullptr);
}

base::Status StudyDesk::saveAs(const std::filesystem::path& file) {
    const std::filesystem::path before = session_->path();
    const bool wasDraft = isDraft();
    if (file == before) {
        return base::Error{
            session_->isInPlace()
                ? file.string() + " is the study that is open, saved as it is."
                : "That is the name of the file that is gone, which is still kept for it. Choose "
                  "another one."};
    }
    auto replaced = store::ReplacedStudy::setAside(file);
    if (!replaced) return replaced.error();
    auto saved = session_->saveAs(file);
    if (!saved) return saved;
    replaced->discard();
    discarded_ = false;
    if (wasDraft) removeStudy(before);
    recent_.add(session_->path());
    emit nameChanged();
    return base::success();
}

void StudyDesk::adopt(std::unique_ptr<session::StudySession> session) {
    std::filesystem::path unwanted;
    if (std::exchange(discarded_, false) && isDraft()) unwanted = session_->path();
    emit sessionChanged(session.get());
    session_ = std::move(session);
    if (!unwanted.empty()) removeStudy(unwanted);
    emit nameChanged();
}

base::Result<std::filesystem::path> StudyDesk::newDraftPath(const std::string& part) const {
    const std::filesystem::path folder = draftFolder();
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        return base::Error{"The folder " + folder.string() + " for unsaved studies cannot be made: " +
                           failure.message() + ". Give the program a home folder that it can write."};
    }
    for (int number = 1;; ++number) {
        const std::filesystem::path path = folder / (part + "-" + std::to_string(number) + ".trap");
        if (!std::filesystem::exists(path)) return path;
    }
}

}  // namespace trapwright::window
