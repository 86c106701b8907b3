#include "core/part/cad_export.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pln.hxx>
#include <gp_Vec.hxx>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/file.h"
#include "core/geometry/polygon_faces.h"

namespace trapwright::part {

namespace {

// Corners that a cut has rounded still lie in their faces' planes; the volume does not feel it. [m]
constexpr double kOnePlane = 1e-9;
constexpr double kTolerance = 2e-6;  // of corners and edges, in OpenCASCADE's millimetres

base::Error makeError(const std::filesystem::path& path, const std::string& reason) {
    return base::Error{fmt::format("{} could not be written: {}", path.string(), reason)};
}

gp_Pnt toPoint(const base::Vec3& v) {
    return {v.x() / base::kMillimetre, v.y() / base::kMillimetre, v.z() / base::kMillimetre};
}

/// A file that is only in memory.
class MemoryFile {
 public:
    MemoryFile() : descriptor_(::memfd_create("step", MFD_CLOEXEC)) {}
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    /// Of this process, while this lives.
    [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
    int descriptor_;
};

base::Status writeShape(const std::filesystem::path& path, const TopoDS_Shape& shape) {
    STEPControl_Writer writer;
    Interface_Static::SetIVal("write.surfacecurve.mode", 0);  // planes need no plane curves in the file
    if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
        return makeError(path, "the shape is not valid");
    APIHeaderSection_MakeHeader header(writer.Model());
    header.SetTimeStamp(new TCollection_HAsciiString("2000-01-01T00:00:00"));
    header.SetName(new TCollection_HAsciiString(path.filename().c_str()));
    // Into memory, so that our own writer is the only one that meets full disks.
    const MemoryFile memory;
    if (writer.Write(memory.path().c_str()) != IFSelect_RetDone)
        return makeError(path, "there is not enough memory for it");
    const auto content = base::readFile(memory.path());
    if (!content) return makeError(path, content.error().message);
    return base::writeFile(path, *content);
}

/// Corners and edges that faces have in common.
class SharedEdges {
 public:
    explicit SharedEdges(const geometry::TriangleMesh& mesh) : mesh_(mesh) {}

    /// The loop as a wire of common edges.
    TopoDS_Wire makeWire(const std::vector<int>& loop) {
        TopoDS_Wire wire;
        builder_.MakeWire(wire);
        for (std::size_t i = 0; i < loop.size(); ++i)
            builder_.Add(wire, edgeBetween(loop[i], loop[(i + 1) % loop.size()]));
        wire.Closed(true);
        return wire;
    }

 private:
    const TopoDS_Vertex& vertexAt(int number) {
        TopoDS_Vertex& vertex = vertices_[number];
        if (vertex.IsNull())
            builder_.MakeVertex(vertex, toPoint(mesh_.vertices[static_cast<std::size_t>(number)]),
                                kTolerance);
        return vertex;
    }

    TopoDS_Edge edgeBetween(int from, int to) {
        TopoDS_Edge& edge = edges_[std::minmax(from, to)];
        if (edge.IsNull()) {
            edge = BRepBuilderAPI_MakeEdge(vertexAt(std::min(from, to)), vertexAt(std::max(from, to))).Edge();
            builder_.UpdateEdge(edge, kTolerance);
        }
        return TopoDS::Edge(edge.Oriented(from < to ? TopAbs_FORWARD : TopAbs_REVERSED));
    }

