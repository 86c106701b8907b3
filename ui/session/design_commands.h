#pragma once

#include <QElapsedTimer>
#include <QUndoCommand>
#include <functional>
#include <memory>

#include "core/store/study_file.h"
#include "core/study/settings.h"

namespace trapwright::session {

/// A change of the settings. One that soon follows another of the same name goes on with it, so that a value
/// that is dragged is undone in one step.
class SettingsCommand : public QUndoCommand {
 public:
    using Apply = std::function<void(const study::Settings&)>;

    SettingsCommand(const QString& what, const study::Settings& before, const study::Settings& after,
                    Apply apply);

    void undo() override { apply_(before_); }
    void redo() override { apply_(after_); }
    [[nodiscard]] int id() const override { return 1; }
    bool mergeWith(const QUndoCommand* later) override;

 private:
    study::Settings before_;
    study::Settings after_;
    Apply apply_;
    QElapsedTimer age_;
};

/// A part as a study has it.
struct PartVersion {
    std::shared_ptr<const store::StoredPart> stored;
    study::PartSettings settings;
    std::shared_ptr<const part::Part> part;
};

/// A change of the part.
class PartCommand : public QUndoCommand {
 public:
    using Apply = std::function<void(const PartVersion&)>;

    PartCommand(const QString& what, PartVersion before, PartVersion after, Apply apply);

    void undo() override { apply_(before_); }
    void redo() override { apply_(after_); }

 private:
    PartVersion before_;
    PartVersion after_;
    Apply apply_;
};

}  // namespace trapwright::session
