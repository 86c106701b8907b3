#include "core/trial/predicted_speed.h"

#include <algorithm>
#include <cmath>

namespace trapwright::trial {

namespace {

/// A point on or above the plane; steps from event to event.
class HoppingPoint {
 public:
    HoppingPoint(const Vibration& drive, double friction, double restitution, double gravity, double slope)
        : w_(drive.angularFrequency()),
          along_(drive.halfStroke * std::cos(drive.angle)),
          up_(drive.halfStroke * std::sin(drive.angle)),
          friction_(friction),
          restitution_(restitution),
          gravity_(gravity * std::cos(slope)),
          back_(gravity * std::sin(slope)),
          scan_(drive.period() / 4000.0) {}

    [[nodiscard]] double x() const { return x_; }

    void advanceTo(double end) {
        while (t_ < end - 1e-13) {
            const double next = std::min(t_ + scan_, end);
            if (flying_)
                fly(next);
            else
                touch(next);
        }
    }

 private:
    [[nodiscard]] double planeZ(double t) const { return up_ * std::sin(w_ * t); }
    [[nodiscard]] double planeVz(double t) const { return up_ * w_ * std::cos(w_ * t); }
    [[nodiscard]] double planeVx(double t) const { return along_ * w_ * std::cos(w_ * t); }
    [[nodiscard]] double planeAx(double t) const { return -along_ * w_ * w_ * std::sin(w_ * t); }
    /// Normal force over mass.
    [[nodiscard]] double pressure(double t) const { return gravity_ - up_ * w_ * w_ * std::sin(w_ * t); }

