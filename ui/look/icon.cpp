#include "ui/look/icon.h"

#include <QFile>
#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QPixmapCache>
#include <QSvgRenderer>

// The linker leaves a library's resources out unless they are asked for, which Qt wants done outside
// namespaces.
static void useIcons() {
    Q_INIT_RESOURCE(icons);
}

namespace trapwright::look {

namespace {

/// A drawing with its two colours replaced.
QPixmap drawIcon(const QString& name, const QColor& lines, const QColor& accent, QSize pixels) {
    const QString key = QString("trapwright/%1/%2/%3/%4x%5")
                            .arg(name, lines.name(), accent.name(), QString::number(pixels.width()),
                                 QString::number(pixels.height()));
    QPixmap pixmap;
    if (QPixmapCache::find(key, &pixmap)) return pixmap;

    useIcons();
    QFile file(":/icons/" + name + ".svg");
    const bool opened = file.open(QIODevice::ReadOnly);
    Q_ASSERT_X(opened, "look::icon", qPrintable(name));
    QByteArray drawing = opened ? file.readAll() : QByteArray();
    drawing.replace("\"#000\"", '"' + lines.name().toLatin1() + '"');
    drawing.replace("\"#00f\"", '"' + accent.name().toLatin1() + '"');

    pixmap = QPixmap(pixels);
    pixmap.fill(Qt::transparent);
    QSvgRenderer renderer(drawing);
    renderer.setAspectRatioMode(Qt::KeepAspectRatio);
    QPainter painter(&pixmap);
    renderer.render(&painter);
    QPixmapCache::insert(key, pixmap);
    return pixmap;
}

class IconEngine : public QIconEngine {
 public:
    explicit IconEngine(QString name) : name_(std::move(name)) {}

    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
        const qreal ratio = painter->device()->devicePixelRatioF();
        QPixmap picture = pixmap((QSizeF(rect.size()) * ratio).toSize(), mode, state);
        picture.setDevicePixelRatio(ratio);
        painter->drawPixmap(rect, picture);
    }
    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State) override {
        const QPalette palette = QGuiApplication::palette();
        const auto group = mode == QIcon::Disabled ? QPalette::Disabled : QPalette::Active;
        const bool onAccent = mode == QIcon::Selected;
        const QColor lines =
            palette.color(group, onAccent ? QPalette::HighlightedText : QPalette::ButtonText);
        const bool plain = onAccent || mode == QIcon::Disabled;
        return drawIcon(name_, lines, plain ? lines : palette.color(QPalette::Highlight), size);
    }
    QIconEngine* clone() const override { return new IconEngine(*this); }
    QString key() const override { return QStringLiteral("trapwright"); }
    QString iconName() override { return name_; }

 private:
    QString name_;
};

}  // namespace

QIcon icon(const QString& name) {
    return QIcon(new IconEngine(name));
}

QIcon programIcon() {
    useIcons();
    return QIcon(":/icons/trapwright.svg");
}

QPixmap signPixmap(const QString& name, const QColor& colour, int size, qreal pixelRatio) {
    const int pixels = qRound(size * pixelRatio);
    QPixmap pixmap = drawIcon(name, colour, colour, {pixels, pixels});
    pixmap.setDevicePixelRatio(pixelRatio);
    return pixmap;
}

}  // namespace trapwright::look
