#pragma once

#include <QImage>
#include <QPixmap>
#include <QTest>
#include <cmath>
#include <memory>

#include "core/part/bundled.h"
#include "core/part/import.h"
#include "core/part/part_builder.h"
#include "core/study/presets.h"
#include "core/track/track_file.h"
#include "ui/scene/scene_view.h"

namespace trapwright::samples {

/// A track that comes with Trapwright.
inline std::shared_ptr<const track::Track> loadTrack(const char* file) {
    const auto loaded = track::readTrackFile(study::findResourceTrack(file));
    if (!loaded.ok()) qFatal("%s", loaded.error().message.c_str());
    return std::make_shared<const track::Track>(loaded->track);
}

inline std::shared_ptr<const part::Part> loadPart(const char* name) {
    const auto mesh = part::importMesh(part::findBundledFile(*part::findBundledPart(name)));
    if (!mesh.ok()) qFatal("%s", mesh.error().message.c_str());
    return std::make_shared<const part::Part>(part::buildPart(mesh->mesh, {})->part);
}

/// What a view shows when it has drawn what was set. Null if it does not come to that.
inline QImage grabSettled(scene::SceneView& view) {
    if (!QTest::qWaitFor([&] { return view.isSettled(); }, 20000)) return {};
    return view.grab().toImage();
}

/// The share of pixels that differ by more than `tolerance` in a colour. 1 where the sizes differ.
inline double shareChanged(const QImage& a, const QImage& b, int tolerance = 12) {
    if (a.size() != b.size() || a.isNull()) return 1.0;
    qsizetype changed = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const QColor first = a.pixelColor(x, y);
            const QColor second = b.pixelColor(x, y);
            if (std::abs(first.red() - second.red()) > tolerance ||
                std::abs(first.green() - second.green()) > tolerance ||
                std::abs(first.blue() - second.blue()) > tolerance)
                ++changed;
        }
    }
    return static_cast<double>(changed) / (static_cast<double>(a.width()) * a.height());
}

/// The share of pixels whose hue lies within 20 degrees of a colour's and that are clearly coloured.
inline double shareOfHue(const QImage& image, const QColor& colour) {
    qsizetype found = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const QColor pixel = image.pixelColor(x, y);
            const int apart = std::abs(pixel.hsvHue() - colour.hsvHue());
            if (pixel.hsvSaturation() > 70 && std::min(apart, 360 - apart) <= 20) ++found;
        }
    }
    return static_cast<double>(found) / (static_cast<double>(image.width()) * image.height());
}

inline double meanLightness(const QImage& image) {
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x)
            sum += image.pixelColor(x, y).lightnessF();
    }
    return sum / (static_cast<double>(image.width()) * image.height());
}

}  // namespace trapwright::samples
