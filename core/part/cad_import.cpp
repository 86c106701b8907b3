#include "core/part/cad_import.h"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IFSelect_WorkLibrary.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Protocol.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_Reader.hxx>
#include <XSControl_WorkSession.hxx>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "core/base/math.h"

namespace trapwright::part {

namespace {

using base::Error;

constexpr double kChordTolerance = 1e-3;             // of the part's size
constexpr double kSmallest = 1e-3;                   // of what can be a part [mm]
constexpr double kLargest = 1e5;                     // [mm]
constexpr double kAngleStep = 10.0 * base::kDegree;  // between neighbouring facets of a curve

void appendFace(const TopoDS_Face& face, geometry::TriangleMesh& mesh) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(face, location);
    if (triangulation.IsNull()) return;
    const gp_Trsf transform = location.Transformation();
    const bool insideOut = (face.Orientation() == TopAbs_REVERSED) != transform.IsNegative();
    const int first = static_cast<int>(mesh.vertices.size()) - 1;  // OpenCASCADE counts from 1
    for (int i = 1; i <= triangulation->NbNodes(); ++i) {
        const gp_Pnt point = triangulation->Node(i).Transformed(transform);
        mesh.vertices.emplace_back(point.X(), point.Y(), point.Z());
    }
    for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
        int a = 0;
        int b = 0;
        int c = 0;
        triangulation->Triangle(i).Get(a, b, c);
        if (insideOut) std::swap(b, c);
        mesh.triangles.push_back({first + a, first + b, first + c});
    }
}

/// The shape in OpenCASCADE's millimetres as a mesh in `unit`.
base::Result<FileMesh> tessellate(const std::filesystem::path& path, const TopoDS_Shape& shape,
                                  const std::string& unitName) {
    FileMesh result;
    Bnd_Box box;
    if (!shape.IsNull()) BRepBndLib::Add(shape, box);
    if (box.IsVoid()) {
        return Error{fmt::format("{} has no solids or surfaces. Export the part as a solid", path.string())};
    }
    const double size = std::sqrt(box.SquareExtent());
    // A number that is damaged may make a mesh without end.
    if (!(size > kSmallest && size < kLargest)) {
        return Error{fmt::format("{}: its shape is {:g} mm large, which no part is. Check the file",
                                 path.string(), size)};
    }
    // One thread: the mesh must not depend on the machine.
    const BRepMesh_IncrementalMesh mesher(shape, kChordTolerance * size, false, kAngleStep, false);
    if (!mesher.IsDone()) {
        return Error{fmt::format(
            "{}: the surfaces could not be triangulated. Heal the model and export it again", path.string())};
    }
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
        appendFace(TopoDS::Face(face.Current()), result.mesh);
    }
    result.unit = findUnit(unitName);
    if (!result.unit) {
        result.unit = LengthUnit{"mm", base::kMillimetre};
        result.notes.push_back(
            fmt::format("the file's unit is \"{}\", which OpenCASCADE converted to mm", unitName));
    }
    const double scale = base::kMillimetre / result.unit->metres;
    if (scale != 1.0) {
        for (base::Vec3& vertex : result.mesh.vertices)
            vertex *= scale;
    }
    return result;
}

/// Keeps OpenCASCADE from writing its progress and warnings to the terminal.
void silence() {
    Message::DefaultMessenger()->ChangePrinters().Clear();
}

Error unreadable(const std::filesystem::path& path, const char* format, const std::string& reason) {
    return Error{
        fmt::format("{} could not be read as a {} file: {}. Check that it is complete and of that format.",
                    path.string(), format, reason)};
}

std::string describe(IFSelect_ReturnStatus status) {
    switch (status) {
        case IFSelect_RetVoid:
            return "it holds nothing";
        case IFSelect_RetError:
            return "its syntax is wrong";
        default:
            return "OpenCASCADE found no model in it";
    }
}

/// What OpenCASCADE's own check finds wrong in the file that was read; empty if nothing. A model with a fail
/// may not be made into a shape: what refers to something that is not there ends the program.
std::string findFail(XSControl_Reader& reader) {
    Interface_CheckIterator checks = reader.WS()->ModelCheckList(true);
    for (checks.Start(); checks.More(); checks.Next()) {
        const Handle(Interface_Check)& check = checks.Value();
        if (!check->HasFailed()) continue;
        // Number 0 are the fails of the model as a whole, whose texts name the entity themselves.
        const Handle(Standard_Transient)& entity = reader.WS()->StartingEntity(checks.Number());
        if (checks.Number() == 0 || entity.IsNull()) return check->CFail(1);
        const Handle(TCollection_HAsciiString) label = reader.WS()->Model()->StringLabel(entity);
        return fmt::format("{}: {}", label->ToCString(), check->CFail(1));
    }
    return {};
}

