#include "core/verify/stick_slip.h"

#include <cmath>

namespace trapwright::verify {

namespace {

/// The plane's motion (displacement amplitude times sine) and the point's friction limit.
class Plane {
 public:
    Plane(const trial::Vibration& drive, double friction, double gravity)
        : w_(drive.angularFrequency()),
          x_(drive.halfStroke * std::cos(drive.angle)),
          z_(drive.halfStroke * std::sin(drive.angle)),
          friction_(friction),
          gravity_(gravity) {}

    [[nodiscard]] double speed(double t) const { return x_ * w_ * std::cos(w_ * t); }
    [[nodiscard]] double acceleration(double t) const { return -x_ * w_ * w_ * std::sin(w_ * t); }
    /// Largest acceleration that friction can give.
    [[nodiscard]] double limit(double t) const {
        return friction_ * (gravity_ - z_ * w_ * w_ * std::sin(w_ * t));
    }
    /// Integral of limit from 0 to t, and the integral of that.
    [[nodiscard]] double limitIntegral(double t) const {
        return friction_ * (gravity_ * t + z_ * w_ * (std::cos(w_ * t) - 1.0));
    }
    [[nodiscard]] double limitDoubleIntegral(double t) const {
        return friction_ * (0.5 * gravity_ * t * t + z_ * (std::sin(w_ * t) - w_ * t));
    }
    [[nodiscard]] double displacement(double t) const { return x_ * std::sin(w_ * t); }

 private:
    double w_, x_, z_, friction_, gravity_;
};

template <class F>
double bisect(const F& positiveBefore, double low, double high) {
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (positiveBefore(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

double calcStickSlipSpeed(const trial::Vibration& drive, double friction, double gravity) {
    const Plane plane(drive, friction, gravity);
    const double period = drive.period();
    const double scan = period / 2000.0;
    // With little friction it takes long until one period is like the last.
    constexpr int kMostPeriods = 5000;
    constexpr double kSameSpeed = 1e-9;  // [m/s]

    double t = 0.0;
    double v = 0.0;  // of the point, in the room
    double x = 0.0;
    int direction = v > plane.speed(0.0) ? 1 : -1;  // of the point relative to the plane; 0: sticks
    double mean = 0.0;
    for (int p = 0; p < kMostPeriods; ++p) {
        const double markX = x;
        const double lastMean = mean;
        const double end = (p + 1) * period;
        while (t < end - 1e-12) {
            double next = std::min(t + scan, end);
            if (direction == 0) {
                const auto holds = [&](double s) {
                    return std::abs(plane.acceleration(s)) <= plane.limit(s);
                };
                const bool slips = !holds(next);
                if (slips) next = bisect(holds, t, next);
                x += plane.displacement(next) - plane.displacement(t);
                v = plane.speed(next);
                t = next;
                if (slips) direction = plane.acceleration(t) > 0.0 ? -1 : 1;
                continue;
            }
            const double t0 = t;
            const double v0 = v;
            const auto speedAt = [&](double s) {
                return v0 - direction * (plane.limitIntegral(s) - plane.limitIntegral(t0));
            };
            const auto slides = [&](double s) { return direction * (speedAt(s) - plane.speed(s)) > 0.0; };
            // Just after slip sets in the relative speed grows from zero; look one scan ahead only.
            const bool ends = !slides(next);
            if (ends) next = bisect(slides, t, next);
            x += v0 * (next - t0) -
                 direction * (plane.limitDoubleIntegral(next) - plane.limitDoubleIntegral(t0) -
                              plane.limitIntegral(t0) * (next - t0));
            v = speedAt(next);
            t = next;
            if (ends) {
                v = plane.speed(t);
                const bool sticks = std::abs(plane.acceleration(t)) <= plane.limit(t);
                direction = sticks ? 0 : (plane.acceleration(t) > 0.0 ? -1 : 1);
            }
        }
        mean = (x - markX) / period;
        if (p > 0 && std::abs(mean - lastMean) < kSameSpeed) break;
    }
    return mean;
}

}  // namespace trapwright::verify
