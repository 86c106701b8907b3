#pragma once

#include <QString>
#include <QWidget>
#include <memory>
#include <utility>
#include <vector>

#include "core/geometry/mesh_check.h"
#include "core/part/part.h"

class QGridLayout;

namespace trapwright::pages {

/// Names and values, one pair below the other; values can be selected and copied.
class FactList : public QWidget {
    Q_OBJECT
 public:
    explicit FactList(QWidget* parent);

    void show(const std::vector<std::pair<QString, QString>>& facts);

 private:
    QGridLayout* grid_;
};

using Facts = std::vector<std::pair<QString, QString>>;

/// What was found in the mesh as it came from the file.
Facts meshFacts(const geometry::MeshReport& report, std::size_t triangles);
/// Mass, volume, inertia and extent.
Facts massFacts(const part::Part& part);
/// "D2: 4 orientations look alike"
QString symmetryText(const part::SymmetryGroup& group);

}  // namespace trapwright::pages
