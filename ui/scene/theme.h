#pragma once

#include <QColor>

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

}  // namespace trapwright::scene
