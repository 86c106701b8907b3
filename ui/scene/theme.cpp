#include "ui/scene/theme.h"

namespace trapwright::scene {

SceneTheme SceneTheme::light() {
    return {.backgroundTop = QColor(0xf7f8fa),
            .backgroundBottom = QColor(0xdde3ea),
            .leadIn = QColor(0xb9c6d3),
            .trap = QColor(0x879cb3),
            .side = QColor(0xb6c1cc),
            .part = QColor(0xeaa868),
            .accent = QColor(0x0b63b0),
            .trace = QColor(0xc2571a),
            .contact = QColor(0xcc3311),
            .edge = QColor(0x26323f),
            .text = QColor(0x1f2933),
            .faintText = QColor(0x5b6875)};
}

SceneTheme SceneTheme::dark() {
    return {.backgroundTop = QColor(0x31363e),
            .backgroundBottom = QColor(0x1a1d21),
            .leadIn = QColor(0x75879a),
            .trap = QColor(0x4f6883),
            .side = QColor(0x64707e),
            .part = QColor(0xe8a05c),
            .accent = QColor(0x7cc8ff),
            .trace = QColor(0xf0b27a),
            .contact = QColor(0xff7f66),
            .edge = QColor(0x12161b),
            .text = QColor(0xeceff3),
            .faintText = QColor(0xa4afbb)};
}

}  // namespace trapwright::scene
