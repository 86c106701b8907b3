#include "core/part/cad_export.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TCollection_HAsciiString.hxx>
#include <gp_Vec.hxx>

#include <fmt/format.h>

namespace trapwright::part {

base::Status writeStepPrism(const std::filesystem::path& path, std::span<const base::Vec2> polygon,
                            double depth) {
    const auto failed = [&](const std::string& reason) {
        return base::Error{fmt::format("{} could not be written: {}", path.string(), reason)};
    };
    try {
        Message::DefaultMessenger()->ChangePrinters().Clear();
        BRepBuilderAPI_MakePolygon outline;
        for (const base::Vec2& corner : polygon) {
            outline.Add(gp_Pnt(corner.x() / base::kMillimetre, corner.y() / base::kMillimetre, 0.0));
        }
        outline.Close();
        const BRepBuilderAPI_MakeFace face(outline.Wire());
        BRepPrimAPI_MakePrism prism(face.Face(), gp_Vec(0.0, 0.0, depth / base::kMillimetre));

        STEPControl_Writer writer;
        if (writer.Transfer(prism.Shape(), STEPControl_AsIs) != IFSelect_RetDone)
            return failed("the shape is not valid");
        APIHeaderSection_MakeHeader header(writer.Model());
        header.SetTimeStamp(new TCollection_HAsciiString("2000-01-01T00:00:00"));
        header.SetName(new TCollection_HAsciiString(path.filename().c_str()));
        if (writer.Write(path.c_str()) != IFSelect_RetDone)
            return failed("check that the folder exists and is writable");
    } catch (const Standard_Failure& failure) {
        return failed(failure.GetMessageString());
    }
    return base::success();
}

}  // namespace trapwright::part
