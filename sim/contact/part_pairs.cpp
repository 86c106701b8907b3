#include "sim/contact/part_pairs.h"

#include <algorithm>

namespace trapwright::contact {

using base::Vec3;

namespace {

/// Parts whose balls are nearer than this are a pair. [m]
constexpr double kNear = 2e-3;

}  // namespace

void PartPairs::add(int slot, const ContactBody& body) {
    const auto place = static_cast<std::size_t>(slot);
    if (place >= bodies_.size()) bodies_.resize(place + 1, nullptr);
    bodies_[place] = &body;
}

void PartPairs::remove(int slot) {
    bodies_[static_cast<std::size_t>(slot)] = nullptr;
    std::erase_if(pairs_, [slot](const Pair& pair) { return pair.a == slot || pair.b == slot; });
}

const std::vector<PartPairs::Pair>& PartPairs::findNear(std::span<const Vec3> positions) {
    // Those that were near are looked at first, so that they keep what they know.
    std::size_t kept = 0;
    for (std::size_t a = 0; a < bodies_.size(); ++a) {
        if (bodies_[a] == nullptr) continue;
        for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
            if (bodies_[b] == nullptr) continue;
            const double near = bodies_[a]->radius + bodies_[b]->radius + kNear;
            if (!((positions[b] - positions[a]).squaredNorm() < near * near)) continue;
            const auto first = pairs_.begin() + static_cast<std::ptrdiff_t>(kept);
            const auto known = std::find_if(first, pairs_.end(), [&](const Pair& pair) {
                return pair.a == static_cast<int>(a) && pair.b == static_cast<int>(b);
            });
            if (known != pairs_.end())
                std::rotate(first, known, known + 1);
            else
                pairs_.insert(first, {static_cast<int>(a), static_cast<int>(b),
                                      std::make_unique<PairDetector>(*bodies_[a], *bodies_[b])});
            ++kept;
        }
    }
    pairs_.resize(kept);
    return pairs_;
}

void PartPairs::findContacts(std::span<const NearPart> parts, double dt, std::vector<PartContact>& contacts) {
    for (const Pair& pair : pairs_) {
        const NearPart& a = parts[static_cast<std::size_t>(pair.a)];
        const NearPart& b = parts[static_cast<std::size_t>(pair.b)];
        const double moved = (b.lastVelocity - a.lastVelocity).norm() * dt + a.lastTurn + b.lastTurn;
        const double reach = (b.velocity - a.velocity).norm() * dt + a.turn + b.turn;
        found_.clear();
        pair.detector->findContacts(a.pose, b.pose, moved, 1.1 * reach + kTravelMargin, found_);
        for (Contact& contact : found_) {
            contact.point = a.pose.apply(contact.point);
            contact.normal = a.pose.rotation * contact.normal;
            contact.bodyA = pair.a;
            contact.bodyB = pair.b;
            contacts.push_back({contact, reach});
        }
    }
}

MovingContact describe(const Contact& contact, const base::Pose& a, const base::Pose& b) {
    return {contact.point - b.position,
            contact.normal,
            contact.gap,
            Vec3::Zero(),
            Vec3::Zero(),
            contact.feature,
            contact.bodyA,
            contact.bodyB,
            contact.point - a.position};
}

}  // namespace trapwright::contact
