#pragma once

#include <QColor>

#include <array>
#include <string>

namespace trapwright::scene {

/// The colours of a scene. Shading makes surfaces lighter and darker than named here.
struct SceneTheme {
    QColor backgroundTop;
    QColor backgroundBottom;
    QColor leadIn;  // surface of the lead-in and the lead-out
    QColor trap;    // surface of the trap, darker, as in the paper's Figure 3
    QColor side;    // sides and base of a track, flats, printable solids
    QColor part;
    QColor accent;  // start point, finish line, conveying arrow
    QColor trace;
    QColor contact;  // arrows of contact forces
    QColor edge;
    QColor text;
    QColor faintText;

    static SceneTheme light();
    static SceneTheme dark();

    friend bool operator==(const SceneTheme&, const SceneTheme&) = default;
};

/// Colours of height shading, evenly spaced from the lowest to the highest: cividis, which is even in
/// lightness and reads the same to people who do not see red and green apart (Nunez et al. 2018).
inline constexpr std::array<QRgb, 9> kHeightColours = {0xff00224e, 0xff1a386f, 0xff434e6c,
                                                       0xff61646f, 0xff7d7c78, 0xff9b9476,
                                                       0xffbcae6c, 0xffdfca59, 0xfffee838};

/// The colour of `share`, 0 the lowest, 1 the highest; clamped.
QColor heightColour(double share);

/// `vec3 heightColour(float share)` in GLSL: the same colours, as red, green and blue from 0 to 1.
std::string heightColourShader();

}  // namespace trapwright::scene