/// Whether what this entity of a STEP model consists of may not contain it again (ISO 10303-43).
bool isShape(const Handle(Standard_Transient) & entity) {
    return entity->IsKind(STANDARD_TYPE(StepRepr_RepresentationItem)) ||
           entity->IsKind(STANDARD_TYPE(StepRepr_Representation)) ||
           entity->IsKind(STANDARD_TYPE(StepRepr_RepresentationMap));
}

/// What is wrong if a shape of a STEP model is part of itself, by whatever way; empty if none is. OpenCASCADE
/// follows such references until its stack is full.
std::string findCircle(const Handle(Interface_InterfaceModel) & model,
                       const Handle(Interface_Protocol) & protocol) {
    const Interface_Graph graph(model, protocol, false);
    const auto shapesIn = [&](int entity) {
        std::vector<int> numbers;
        Interface_EntityIterator references = graph.Shareds(model->Value(entity));
        for (references.Start(); references.More(); references.Next()) {
            if (isShape(references.Value())) numbers.push_back(model->Number(references.Value()));
        }
        return numbers;
    };
    enum class Visit : char { none, begun, done };
    std::vector<Visit> visits(static_cast<std::size_t>(model->NbEntities()) + 1, Visit::none);  // from 1
    struct Step {
        int entity;
        std::vector<int> left;  // of its references
    };
    std::vector<Step> path;
    const auto enter = [&](int entity) {
        visits[static_cast<std::size_t>(entity)] = Visit::begun;
        path.push_back({entity, shapesIn(entity)});
    };
    for (int root = 1; root <= model->NbEntities(); ++root) {
        if (visits[static_cast<std::size_t>(root)] != Visit::none || !isShape(model->Value(root))) continue;
        enter(root);
        while (!path.empty()) {
            Step& step = path.back();
            if (step.left.empty()) {
                visits[static_cast<std::size_t>(step.entity)] = Visit::done;
                path.pop_back();
                continue;
            }
            const int next = step.left.back();
            step.left.pop_back();
            if (next < 1 || visits[static_cast<std::size_t>(next)] == Visit::done) continue;
            if (visits[static_cast<std::size_t>(next)] == Visit::begun)
                return fmt::format("{} is a part of itself",
                                   model->StringLabel(model->Value(next))->ToCString());
            enter(next);
        }
    }
    return {};
}

/// Runs a reader and turns what it throws into an error.
template <class Read>
base::Result<FileMesh> guarded(const std::filesystem::path& path, const char* format, Read read) {
    try {
        silence();
        return read();
    } catch (const Standard_Failure& failure) {
        const char* text = failure.GetMessageString();
        return unreadable(path, format, text != nullptr && *text != '\0' ? text : "OpenCASCADE failed");
    } catch (const std::exception& failure) {
        return unreadable(path, format, failure.what());
    }
}

}  // namespace

base::Result<FileMesh> readStepFile(const std::filesystem::path& path) {
    return guarded(path, "STEP", [&]() -> base::Result<FileMesh> {
        STEPControl_Reader reader;
        // As reader.ReadFile does it, but for the look at the model before it is checked.
        const Handle(XSControl_WorkSession) session = reader.WS();
        Handle(Interface_InterfaceModel) model;
        const int status = session->WorkLibrary()->ReadFile(path.c_str(), model, session->Protocol());
        if (status != 0)
            return unreadable(path, "STEP", describe(status < 0 ? IFSelect_RetError : IFSelect_RetFail));
        if (model.IsNull()) return unreadable(path, "STEP", describe(IFSelect_RetVoid));
        if (const std::string circle = findCircle(model, session->Protocol()); !circle.empty())
            return unreadable(path, "STEP", circle);
        session->SetModel(model);
        session->InitTransferReader(4);  // empty, for this model
        if (const std::string fail = findFail(reader); !fail.empty()) return unreadable(path, "STEP", fail);
        TColStd_SequenceOfAsciiString lengths;
        TColStd_SequenceOfAsciiString angles;
        TColStd_SequenceOfAsciiString solidAngles;
        reader.FileUnits(lengths, angles, solidAngles);
        reader.TransferRoots();
        return tessellate(path, reader.OneShape(), lengths.IsEmpty() ? "mm" : lengths.First().ToCString());
    });
}

base::Result<FileMesh> readIgesFile(const std::filesystem::path& path) {
    return guarded(path, "IGES", [&]() -> base::Result<FileMesh> {
        IGESControl_Reader reader;
        const IFSelect_ReturnStatus status = reader.ReadFile(path.c_str());
        if (status != IFSelect_RetDone) return unreadable(path, "IGES", describe(status));
        if (const std::string fail = findFail(reader); !fail.empty()) return unreadable(path, "IGES", fail);
        const Handle(TCollection_HAsciiString) unit = reader.IGESModel()->GlobalSection().UnitName();
        reader.TransferRoots();
        return tessellate(path, reader.OneShape(), unit.IsNull() ? "mm" : unit->ToCString());
    });
}

}  // namespace trapwright::part
