#include "ui/window/recent_files.h"

#include <QFile>
#include <QSettings>
#include <QVariantMap>

#include "ui/look/text.h"

namespace trapwright::window {

namespace {

const QString kSetting = QStringLiteral("recentStudies");
const QString kPages = QStringLiteral("recentPages");

QStringList stored() {
    return QSettings().value(kSetting).toStringList();
}

}  // namespace

void RecentFiles::add(const std::filesystem::path& file) {
    QStringList files = stored();
    const QString path = look::toText(std::filesystem::absolute(file).lexically_normal());
    files.removeAll(path);
    files.prepend(path);
    QSettings().setValue(kSetting, QStringList(files.mid(0, kMost)));
    emit changed();
}

void RecentFiles::remove(const std::filesystem::path& file) {
    QStringList files = stored();
    files.removeAll(look::toText(file));
    QSettings().setValue(kSetting, files);
    emit changed();
}

void RecentFiles::clear() {
    QSettings().remove(kSetting);
    QSettings().remove(kPages);
    emit changed();
}

QStringList RecentFiles::list() const {
    return stored();
}

void RecentFiles::setPage(const std::filesystem::path& file, const QString& page) {
    QVariantMap pages = QSettings().value(kPages).toMap();
    for (const QString& known : pages.keys())
        if (!QFile::exists(known)) pages.remove(known);
    pages.insert(look::toText(file), page);
    QSettings().setValue(kPages, pages);
}

QString RecentFiles::page(const std::filesystem::path& file) const {
    return QSettings().value(kPages).toMap().value(look::toText(file)).toString();
}

}  // namespace trapwright::window
