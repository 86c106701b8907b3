#pragma once

#include <QPixmap>
#include <map>

#include "core/part/part.h"
#include "ui/models/record_model.h"

namespace trapwright::models {

struct PoseRow {
    int pose = 0;  // from 0
    part::StablePose stable;
};

/// The stable poses of a part, most probable first; a card each, with a picture once there is one.
class PoseModel : public RecordModel<PoseRow> {
    Q_OBJECT
 public:
    enum Columns { Pose, Probability, Faces, Height };

    explicit PoseModel(QObject* parent = nullptr);

    void setPart(const part::Part& part);
    void clear();
    /// Shown as decoration of the pose's first column.
    void setPicture(int pose, const QPixmap& picture);

 protected:
    [[nodiscard]] QVariant more(const PoseRow& row, int column, int role) const override;

 private:
    static std::vector<Column<PoseRow>> makeColumns();

    std::map<int, QPixmap> pictures_;
};

}  // namespace trapwright::models