    template <class F>
    static double bisect(const F& before, double low, double high) {
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (low + high);
            (before(middle) ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    void fly(double next) {
        const double t0 = t_;
        const double z0 = z_;
        const double v0 = vz_;
        const auto height = [&](double t) {
            return z0 + v0 * (t - t0) - 0.5 * gravity_ * (t - t0) * (t - t0) - planeZ(t);
        };
        const auto flies = [&](double t) { return height(t) > 0.0; };
        const bool lands = !flies(next);
        if (lands) next = bisect(flies, t0, next);
        x_ += vx_ * (next - t0) - 0.5 * back_ * (next - t0) * (next - t0);
        vx_ -= back_ * (next - t0);
        z_ = planeZ(next) + std::max(height(next), 0.0);
        vz_ = v0 - gravity_ * (next - t0);
        t_ = next;
        if (!lands) return;
        const double speed = planeVz(t_) - vz_;
        const double rebound = speed * restitution_ * std::clamp((speed - 3e-3) / 9e-3, 0.0, 1.0);
        const double slip = vx_ - planeVx(t_);
        vx_ -= std::copysign(std::min(std::abs(slip), friction_ * (speed + rebound)), slip);
        vz_ = planeVz(t_) + rebound;
        flying_ = rebound > 0.0 || pressure(t_) <= 0.0;
    }

    void touch(double next) {
        const auto presses = [&](double t) { return pressure(t) > 0.0; };
        const bool leaves = !presses(next);
        if (leaves) next = bisect(presses, t_, next);
        // Within one scan the forces hardly change: the slip's equation by the midpoint rule, its zero by
        // proportion.
        const double dt = next - t_;
        const double middle = t_ + 0.5 * dt;
        const double slip = vx_ - planeVx(t_);
        const double limit = friction_ * pressure(middle);
        const double before = vx_;
        vx_ -= back_ * dt;
        const double free = vx_ - planeVx(next);
        if (std::abs(free) <= limit * dt && std::abs(planeAx(middle) + back_) <= limit) {
            vx_ = planeVx(next);
        } else {
            const double direction = slip != 0.0 ? std::copysign(1.0, slip) : std::copysign(1.0, free);
            const double after = free - direction * limit * dt;
            if (direction * after >= 0.0) {
                vx_ -= direction * limit * dt;
            } else {
                const double share = std::abs(slip) / (std::abs(slip) + std::abs(after));
                vx_ -= direction * limit * dt * (2.0 * share - 1.0);
            }
        }
        x_ += 0.5 * (before + vx_) * dt;
        t_ = next;
        z_ = planeZ(t_);
        vz_ = planeVz(t_);
        flying_ = leaves;
    }

    double w_, along_, up_, friction_, restitution_;
    double gravity_;  // across the plane
    double back_;     // along it, backwards
    double scan_;
    double t_ = 0.0, x_ = 0.0, z_ = 0.0;
    double vx_ = 0.0, vz_ = 0.0;
    bool flying_ = false;
};

/// The plane's motion (displacement amplitude times sine), the point's friction limit and its weight along
/// the plane.
class Plane {
 public:
    Plane(const Vibration& drive, double friction, double gravity, double slope)
        : w_(drive.angularFrequency()),
          x_(drive.halfStroke * std::cos(drive.angle)),
          z_(drive.halfStroke * std::sin(drive.angle)),
          friction_(friction),
          gravity_(gravity * std::cos(slope)),
          back_(gravity * std::sin(slope)) {}

    [[nodiscard]] double speed(double t) const { return x_ * w_ * std::cos(w_ * t); }
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
    /// What friction must give for the point to go with the plane.
    [[nodiscard]] double needed(double t) const { return acceleration(t) + back_; }
    [[nodiscard]] double back() const { return back_; }

 private:
    [[nodiscard]] double acceleration(double t) const { return -x_ * w_ * w_ * std::sin(w_ * t); }

    double w_, x_, z_, friction_;
    double gravity_;  // across the plane
    double back_;     // along it, backwards
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

double calcHoppingSpeed(const Vibration& drive, double friction, double restitution, double gravity,
                        int periods, double slope) {
    HoppingPoint point(drive, friction, restitution, gravity, slope);
    point.advanceTo(periods * drive.period());
    const double mark = point.x();
    point.advanceTo(2 * periods * drive.period());
    return (point.x() - mark) / (periods * drive.period());
}

double calcStickSlipSpeed(const Vibration& drive, double friction, double gravity, double slope) {
    const Plane plane(drive, friction, gravity, slope);
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
                const auto holds = [&](double s) { return std::abs(plane.needed(s)) <= plane.limit(s); };
                const bool slips = !holds(next);
                if (slips) next = bisect(holds, t, next);
                x += plane.displacement(next) - plane.displacement(t);
                v = plane.speed(next);
                t = next;
                if (slips) direction = plane.needed(t) > 0.0 ? -1 : 1;
                continue;
            }
            const double t0 = t;
            const double v0 = v;
            const auto speedAt = [&](double s) {
                return v0 - plane.back() * (s - t0) -
                       direction * (plane.limitIntegral(s) - plane.limitIntegral(t0));
            };
            const auto slides = [&](double s) { return direction * (speedAt(s) - plane.speed(s)) > 0.0; };
            // Just after slip sets in the relative speed grows from zero; look one scan ahead only.
            const bool ends = !slides(next);
            if (ends) next = bisect(slides, t, next);
            x += v0 * (next - t0) - 0.5 * plane.back() * (next - t0) * (next - t0) -
                 direction * (plane.limitDoubleIntegral(next) - plane.limitDoubleIntegral(t0) -
                              plane.limitIntegral(t0) * (next - t0));
            v = speedAt(next);
            t = next;
            if (ends) {
                v = plane.speed(t);
                const bool sticks = std::abs(plane.needed(t)) <= plane.limit(t);
                direction = sticks ? 0 : (plane.needed(t) > 0.0 ? -1 : 1);
            }
        }
        mean = (x - markX) / period;
        if (p > 0 && std::abs(mean - lastMean) < kSameSpeed) break;
    }
    return mean;
}

ConveyingPrediction predictConveying(const Vibration& drive, const ContactParameters& contact, double gravity,
                                     double slope) {
    // Hops need not repeat every period; over this many their mean has settled to a per cent.
    constexpr int kPeriods = 100;
    constexpr double kStandstill = 1e-6;  // [m/s]

    ConveyingPrediction prediction;
    prediction.throwNumber = std::abs(calcThrowNumber(drive, gravity * std::cos(slope)));
    const double friction = contact.kineticFriction;
    if (slope != 0.0 && friction <= std::abs(std::tan(slope))) {
        prediction.conveyance = Conveyance::slidesAway;
        return prediction;
    }
    const bool hops = prediction.throwNumber > 1.0;
    prediction.speed = hops ? calcHoppingSpeed(drive, friction, contact.restitution, gravity, kPeriods, slope)
                            : calcStickSlipSpeed(drive, friction, gravity, slope);
    prediction.conveyance = hops                                       ? Conveyance::hops
                            : std::abs(prediction.speed) > kStandstill ? Conveyance::slides
                                                                       : Conveyance::sticks;
    return prediction;
}

}  // namespace trapwright::trial
