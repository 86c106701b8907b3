#include "ui/models/verdict_look.h"

#include <QCoreApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPainterPath>

#include "ui/look/theme.h"

namespace trapwright::models {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(VerdictLook)
};

/// The sign of a verdict on a square of 16 x 16.
QPainterPath signOf(trial::Verdict verdict) {
    QPainterPath path;
    switch (verdict) {
        case trial::Verdict::success:  // tick
            path.moveTo(2.5, 8.5);
            path.lineTo(6.5, 12.5);
            path.lineTo(13.5, 3.5);
            break;
        case trial::Verdict::wrongOrientation:  // arrow that has turned
            path.arcMoveTo(3, 3, 10, 10, 200);
            path.arcTo(3, 3, 10, 10, 200, -250);
            path.moveTo(14, 6);
            path.lineTo(11.3, 11.6);
            path.lineTo(7.2, 8.2);
            break;
        case trial::Verdict::stuck:  // two bars
            path.moveTo(5, 3);
            path.lineTo(5, 13);
            path.moveTo(11, 3);
            path.lineTo(11, 13);
            break;
        case trial::Verdict::fellOff:  // arrow over an edge
            path.moveTo(2, 3.5);
            path.lineTo(10, 3.5);
            path.lineTo(10, 13);
            path.moveTo(6, 9.5);
            path.lineTo(10, 13.5);
            path.lineTo(14, 9.5);
            break;
    }
    return path;
}

class SignEngine : public QIconEngine {
 public:
    explicit SignEngine(trial::Verdict verdict) : verdict_(verdict) {}

    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
        constexpr double kSide = 16.0;
        const double scale = std::min(rect.width(), rect.height()) / kSide;
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        painter->translate(rect.center() + QPointF(0.5, 0.5));
        painter->scale(scale, scale);
        painter->translate(-kSide / 2, -kSide / 2);
        if (mode == QIcon::Disabled) painter->setOpacity(0.4);
        painter->setPen(QPen(verdictColour(verdict_), 2.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        painter->drawPath(signOf(verdict_));
        painter->restore();
    }

    [[nodiscard]] QIconEngine* clone() const override { return new SignEngine(*this); }

    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        QPixmap pixmap(size);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        paint(&painter, QRect(QPoint(0, 0), size), mode, state);
        return pixmap;
    }

 private:
    trial::Verdict verdict_;
};

}  // namespace

QString verdictText(trial::Verdict verdict) {
    switch (verdict) {
        case trial::Verdict::success:
            return Text::tr("success");
        case trial::Verdict::wrongOrientation:
            return Text::tr("wrong orientation");
        case trial::Verdict::stuck:
            return Text::tr("stuck");
        case trial::Verdict::fellOff:
            return Text::tr("fell off");
    }
    return {};
}

QString verdictWord(trial::Verdict verdict) {
    return verdict == trial::Verdict::wrongOrientation ? Text::tr("wrong") : verdictText(verdict);
}

QColor verdictColour(trial::Verdict verdict) {
    switch (verdict) {
        case trial::Verdict::success:
            return look::kBluishGreen;
        case trial::Verdict::wrongOrientation:
            return look::kOrange;
        case trial::Verdict::stuck:
            return look::kReddishPurple;
        case trial::Verdict::fellOff:
            return look::kVermillion;
    }
    return {};
}

QIcon verdictIcon(trial::Verdict verdict) {
    return QIcon(new SignEngine(verdict));
}

}  // namespace trapwright::models
