#include "core/geometry/shell_nesting.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_edges.h"

namespace trapwright::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

// Along no axis, diagonal or edge that a designer would choose.
const std::array<base::Vec3, 3> kDirections = {base::Vec3(0.5377, 0.1834, -0.8229),
                                               base::Vec3(-0.3188, 0.8622, 0.3937),
                                               base::Vec3(0.4336, -0.3426, 0.8334)};
Kernel::Point_3 toPoint(const base::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

Box calcBox(const Kernel::Triangle_3& triangle, double margin) {
    Box box;
    for (int k = 0; k < 3; ++k)
        box.include({triangle[k].x(), triangle[k].y(), triangle[k].z()});
    box.low.array() -= margin;
    box.high.array() += margin;
    return box;
}

bool doOverlap(const Box& a, const Box& b) {
    return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

base::Vec3 calcMiddleOfOverlap(const Box& a, const Box& b) {
    return 0.5 * (a.low.cwiseMax(b.low) + a.high.cwiseMin(b.high));
}

/// A shell to be asked for what is near and what is inside. The tree is built when it is first needed.
class SearchableShell {
 public:
    SearchableShell(const TriangleMesh& mesh, const Shell& shell, double margin) {
        for (const std::size_t i : shell.triangles) {
            const Triangle& t = mesh.triangles[i];
            triangles_.emplace_back(toPoint(mesh.vertices[t[0]]), toPoint(mesh.vertices[t[1]]),
                                    toPoint(mesh.vertices[t[2]]));
            const Box one = calcBox(triangles_.back(), margin);
            box_.include(one.low);
            box_.include(one.high);
        }
    }

    [[nodiscard]] const Box& box() const { return box_; }
    [[nodiscard]] const Triangles& triangles() const { return triangles_; }

    /// Whether a point off the surface is inside: rays from it leave through an odd number of triangles.
    [[nodiscard]] bool contains(const Kernel::Point_3& point) const {
        int odd = 0;
        for (const base::Vec3& direction : kDirections)
            odd += tree().number_of_intersected_primitives(
                       Kernel::Ray_3(point, Kernel::Vector_3(direction.x(), direction.y(), direction.z()))) %
                       2 !=
                   0;
        return odd >= 2;
    }

    /// Where a triangle of the other shell comes nearer than `tolerance` to this one, if any does.
    [[nodiscard]] std::optional<base::Vec3> findContact(const SearchableShell& other,
                                                        double tolerance) const {
        std::vector<Tree::Primitive_id> near;
        for (const Kernel::Triangle_3& triangle : other.triangles_) {
            const Box box = calcBox(triangle, tolerance);
            if (!doOverlap(box, box_)) continue;
            near.clear();
            tree().all_intersected_primitives(
                CGAL::Bbox_3(box.low.x(), box.low.y(), box.low.z(), box.high.x(), box.high.y(), box.high.z()),
                std::back_inserter(near));
            for (const Tree::Primitive_id& own : near)
                if (CGAL::do_intersect(triangle, *own) ||
                    CGAL::squared_distance(triangle, *own) <= tolerance * tolerance)
                    return calcMiddleOfOverlap(box, calcBox(*own, tolerance));
        }
        return std::nullopt;
    }

 private:
    [[nodiscard]] const Tree& tree() const {
        if (!tree_) {
            tree_ = std::make_unique<Tree>(triangles_.cbegin(), triangles_.cend());
            tree_->build();
        }
        return *tree_;
    }

    Triangles triangles_;
    Box box_;
    mutable std::unique_ptr<Tree> tree_;
};

}  // namespace

std::vector<Shell> findShells(const TriangleMesh& mesh) {
    Groups groups(mesh.triangles.size());
    forEachEdge(collectSides(mesh), [&](auto first, auto last) {
        for (auto side = first + 1; side != last; ++side)
            groups.join(side->triangle, first->triangle);
    });

    std::vector<Shell> shells;
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::vector<std::size_t> shellOfRoot(mesh.triangles.size(), kNone);
    for (std::size_t i = 0; i < shellOfRoot.size(); ++i) {
        std::size_t& shell = shellOfRoot[groups.findRoot(i)];
        if (shell == kNone) {
            shell = shells.size();
            shells.emplace_back();
        }
        shells[shell].triangles.push_back(i);
    }
    for (Shell& shell : shells)
        shell.volume = calcMassProperties(shells.size() == 1 ? mesh : extractShell(mesh, shell), 1.0).volume;
    return shells;
}

TriangleMesh extractShell(const TriangleMesh& mesh, const Shell& shell) {
    TriangleMesh result;
    std::map<int, int> number;
    for (const std::size_t i : shell.triangles) {
        Triangle t{};
        for (std::size_t k = 0; k < 3; ++k) {
            const int old = mesh.triangles[i][k];
            const auto [place, isNew] = number.emplace(old, static_cast<int>(result.vertices.size()));
            if (isNew) result.vertices.push_back(mesh.vertices[old]);
            t[k] = place->second;
        }
        result.triangles.push_back(t);
    }
    return result;
}

bool ShellNesting::hasContact(std::size_t shell) const {
    return std::any_of(contacts.begin(), contacts.end(), [&](const ShellContact& contact) {
        return contact.first == shell || contact.second == shell;
    });
}

ShellNesting findNesting(const TriangleMesh& mesh, const std::vector<Shell>& shells, double tolerance) {
    ShellNesting nesting;
    nesting.around.resize(shells.size());
    if (shells.size() < 2) return nesting;
    std::vector<SearchableShell> searchable;
    searchable.reserve(shells.size());
    for (const Shell& shell : shells)
        searchable.emplace_back(mesh, shell, tolerance);
    for (std::size_t i = 0; i < shells.size(); ++i)
        for (std::size_t j = i + 1; j < shells.size(); ++j) {
            if (!doOverlap(searchable[i].box(), searchable[j].box())) continue;
            const bool firstIsLarger = shells[i].triangles.size() >= shells[j].triangles.size();
            const SearchableShell& large = searchable[firstIsLarger ? i : j];
            const SearchableShell& small = searchable[firstIsLarger ? j : i];
            if (const auto place = large.findContact(small, tolerance))
                nesting.contacts.push_back({i, j, *place});
            else if (searchable[j].contains(searchable[i].triangles().front()[0]))
                nesting.around[i].push_back(j);
            else if (searchable[i].contains(searchable[j].triangles().front()[0]))
                nesting.around[j].push_back(i);
        }
    return nesting;
}

}  // namespace trapwright::geometry
