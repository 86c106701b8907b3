#include "ui/session/design_commands.h"

#include <utility>

namespace trapwright::session {

namespace {

constexpr qint64 kOneEdit = 1000;  // [ms]

}  // namespace

SettingsCommand::SettingsCommand(const QString& what, const study::Settings& before,
                                 const study::Settings& after, Apply apply)
    : QUndoCommand(what), before_(before), after_(after), apply_(std::move(apply)) {
    age_.start();
}

bool SettingsCommand::mergeWith(const QUndoCommand* later) {
    if (later->text() != text() || age_.elapsed() > kOneEdit) return false;
    after_ = static_cast<const SettingsCommand*>(later)->after_;
    age_.restart();
    setObsolete(after_ == before_);
    return true;
}

PartCommand::PartCommand(const QString& what, PartVersion before, PartVersion after, Apply apply)
    : QUndoCommand(what), before_(std::move(before)), after_(std::move(after)), apply_(std::move(apply)) {}

}  // namespace trapwright::session
