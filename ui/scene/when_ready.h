#pragma once

#include <QFuture>
#include <QFutureWatcher>
#include <utility>

namespace trapwright::scene {

/// Calls `use` in the GUI thread with what `future` brings, unless `receiver` has gone by then.
template <class Value, class Use>
void whenReady(const QFuture<Value>& future, QObject* receiver, Use use) {
    auto* watcher = new QFutureWatcher<Value>(receiver);
    QObject::connect(watcher, &QFutureWatcherBase::finished, receiver, [watcher, use = std::move(use)] {
        watcher->deleteLater();
        use(watcher->result());
    });
    watcher->setFuture(future);
}

}  // namespace trapwright::scene
