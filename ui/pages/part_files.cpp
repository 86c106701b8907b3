#include "ui/pages/part_files.h"

#include <QCoreApplication>
#include <QStringList>

#include "core/part/import.h"
#include "ui/look/text.h"

namespace trapwright::pages {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("trapwright::pages::PartFiles", text);
}

}  // namespace

look::FileQuestion partQuestion() {
    QStringList patterns;
    for (const std::string& extension : part::supportedExtensions()) {
        const QString pattern = "*" + QString::fromStdString(extension);
        patterns << pattern << pattern.toUpper();
    }
    return {"part",       tr("Import a part"),
            tr("Import"), tr("Parts (%1);;All files (*)").arg(patterns.join(' ')),
            {},           {}};
}

workflow::PartRequest partRequest(const std::string& part) {
    workflow::PartRequest request;
    request.part = part;
    return request;
}

QString sizeText(const base::Vec3& size) {
    constexpr double kMillimetres = 1e3;
    const bool large = size.maxCoeff() >= 1.0;
    const double scale = large ? 1.0 : kMillimetres;
    return QString("%1 × %2 × %3 %4")
        .arg(look::numberText(size.x() * scale), look::numberText(size.y() * scale),
             look::numberText(size.z() * scale), large ? "m" : "mm");
}

}  // namespace trapwright::pages
