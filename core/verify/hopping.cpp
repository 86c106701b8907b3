#include "core/verify/hopping.h"

#include <algorithm>
#include <cmath>

namespace trapwright::verify {

namespace {

/// A point on or above the plane; steps from event to event.
class HoppingPoint {
 public:
    HoppingPoint(const trial::Vibration& drive, double friction, double restitution, double gravity)
        : w_(drive.angularFrequency()),
          along_(drive.halfStroke * std::cos(drive.angle)),
          up_(drive.halfStroke * std::sin(drive.angle)),
          friction_(friction),
          restitution_(restitution),
          gravity_(gravity),
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
        x_ += vx_ * (next - t0);
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
        const double free = vx_ - planeVx(next);
        if (std::abs(free) <= limit * dt && std::abs(planeAx(middle)) <= limit) {
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

    double w_, along_, up_, friction_, restitution_, gravity_, scan_;
    double t_ = 0.0, x_ = 0.0, z_ = 0.0;
    double vx_ = 0.0, vz_ = 0.0;
    bool flying_ = false;
};

}  // namespace

double calcHoppingSpeed(const trial::Vibration& drive, double friction, double restitution, double gravity,
                        int periods) {
    HoppingPoint point(drive, friction, restitution, gravity);
    point.advanceTo(periods * drive.period());
    const double mark = point.x();
    point.advanceTo(2 * periods * drive.period());
    return (point.x() - mark) / (periods * drive.period());
}

}  // namespace trapwright::verify
