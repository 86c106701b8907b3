#pragma once

#include <QObject>
#include <QStringList>
#include <filesystem>

namespace trapwright::window {

/// The studies that were open recently, newest first, remembered between starts; and which page of each study
/// was shown last. Some may be gone, or on a disk that is not there at the moment.
class RecentFiles : public QObject {
    Q_OBJECT
 public:
    using QObject::QObject;

    static constexpr int kMost = 10;

    void add(const std::filesystem::path& file);
    void remove(const std::filesystem::path& file);
    void clear();
    [[nodiscard]] QStringList list() const;

    /// The page that was shown when the study was left, by its name; also of a draft, which is not in the
    /// list.
    void setPage(const std::filesystem::path& file, const QString& page);
    /// Empty if the study was never left.
    [[nodiscard]] QString page(const std::filesystem::path& file) const;

 signals:
    void changed();
};

}  // namespace trapwright::window
