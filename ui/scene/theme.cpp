#include "ui/scene/theme.h"

#include <algorithm>
#include <cmath>
#include <sstream>

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

QColor heightColour(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * (kHeightColours.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), kHeightColours.size() - 2);
    const double part = place - static_cast<double>(below);
    const QColor low(kHeightColours[below]);
    const QColor high(kHeightColours[below + 1]);
    const auto mixed = [part](int from, int to) {
        return static_cast<int>(std::lround(from + part * (to - from)));
    };
    return {mixed(low.red(), high.red()), mixed(low.green(), high.green()), mixed(low.blue(), high.blue())};
}

std::string heightColourShader() {
    std::ostringstream text;
    text << "vec3 heightColour(float share) {\n  vec3 stops[" << kHeightColours.size() << "];\n";
    for (std::size_t i = 0; i < kHeightColours.size(); ++i) {
        const QColor colour(kHeightColours[i]);
        text << "  stops[" << i << "] = vec3(" << colour.redF() << ", " << colour.greenF() << ", "
             << colour.blueF() << ");\n";
    }
    text << "  float place = clamp(share, 0.0, 1.0) * " << kHeightColours.size() - 1 << ".0;\n"
         << "  int below = min(int(place), " << kHeightColours.size() - 2 << ");\n"
         << "  return mix(stops[below], stops[below + 1], place - float(below));\n}\n";
    return text.str();
}

}  // namespace trapwright::scene
