#include "ui/pages/part_facts.h"

#include <Eigen/Eigenvalues>
#include <QLocale>

#include "ui/look/text.h"

namespace trapwright::pages {

using look::numberText;

Facts meshFacts(const geometry::MeshReport& report, std::size_t triangles) {
    Facts facts = {{FactList::tr("Triangles"), QLocale().toString(static_cast<qulonglong>(triangles))},
                   {FactList::tr("Bodies"), QString::number(report.shells)},
                   {FactList::tr("Surface"),
                    report.isSolid() ? FactList::tr("closed, faces outward") : FactList::tr("repaired")}};
    // Not the double vertices: every STL file has them.
    const std::pair<int, QString> defects[] = {
        {report.openEdges, FactList::tr("Open edges")},
        {static_cast<int>(report.holes.size()), FactList::tr("Holes")},
        {report.degenerateTriangles, FactList::tr("Triangles without area")},
        {report.duplicateTriangles, FactList::tr("Double triangles")},
        {report.inconsistentEdges, FactList::tr("Edges of turned triangles")},
        {report.nonManifoldEdges, FactList::tr("Edges of over two triangles")},
        {report.insideOutShells, FactList::tr("Bodies inside out")},
    };
    for (const auto& [count, name] : defects)
        if (count > 0) facts.emplace_back(name, QString::number(count));
    return facts;
}

Facts massFacts(const part::Part& part) {
    constexpr double kGrams = 1e3;
    constexpr double kCubicMillimetres = 1e9;
    constexpr double kSquareMillimetres = 1e6;
    constexpr double kGramSquareMillimetres = 1e9;
    const geometry::MassProperties& mass = part.massProperties;
    const base::Vec3 moments =
        Eigen::SelfAdjointEigenSolver<base::Mat3>(mass.inertia).eigenvalues() * kGramSquareMillimetres;
    return {
        {FactList::tr("Mass"), FactList::tr("%1 g").arg(numberText(mass.mass * kGrams))},
        {FactList::tr("Volume"), FactList::tr("%1 mm³").arg(numberText(mass.volume * kCubicMillimetres, 4))},
        {FactList::tr("Surface"), FactList::tr("%1 mm²").arg(numberText(mass.area * kSquareMillimetres, 4))},
        {FactList::tr("Moments of inertia"),
         FactList::tr("%1, %2, %3 g mm²")
             .arg(numberText(moments.x()), numberText(moments.y()), numberText(moments.z()))},
        {FactList::tr("Farthest from centre"),
         FactList::tr("%1 mm").arg(numberText(part.boundingRadius * 1e3))}};
}

QString symmetryText(const part::SymmetryGroup& group) {
    const QString name = QString::fromStdString(group.name);
    if (group.sphere) return FactList::tr("%1: a ball, all orientations look alike").arg(name);
    if (group.continuous) {
        return group.flip ? FactList::tr("%1: round, and its two ends look alike").arg(name)
                          : FactList::tr("%1: round about one axis").arg(name);
    }
    const int count = static_cast<int>(group.rotations.size());
    if (count == 1) return FactList::tr("%1: every orientation looks different").arg(name);
    return FactList::tr("%1: %2 orientations look alike").arg(name).arg(count);
}

}  // namespace trapwright::pages
