#pragma once

#include <QObject>
#include <QStringList>
#include <filesystem>

namespace trapwright::window {

/// The studies that were open lately, newest first, remembered between starts. Those that are gone are left
/// out.
class RecentFiles : public QObject {
    Q_OBJECT
 public:
    using QObject::QObject;

    static constexpr int kMost = 10;

    void add(const std::filesystem::path& file);
    void remove(const std::filesystem::path& file);
    void clear();
    [[nodiscard]] QStringList list() const;

 signals:
    void changed();
};

}  // namespace trapwright::window