    const geometry::TriangleMesh& mesh_;
    BRep_Builder builder_;
    std::map<int, TopoDS_Vertex> vertices_;
    std::map<std::pair<int, int>, TopoDS_Edge> edges_;
};

/// The solid between plane faces; none if OpenCASCADE finds fault with it.
std::optional<TopoDS_Solid> makeSolid(const geometry::TriangleMesh& mesh,
                                      const std::vector<geometry::FlatFace>& faces) {
    SharedEdges edges(mesh);
    BRep_Builder builder;
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (const geometry::FlatFace& face : faces) {
        const base::Vec3& corner = mesh.vertices[static_cast<std::size_t>(face.loops.front().front())];
        const gp_Pln plane(toPoint(corner), gp_Dir(face.normal.x(), face.normal.y(), face.normal.z()));
        BRepBuilderAPI_MakeFace maker(plane, edges.makeWire(face.loops.front()), true);
        for (std::size_t i = 1; i < face.loops.size(); ++i)
            maker.Add(edges.makeWire(face.loops[i]));
        if (!maker.IsDone()) return std::nullopt;
        // Of a face with many edges the writer asks for their plane curves again and again; they are quick to
        // make once.
        for (TopExp_Explorer edge(maker.Face(), TopAbs_EDGE); edge.More(); edge.Next())
            BRepLib::BuildPCurveForEdgeOnPlane(TopoDS::Edge(edge.Current()), maker.Face());
        builder.Add(shell, maker.Face());
    }
    shell.Closed(true);
    const TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(shell).Solid();
    if (!BRepCheck_Analyzer(solid).IsValid()) return std::nullopt;
    return solid;
}

}  // namespace

base::Status writeStepPrism(const std::filesystem::path& path, std::span<const base::Vec2> polygon,
                            double depth) {
    try {
        Message::DefaultMessenger()->ChangePrinters().Clear();
        BRepBuilderAPI_MakePolygon outline;
        for (const base::Vec2& corner : polygon) {
            outline.Add(gp_Pnt(corner.x() / base::kMillimetre, corner.y() / base::kMillimetre, 0.0));
        }
        outline.Close();
        const BRepBuilderAPI_MakeFace face(outline.Wire());
        BRepPrimAPI_MakePrism prism(face.Face(), gp_Vec(0.0, 0.0, depth / base::kMillimetre));
        return writeShape(path, prism.Shape());
    } catch (const Standard_Failure& failure) {
        return makeError(path, failure.GetMessageString());
    }
}

base::Status writeStepSolid(const std::filesystem::path& path, const geometry::TriangleMesh& solid) {
    try {
        Message::DefaultMessenger()->ChangePrinters().Clear();
        // A face that touches itself is none for OpenCASCADE; then every triangle is one.
        for (const double tolerance : {kOnePlane, -1.0}) {
            const auto faces = geometry::mergeFlatFaces(solid, tolerance);
            if (!faces) return makeError(path, "the mesh is not one closed, oriented, manifold surface");
            if (const auto shape = makeSolid(solid, *faces)) return writeShape(path, *shape);
        }
        return makeError(path, "the surface crosses itself, so it bounds no solid. Export an STL instead");
    } catch (const Standard_Failure& failure) {
        return makeError(path, failure.GetMessageString());
    }
}

base::Result<StepContents> inspectStep(const std::filesystem::path& path) {
    const auto failed = [&](const std::string& reason) {
        return base::Error{fmt::format("{} cannot be read as a STEP file: {}", path.string(), reason)};
    };
    try {
        Message::DefaultMessenger()->ChangePrinters().Clear();
        STEPControl_Reader reader;
        if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return failed("it is missing or damaged");
        reader.TransferRoots();
        const TopoDS_Shape shape = reader.OneShape();
        if (shape.IsNull()) return failed("it holds no shape");
        StepContents contents;
        contents.valid = BRepCheck_Analyzer(shape).IsValid();
        for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
            ++contents.solids;
        for (TopExp_Explorer shell(shape, TopAbs_SHELL); shell.More(); shell.Next())
            contents.valid = contents.valid && BRep_Tool::IsClosed(shell.Current());
        for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
            ++contents.faces;
        geometry::Box box;
        for (TopExp_Explorer vertex(shape, TopAbs_VERTEX); vertex.More(); vertex.Next()) {
            const gp_Pnt point = BRep_Tool::Pnt(TopoDS::Vertex(vertex.Current()));
            box.include(base::Vec3(point.X(), point.Y(), point.Z()) * base::kMillimetre);
        }
        contents.size = box.size();
        GProp_GProps properties;
        BRepGProp::VolumeProperties(shape, properties);
        contents.volume = properties.Mass() * base::kMillimetre * base::kMillimetre * base::kMillimetre;
        return contents;
    } catch (const Standard_Failure& failure) {
        return failed(failure.GetMessageString());
    }
}

}  // namespace trapwright::part
