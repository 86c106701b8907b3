#include "ui/look/whole_headers.h"

#include <QHeaderView>

namespace trapwright::look {

void keepHeadersWhole(QHeaderView& header) {
    const auto widen = [&header](int section) {
        if (header.isSectionHidden(section) || header.sectionResizeMode(section) == QHeaderView::Stretch)
            return;
        const int needed = header.sectionSizeHint(section);
        if (header.sectionSize(section) < needed) header.resizeSection(section, needed);
    };
    const auto widenAll = [&header, widen] {
        for (int section = 0; section < header.count(); ++section)
            widen(section);
    };
    QObject::connect(&header, &QHeaderView::sectionResized, &header, [widen](int section, int, int size) {
        // One that is being hidden has no width, and is not called hidden yet.
        if (size > 0) widen(section);
    });
    QObject::connect(&header, &QHeaderView::sectionCountChanged, &header, widenAll);
    QObject::connect(&header, &QHeaderView::geometriesChanged, &header, widenAll);
    if (header.model() != nullptr)
        QObject::connect(header.model(), &QAbstractItemModel::headerDataChanged, &header, widenAll);
    widenAll();
}

}  // namespace trapwright::look
