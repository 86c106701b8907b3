#include "ui/scene/height_colours.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace trapwright::scene {

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
