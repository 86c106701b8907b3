#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

#include "core/workflow/example_studies.h"
#include "ui/session/study_opening.h"
#include "ui/session/study_session.h"
#include "ui/window/recent_files.h"

namespace trapwright::window {

/// The one study that is open in a window. A study that was never given a file is a draft: it is saved as it
/// happens like any other, in the program's own folder, until the user saves or discards it.
class StudyDesk : public QObject {
    Q_OBJECT
 public:
    StudyDesk(session::Environment environment, QObject* parent);
    ~StudyDesk() override;

    [[nodiscard]] session::StudySession* session() const { return session_.get(); }
    [[nodiscard]] const session::Environment& environment() const { return environment_; }
    [[nodiscard]] bool isOpening() const { return opening_.busy(); }
    [[nodiscard]] bool isDraft() const;
    /// For the title: the file's name, or the part's for a draft.
    [[nodiscard]] QString name() const;
    /// Its file; for a draft the one that it would be saved as, among the user's documents. Empty: none is
    /// open.
    [[nodiscard]] QString publicPath() const;
    RecentFiles& recent() { return recent_; }
    /// Drafts that were left behind when the program ended badly.
    [[nodiscard]] QStringList forgottenDrafts() const;

    /// A study that was opened in the background takes the place of the one before when `gate` calls back.
    /// Without one it does so at once.
    using Gate = std::function<void(const std::function<void()>& pass)>;
    void setGate(Gate gate) { gate_ = std::move(gate); }

    // Each of these closes what is open without a question: ask before.

    /// Opens it in the background, then tells whether that went well.
    void open(const std::filesystem::path& file, const std::function<void(const base::Status&)>& opened);
    base::Status createDraft(const workflow::LoadedPart& part);
    /// A copy of a learned study that comes with the program, as a draft, opened as by open().
    void openExample(const workflow::ExampleStudy& example,
                     const std::function<void(const base::Status&)>& opened);
    /// `withTracks`: StudySession::fork.
    base::Status forkToDraft(session::Fork kind);
    /// Deletes a draft's file if `keepDraft` is false.
    void close(bool keepDraft);
    /// A draft that nobody wants: its file goes as soon as another study takes its place, or it is closed.
    void discardLater() { discarded_ = true; }
    [[nodiscard]] bool isDiscarded() const { return discarded_; }

    /// Goes on under another name; a study of that name is replaced.
    base::Status saveAs(const std::filesystem::path& file);

 signals:
    /// Before the one that was open is deleted. Null: none is open.
    void sessionChanged(trapwright::session::StudySession* session);
    void nameChanged();

 private:
    void adopt(std::unique_ptr<session::StudySession> session);
    base::Result<std::filesystem::path> newDraftPath(const std::string& part) const;

    session::Environment environment_;
    Gate gate_ = [](const std::function<void()>& pass) { pass(); };
    session::StudyOpening opening_;
    RecentFiles recent_;
    std::unique_ptr<session::StudySession> session_;
    bool discarded_ = false;  // the open draft
};

}  // namespace trapwright::window
