#include "core/geometry/shell_union.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/geometry/exact_solid.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_check.h"
#include "core/geometry/sliver_removal.h"
#include "core/geometry/triangle_mesh.h"

namespace trapwright::geometry {

namespace {

constexpr double kAll = 1.0 - 1e-6;  // of a shell's volume that is inside another one

double sizeOf(const Shell& shell) {
    return std::abs(shell.volume);
}

/// Turns the evidence around if the file is inside out as a whole.
void correctMirrored(const std::vector<Shell>& shells, const ShellNesting& nesting,
                     std::vector<char>& facedInward) {
    double inward = 0.0;
    double outward = 0.0;
    for (std::size_t i = 0; i < shells.size(); ++i)
        if (nesting.around[i].empty()) (facedInward[i] != 0 ? inward : outward) += sizeOf(shells[i]);
    if (inward <= outward) return;
    for (char& faced : facedInward)
        faced = faced != 0 ? 0 : 1;
}

/// The smallest shell in contact that has all of this one inside it, apart from one of its own size.
base::Result<std::optional<std::size_t>> findTouchedAround(const TriangleMesh& mesh,
                                                           const std::vector<Shell>& shells,
                                                           const ShellNesting& nesting,
                                                           const std::vector<char>& facedInward,
                                                           std::size_t inner) {
    std::optional<std::size_t> best;
    for (const ShellContact& contact : nesting.contacts) {
        if (contact.first != inner && contact.second != inner) continue;
        const std::size_t other = contact.first == inner ? contact.second : contact.first;
        if (facedInward[other] != 0 || sizeOf(shells[other]) * kAll <= sizeOf(shells[inner])) continue;
        if (best && sizeOf(shells[other]) >= sizeOf(shells[*best])) continue;
        const auto both =
            combineSolids(makeOutwardSolid(mesh, shells[inner]), makeOutwardSolid(mesh, shells[other]));
        if (!both) return describeOverlap(contact.place, both.error().message);
        if (both->common && both->common->calcVolume() >= kAll * sizeOf(shells[inner])) best = other;
    }
    return best;
}

constexpr double kNothing = 1e-9;      // of a volume: what rounding makes of sums
constexpr std::size_t kProbes = 8;     // triangles of each shell beside which the outcome is checked
constexpr double kProbeOffset = 0.01;  // from a triangle, of its size
constexpr double kSliver = 1e-6;  // of a volume: what it makes between faces that should lie on each other

bool isSame(double volume, double other, double share = kNothing) {
    return std::abs(volume - other) <= share * std::max(volume, other);
}

/// Negative if it is not known, never by rounding.
double calcCommon(const SolidCombination& both) {
    return both.common ? std::max(0.0, both.common->calcVolume()) : -1.0;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Triangle& t : other.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Bodies that belong together, and what they have been made to so far.
struct Assembly {
    std::set<std::size_t> bodies;
    ExactSolid solid;
    double volume = 0.0;   // [m^3]
    bool overlap = false;  // not only in faces
};

/// A meeting of two bodies.
struct Joint {
    std::size_t first = 0;
    std::size_t second = 0;
    base::Vec3 place = base::Vec3::Zero();
};

class Joiner {
 public:
    Joiner(const TriangleMesh& mesh, const std::vector<Shell>& shells, const ShellNesting& nesting,
           const std::vector<ShellRole>& roles)
        : mesh_(mesh), shells_(shells), nesting_(nesting), roles_(roles) {}

    base::Result<UnitedShells> run() {
        findJoints();
        if (const base::Status status = makeBodies(); !status) return status.error();
        if (const base::Status status = join(); !status) return status.error();
        UnitedShells united = collect();
        if (const auto place = findDifference(united.mesh))
            return describeOverlap(*place, "what CGAL makes of them is not what they enclose");
        return united;
    }

 private:
    void findJoints() {
        for (const ShellContact& contact : nesting_.contacts) {
            const std::size_t a = roles_[contact.first].body;
            const std::size_t b = roles_[contact.second].body;
            if (a != b) joints_.push_back({a, b, contact.place});
        }
        for (std::size_t i = 0; i < shells_.size(); ++i)
            if (const auto& around = roles_[i].embeddedIn)
                joints_.push_back({i, *around, mesh_.vertices[mesh_.triangles[shells_[i].triangles[0]][0]]});
    }

    [[nodiscard]] bool isJoined(std::size_t body) const {
        return std::any_of(joints_.begin(), joints_.end(),
                           [&](const Joint& joint) { return joint.first == body || joint.second == body; });
    }

    [[nodiscard]] bool touchesOwnBody(std::size_t cavity) const {
        return findContact(cavity,
                           [&](std::size_t other) { return roles_[other].body == roles_[cavity].body; })
            .has_value();
    }

    /// Of a shell with one for which the predicate holds: the place, and that shell.
    template <class Predicate>
    [[nodiscard]] std::optional<ShellContact> findContact(std::size_t shell, Predicate holds) const {
        for (const ShellContact& contact : nesting_.contacts) {
            if (contact.first != shell && contact.second != shell) continue;
            const std::size_t other = contact.first == shell ? contact.second : contact.first;
            if (holds(other)) return ShellContact{shell, other, contact.place};
        }
        return std::nullopt;
    }

    /// What other bodies leave of a cavity, nothing if no more than rounding.
    base::Result<std::optional<ExactSolid>> makeCavity(std::size_t cavity) {
        ExactSolid solid = makeOutwardSolid(mesh_, shells_[cavity]);
        std::set<std::size_t> done = {roles_[cavity].body};
        while (const auto contact = findContact(
                   cavity, [&](std::size_t other) { return !done.contains(roles_[other].body); })) {
            const std::size_t other = roles_[contact->second].body;
            done.insert(other);
            const auto filling = makeBody(other);
            if (!filling) return filling.error();
            const auto filled = combineSolids(solid, *filling);
            if (!filled) return describeOverlap(contact->place, filled.error().message);
            const double common = filled->common ? filled->common->calcVolume() : 0.0;
            if (solid.calcVolume() - common <= kSliver * std::abs(shells_[cavity].volume))
                return std::optional<ExactSolid>();
            if (filled->rest) solid = *filled->rest;
        }
        return std::optional(solid);
    }

    /// The body with this outer wall, less its cavities.
    base::Result<ExactSolid> makeBody(std::size_t outer) {
        if (const auto known = made_.find(outer); known != made_.end()) return known->second;
        TriangleMesh loose = extractShell(mesh_, shells_[outer]);
        made_.emplace(outer, ExactSolid(loose));  // for a cavity of another body that asks meanwhile
        std::vector<std::size_t> touched;
        for (std::size_t i = 0; i < shells_.size(); ++i) {
            if (!roles_[i].isCavity || roles_[i].body != outer) continue;
            if (nesting_.hasContact(i))
                touched.push_back(i);
            else
                append(loose, extractShell(mesh_, shells_[i]));
        }
        ExactSolid solid(loose);
        TriangleMesh apart;  // cavities that touch in an edge only
        for (const std::size_t i : touched) {
            const auto cavity = makeCavity(i);
            if (!cavity) return cavity.error();
            if (!*cavity) continue;
            const base::Vec3 place = findContact(i, [](std::size_t) { return true; })->place;
            auto cut = combineSolids(solid, **cavity);
            if (!cut) return describeOverlap(place, cut.error().message);
            double exact = kNothing;
            if (!cut->rest)
                if (auto touching =
                        combineTouching(solid, **cavity, Touching::fromInside, calcWeldTolerance(mesh_))) {
                    cut = std::move(*touching);
                    exact = kSliver;
                }
            const double volume = solid.calcVolume();
            const double common = calcCommon(*cut);
            if (cut->rest) {
                if (common >= 0.0 && !isSame(cut->rest->calcVolume() + common, volume, exact))
                    return describeOverlap(place, "the volumes do not add up");
                solid = *cut->rest;
                if (touchesOwnBody(i)) ++cavitiesCut_;
            } else if (isSame(common, std::abs(shells_[i].volume))) {
                append(apart, extractShell(mesh_, shells_[i]));
            } else {
                return describeOverlap(place, "what is left would touch itself in an edge");
            }
        }
        if (!apart.triangles.empty()) {
            TriangleMesh all = solid.toMesh();
            append(all, apart);
            solid = ExactSolid(all);
        }
        made_.insert_or_assign(outer, solid);
        return solid;
    }

    base::Status makeBodies() {
        for (std::size_t i = 0; i < shells_.size(); ++i) {
            if (roles_[i].isCavity) continue;
            if (isJoined(i) || hasTouchedCavity(i)) {
                const auto solid = makeBody(i);
                if (!solid) return solid.error();
                assemblies_.push_back({{i}, *solid, solid->calcVolume(), false});
                continue;
            }
            for (std::size_t k = 0; k < shells_.size(); ++k)
                if (roles_[k].body == i) append(result_.mesh, extractShell(mesh_, shells_[k]));
        }
        return base::success();
    }

    [[nodiscard]] bool hasTouchedCavity(std::size_t body) const {
        for (std::size_t i = 0; i < shells_.size(); ++i)
            if (roles_[i].isCavity && roles_[i].body == body && nesting_.hasContact(i)) return true;
        return false;
    }

    [[nodiscard]] const Joint* findJoint(const Assembly& a, const Assembly& b) const {
        for (const Joint& joint : joints_)
            if ((a.bodies.contains(joint.first) && b.bodies.contains(joint.second)) ||
                (a.bodies.contains(joint.second) && b.bodies.contains(joint.first)))
                return &joint;
        return nullptr;
    }

    /// Unites what can be, until only pairs are left that stay apart.
    base::Status join() {
        std::map<std::pair<std::set<std::size_t>, std::set<std::size_t>>, bool> staysApart;
        for (std::size_t i = 0; i < assemblies_.size();) {
            bool grew = false;
            for (std::size_t j = i + 1; j < assemblies_.size() && !grew; ++j) {
                Assembly& a = assemblies_[i];
                Assembly& b = assemblies_[j];
                const Joint* joint = findJoint(a, b);
                if (joint == nullptr || staysApart.contains({a.bodies, b.bodies})) continue;
                auto both = combineSolids(a.solid, b.solid);
                if (!both) return describeOverlap(joint->place, both.error().message);
                double exact = kNothing;
                if (!both->whole)
                    if (auto touching = combineTouching(a.solid, b.solid, Touching::fromOutside,
                                                        calcWeldTolerance(mesh_))) {
                        both = std::move(*touching);
                        exact = kSliver;
                    }
                const double sum = a.volume + b.volume;
                const double common = calcCommon(*both);
                const bool overlap = common > kNothing * std::min(a.volume, b.volume);
                if (!both->whole) {
                    staysApart[{a.bodies, b.bodies}] = !overlap && common >= 0.0;
                    continue;
                }
                const double whole = both->whole->calcVolume();
                if (common >= 0.0 && !isSame(whole + common, sum, exact))
                    return describeOverlap(joint->place, "the volumes do not add up");
                a.solid = *both->whole;
                a.volume = whole;
                a.overlap = a.overlap || b.overlap || overlap;
                a.bodies.insert(b.bodies.begin(), b.bodies.end());
                assemblies_.erase(assemblies_.begin() + static_cast<std::ptrdiff_t>(j));
                grew = true;
            }
            i = grew ? 0 : i + 1;
        }
        for (std::size_t i = 0; i < assemblies_.size(); ++i)
            for (std::size_t j = i + 1; j < assemblies_.size(); ++j) {
                const auto pair = staysApart.find({assemblies_[i].bodies, assemblies_[j].bodies});
                if (pair == staysApart.end()) continue;
                if (!pair->second)
                    return describeOverlap(findJoint(assemblies_[i], assemblies_[j])->place,
                                           "together they would touch themselves in an edge");
                touchInEdges_ = true;
            }
        return base::success();
    }

    UnitedShells collect() {
        for (const Assembly& assembly : assemblies_) {
            append(result_.mesh, removeSlivers(assembly.solid.toMesh(), calcWeldTolerance(mesh_)));
            if (assembly.bodies.size() > 1)
                result_.notes.push_back("united " + std::to_string(assembly.bodies.size()) + " shells that " +
                                        (assembly.overlap ? "overlap" : "touch"));
        }
        if (cavitiesCut_ > 0)
            result_.notes.push_back("cut out " + std::to_string(cavitiesCut_) +
                                    (cavitiesCut_ == 1 ? " cavity that touches" : " cavities that touch") +
                                    " a wall or another one");
        if (touchInEdges_)
            result_.notes.emplace_back("kept shells apart that touch in an edge or a corner only");
        return std::move(result_);
    }

    /// Whether some shell's body has solid there, by the shells alone.
    [[nodiscard]] bool isSolid(const std::vector<TriangleMesh>& meshes, const base::Vec3& point) const {
        std::set<std::size_t> solid;
        std::set<std::size_t> hollow;
        for (std::size_t i = 0; i < meshes.size(); ++i)
            if (std::abs(calcWindingNumber(meshes[i], point)) > 0.5)
                (roles_[i].isCavity ? hollow : solid).insert(roles_[i].body);
        return !std::includes(hollow.begin(), hollow.end(), solid.begin(), solid.end());
    }

    /// A point on one side of some triangle that is solid and should not be, or the other way round.
    [[nodiscard]] std::optional<base::Vec3> findDifference(const TriangleMesh& united) const {
        std::vector<TriangleMesh> meshes;
        for (const Shell& shell : shells_)
            meshes.push_back(extractShell(mesh_, shell));
        const double tolerance = calcWeldTolerance(mesh_);
        for (const TriangleMesh& mesh : meshes)
            for (std::size_t k = 0; k < std::min(kProbes, mesh.triangles.size()); ++k) {
                const std::size_t i = k * mesh.triangles.size() / std::min(kProbes, mesh.triangles.size());
                const Triangle& t = mesh.triangles[i];
                const base::Vec3& a = mesh.vertices[t[0]];
                const base::Vec3 normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
                const double offset = kProbeOffset * std::sqrt(normal.norm());
                if (offset < 10.0 * tolerance) continue;
                // No middle: that is likely to be on another face.
                const base::Vec3 within =
                    0.4113 * a + 0.3559 * mesh.vertices[t[1]] + 0.2328 * mesh.vertices[t[2]];
                for (const double side : {offset, -offset}) {
                    const base::Vec3 point = within + side * normal.normalized();
                    const double expected = isSolid(meshes, point) ? 1.0 : 0.0;
                    if (std::abs(calcWindingNumber(united, point) - expected) > 0.5) return point;
                }
            }
        return std::nullopt;
    }

    const TriangleMesh& mesh_;
    const std::vector<Shell>& shells_;
    const ShellNesting& nesting_;
    const std::vector<ShellRole>& roles_;
    std::vector<Joint> joints_;
    std::map<std::size_t, ExactSolid> made_;  // by outer wall
    std::vector<Assembly> assemblies_;
    UnitedShells result_;
    int cavitiesCut_ = 0;
    bool touchInEdges_ = false;
};

}  // namespace

base::Result<std::vector<ShellRole>> findShellRoles(const TriangleMesh& mesh,
                                                    const std::vector<Shell>& shells,
                                                    const ShellNesting& nesting,
                                                    std::vector<char> facedInward) {
    correctMirrored(shells, nesting, facedInward);
    const auto isSmaller = [&](std::size_t a, std::size_t b) {
        return sizeOf(shells[a]) < sizeOf(shells[b]);
    };

    // The innermost shell around each.
    std::vector<std::optional<std::size_t>> parents(shells.size());
    bool tellsCavities = false;
    for (std::size_t i = 0; i < shells.size(); ++i) {
        const std::vector<std::size_t>& around = nesting.around[i];
        if (!around.empty()) parents[i] = *std::min_element(around.begin(), around.end(), isSmaller);
        if (facedInward[i] == 0) continue;
        auto touched = findTouchedAround(mesh, shells, nesting, facedInward, i);
        if (!touched) return touched.error();
        if (*touched && (!parents[i] || isSmaller(**touched, *parents[i]))) parents[i] = *touched;
        tellsCavities = tellsCavities || parents[i];
    }

    // From outside to inside, so that what is around a shell is known before it.
    std::vector<std::size_t> order(shells.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return isSmaller(b, a); });
    std::vector<ShellRole> roles(shells.size());
    for (const std::size_t i : order) {
        ShellRole& role = roles[i];
        role.body = i;
        if (!parents[i] || roles[*parents[i]].isCavity) continue;
        const std::size_t around = roles[*parents[i]].body;
        const bool isAlone = !nesting.hasContact(i);
        if (facedInward[i] != 0 || (isAlone && !tellsCavities)) {
            role.isCavity = true;
            role.body = around;
            role.isDoubtful = facedInward[i] == 0;
        } else {
            role.embeddedIn = around;
        }
    }
    return roles;
}

ExactSolid makeOutwardSolid(const TriangleMesh& mesh, const Shell& shell) {
    TriangleMesh own = extractShell(mesh, shell);
    if (calcMassProperties(own, 1.0).volume < 0.0)
        for (Triangle& t : own.triangles)
            std::swap(t[1], t[2]);
    return ExactSolid(own);
}

base::Error describeOverlap(const base::Vec3& place, const std::string& why) {
    return base::Error{"shells overlap, at " + formatPlace(place) + ", and cannot be united: " + why +
                       ". Unite the bodies in CAD and export the part as one solid"};
}

base::Result<UnitedShells> uniteShells(const TriangleMesh& mesh, const std::vector<Shell>& shells,
                                       const ShellNesting& nesting, const std::vector<ShellRole>& roles) {
    return Joiner(mesh, shells, nesting, roles).run();
}

}  // namespace trapwright::geometry
