#include "core/part/import.h"

#include <sys/stat.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <array>
#include <cmath>
#include <cstring>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_files.h"
#include "core/geometry/three_mf.h"
#include "core/part/shapes.h"
#include "mesh_files.h"

using namespace trapwright;
using base::kMillimetre;
using base::Vec3;

namespace {

const std::filesystem::path kData = std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "tests/core/part/data";

/// A tetrahedron with legs of 10, 20 and 30 file units, in the formats that people can write.
const char* const kAsciiStl =
    "solid tetra\n"
    "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 20 0\nvertex 10 0 0\nendloop\nendfacet\n"
    "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 0 30\nendloop\nendfacet\n"
    "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 30\nvertex 0 20 0\nendloop\nendfacet\n"
    "facet normal 1 1 1\nouter loop\nvertex 10 0 0\nvertex 0 20 0\nvertex 0 0 30\nendloop\nendfacet\n"
    "endsolid tetra\n";

const char* const kObj = "v 0 0 0\nv 10 0 0\nv 0 20 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const char* const kOff = "OFF\n4 4 6\n0 0 0\n10 0 0\n0 20 0\n0 0 30\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

const char* const kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n10 0 0\n0 20 0\n0 0 30\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// The same in metres with two nodes: as it is, and mirrored in x by its node's scale.
QByteArray gltf() {
    const std::array<float, 12> points = {0, 0, 0, 0.010F, 0, 0, 0, 0.020F, 0, 0, 0, 0.030F};
    const std::array<std::uint16_t, 12> indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    QByteArray buffer(reinterpret_cast<const char*>(points.data()), sizeof points);
    buffer.append(reinterpret_cast<const char*>(indices.data()), sizeof indices);
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
      "nodes":[{"mesh":0},{"mesh":0,"scale":[-1,1,1]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
      "accessors":[
        {"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[0.01,0.02,0.03]},
        {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
      "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
      "buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,)" +
           buffer.toBase64() + R"("}]})";
}

QByteArray scaled(const char* text, const char* from, const char* to) {
    return QByteArray(text).replace(from, to);
}

}  // namespace

class ImportTest : public QObject {
    Q_OBJECT

    QTemporaryDir folder_;

    std::filesystem::path write(const QString& name, const QByteArray& content) {
        QFile file(folder_.filePath(name));
        if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size())
            qFatal("no temporary file");
        return file.fileName().toStdString();
    }

    QByteArray binaryStl() {
        const std::filesystem::path path = folder_.filePath("binary.stl").toStdString();
        if (!geometry::writeStl(path, part::makeBox(Vec3(4, 8, 12) * kMillimetre)))
            qFatal("no temporary file");
        QFile file(QString::fromStdString(path.string()));
        if (!file.open(QIODevice::ReadOnly)) qFatal("no temporary file");
        return file.readAll();
    }

 private slots:
    void readsMeshFormats_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("content");
        QTest::newRow("ASCII STL") << "a.stl" << QByteArray(kAsciiStl);
        QTest::newRow("upper case") << "A.STL" << QByteArray(kAsciiStl);
        QTest::newRow("OBJ") << "a.obj" << QByteArray(kObj);
        QTest::newRow("OFF") << "a.off" << QByteArray(kOff);
        QTest::newRow("PLY") << "a.ply" << QByteArray(kPly);
    }

    void readsMeshFormats() {
        QFETCH(QString, name);
        QFETCH(QByteArray, content);
        const auto imported = part::importMesh(write(name, content));
        QVERIFY2(imported.ok(), imported ? "" : imported.error().message.c_str());
        QCOMPARE(imported->mesh.triangles.size(), std::size_t{4});
        const geometry::MassProperties properties = geometry::calcMassProperties(imported->mesh, 1.0);
        QVERIFY(std::abs(properties.volume - 1e-6) < 1e-11);  // 10 * 20 * 30 / 6 mm^3, and the right way out
        QVERIFY((properties.centre - Vec3(2.5, 5.0, 7.5) * kMillimetre).norm() < 1e-8);
        QCOMPARE(imported->units, std::string("mm"));
        QVERIFY(!imported->unitsFromFile);
        QCOMPARE(imported->notes.size(), std::size_t{1});
        QVERIFY(imported->notes[0].find("assumed millimetres") != std::string::npos);
    }

    void readsWhatExportersWrite_data() {
        using namespace mesh_files;
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("content");
        const QByteArray points = vertices("v ", "");
        const QByteArray faces = sides("f", 1, "", "");
        QTest::newRow("OBJ, from the end") << "a.obj" << points + sides("f", -8, "", "");
        QTest::newRow("OBJ, texture and normal")
            << "a.obj" << points + "vt 0 0\nvn 0 0 1\n" + sides("f", 1, "/1/1", "");
        QTest::newRow("OBJ, normal") << "a.obj" << points + "vn 0 0 1\n" + sides("f", 1, "//1", "");
        QTest::newRow("OBJ, edges and points as faces") << "a.obj" << points + "f 3\nf 3 4\n" + faces;
        QTest::newRow("OBJ, lines and points") << "a.obj" << points + "l 1 2 3\np 1\n" + faces;
        QTest::newRow("OBJ, comments behind") << "a.obj" << points + sides("f", 1, "", " # a side");
        QTest::newRow("OBJ, indented") << "a.obj" << vertices("  v ", "") + sides("  f", 1, "", "");
        QTest::newRow("OBJ, parameter points") << "a.obj"
                                               << "vp 0.1 0.2\n" + points + faces;
        QTest::newRow("OBJ, byte order mark") << "a.obj"
                                              << "\xef\xbb\xbf" + points + faces;
        QTest::newRow("OBJ, continued lines") << "a.obj" << points + sides("f \\\n", 1, "", "");
        QTest::newRow("OBJ, faces first") << "a.obj" << faces + points;
        QTest::newRow("OBJ, colours") << "a.obj" << vertices("v ", " 1 0 0.5") + faces;
        QTest::newRow("OBJ, groups") << "a.obj"
                                     << "o a\ng\ns 1\n" + points + "g b c\nusemtl m\n" + faces;
        QTest::newRow("OBJ, no such materials") << "a.obj"
                                                << "mtllib gone.mtl\n" + points + faces;
        QTest::newRow("OBJ, endless materials") << "a.obj"
                                                << "mtllib /dev/zero\n" + points + faces;
        QTest::newRow("OFF, no edges") << "a.off" << off().replace("8 6 12", "8 6");
        QTest::newRow("OFF, comments") << "a.off" << off().replace("8 6 12", "# made\n\n8 6 12 # counts");
        QTest::newRow("OFF, no keyword") << "a.off" << off().mid(4);
        QTest::newRow("OFF, colours of faces")
            << "a.off"
            << "OFF 8 6 0\n" + vertices("", "") + sides("4", 0, "", " 255 0 0");
        QTest::newRow("COFF") << "a.off"
                              << "COFF\n8 6 0\n" + vertices("", " 9 9 9 255") + sides("4", 0, "", "");
        QTest::newRow("PLY, CRLF") << "a.ply" << ply().replace("\n", "\r\n");
        QTest::newRow("PLY, vertex_index") << "a.ply" << ply().replace("vertex_indices", "vertex_index");
        QTest::newRow("PLY, another list")
            << "a.ply"
            << plyHeader("ascii", "", "property list uchar float uv\n") + "end_header\n" + vertices("", "") +
                   sides("4", 0, "", " 2 0.5 0.5");
        QTest::newRow("PLY, a list in vertices")
            << "a.ply"
            << plyHeader("ascii", "property list uchar int near\n", "") + "end_header\n" +
                   vertices("", " 2 1 2") + sides("4", 0, "", "");
        QTest::newRow("PLY, another element")
            << "a.ply"
            << plyHeader("ascii", "element edge 1\nproperty int a\n", "") + "end_header\n" +
                   vertices("", "") + "3\n" + sides("4", 0, "", "");
        QTest::newRow("PLY, a strip")
            << "a.ply"
            << "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float "
               "z\n"
               "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                   vertices("", "") + "14 3 2 7 6 4 2 0 3 1 7 5 4 1 0\n";
        QTest::newRow("PLY, little-endian") << "a.ply" << binaryPly(false);
        QTest::newRow("PLY, big-endian") << "a.ply" << binaryPly(true);
        QTest::newRow("STL, capitals") << "a.stl" << stl().toUpper();
        QTest::newRow("STL, blank lines first") << "a.stl"
                                                << "\n  " + stl();
        QTest::newRow("STL, stray bytes")
            << "a.stl" << stl().replace(20, 1, "\x01") + QByteArray("\0\x1a", 2);
        QTest::newRow("STL, Latin-1 name") << "a.stl" << stl().replace("solid cube", "solid W\xfcrfel");
        QTest::newRow("STL, name of keywords") << "a.stl" << stl().replace("cube", "vertex endfacet");
        QByteArray two = stl();
        two.replace(two.indexOf("\nfacet", two.size() / 2), 1, "\nendsolid cube\nsolid b\n");
        QTest::newRow("STL, two solids") << "a.stl" << two;
        QTest::newRow("binary STL, solid") << "a.stl" << mesh_files::binaryStl("solid cube");
        QTest::newRow("binary STL, bytes behind") << "a.stl" << mesh_files::binaryStl("solid cube") + "\n\n";
        QTest::newRow("glTF") << "a.gltf" << embeddedGltf();
        QTest::newRow("glTF, no scene")
            << "a.gltf" << embeddedGltf().replace(",\"scenes\":[{\"nodes\":[0]}]", "");
        QTest::newRow("glTF, a skin")
            << "a.gltf"
            << embeddedGltf()
                   .replace("{\"mesh\":0}", "{\"mesh\":0,\"skin\":0},{}")
                   .replace("\"nodes\":[0]}]", "\"nodes\":[0,1]}],\"skins\":[{\"joints\":[1]}]");
        QTest::newRow("GLB") << "a.glb" << glb(true);
        QTest::newRow("GLB, not aligned") << "a.glb" << glb(false);
    }

    void readsWhatExportersWrite() {
        QFETCH(QString, name);
        QFETCH(QByteArray, content);
        const bool metres = name.endsWith(".gltf") || name.endsWith(".glb");
        const auto imported = part::importMesh(write(name, content), metres ? "m" : "mm");
        QVERIFY2(imported.ok(), imported ? "" : imported.error().message.c_str());
        QCOMPARE(imported->mesh.triangles.size(), std::size_t{12});
        const geometry::MassProperties properties = geometry::calcMassProperties(imported->mesh, 1.0);
        QVERIFY(std::abs(properties.volume - 1e-6) < 1e-11);
        QVERIFY((properties.centre - Vec3(5, 5, 5) * kMillimetre).norm() < 1e-8);
    }

    /// Other files that a part's file names are read only where they lie beside it.
    void buffersBesideThePart_data() {
        QTest::addColumn<QString>("uri");
        QTest::addColumn<QString>("message");  // empty: is read
        QTest::newRow("beside") << "my cube.bin"
                                << "";
        QTest::newRow("percent-encoded") << "my%20cube.bin"
                                         << "";
        QTest::newRow("below") << "data/cube.bin"
                               << "";
        QTest::newRow("there and back") << "data/../my cube.bin"
                                        << "";
        QTest::newRow("above") << "../cube.bin"
                               << "outside the part's folder";
        QTest::newRow("a link to above") << "link.bin"
                                         << "outside the part's folder";
        QTest::newRow("missing") << "gone.bin"
                                 << "does not exist";
        QTest::newRow("a pipe") << "pipe"
                                << "not a regular file";
        QTest::newRow("a folder") << "data"
                                  << "not a regular file";
    }

    void buffersBesideThePart() {
        QFETCH(QString, uri);
        QFETCH(QString, message);
        const QDir top(folder_.filePath("external"));
        QVERIFY(top.mkpath("part/data"));
        for (const char* name : {"cube.bin", "part/my cube.bin", "part/data/cube.bin"})
            write("external/" + QString(name), mesh_files::gltfBuffer());
        QFile::link(top.filePath("cube.bin"), top.filePath("part/link.bin"));
        ::mkfifo(top.filePath("part/pipe").toLocal8Bit().constData(), 0600);
        const auto imported = part::importMesh(
            write("external/part/a.gltf", mesh_files::gltf("\"uri\":\"" + uri.toUtf8() + "\",")));
        QCOMPARE(imported.ok(), message.isEmpty());
        if (imported) return;
        const QString found = QString::fromStdString(imported.error().message);
        QVERIFY2(found.contains(message) && found.contains("a.gltf"), qPrintable(found));
    }

    void readsBinaryStl() {
        const auto imported = part::importMesh(write("box.stl", binaryStl()), "mm");
        QVERIFY(imported.ok());
        QVERIFY((geometry::calcBoundingBox(imported->mesh).size() - Vec3(4, 8, 12) * kMillimetre).norm() <
                1e-8);
        QVERIFY(imported->notes.empty());
    }

    /// A U-shaped side: a fan from its first corner would overlap itself.
    void concavePolygonsAreTriangulated() {
        const char* const text =
            "OFF\n16 10 0\n0 0 0\n30 0 0\n30 20 0\n20 20 0\n20 10 0\n10 10 0\n10 20 0\n0 20 0\n"
            "0 0 5\n30 0 5\n30 20 5\n20 20 5\n20 10 5\n10 10 5\n10 20 5\n0 20 5\n"
            "8 7 6 5 4 3 2 1 0\n8 8 9 10 11 12 13 14 15\n4 0 1 9 8\n4 1 2 10 9\n4 2 3 11 10\n4 3 4 12 11\n"
            "4 4 5 13 12\n4 5 6 14 13\n4 6 7 15 14\n4 7 0 8 15\n";
        const auto imported = part::importMesh(write("u.off", text));
        QVERIFY2(imported.ok(), imported ? "" : imported.error().message.c_str());
        const geometry::MassProperties properties = geometry::calcMassProperties(imported->mesh, 1.0);
        QVERIFY(std::abs(properties.volume / 2500e-9 - 1.0) < 1e-9);
        QVERIFY(std::abs(properties.area / (2 * 500e-6 + 120 * 5e-6) - 1.0) < 1e-9);
    }

    void gltfIsInMetresAndPlacesNodes() {
        const auto imported = part::importMesh(write("a.gltf", gltf()));
        QVERIFY2(imported.ok(), imported ? "" : imported.error().message.c_str());
        QVERIFY(imported->unitsFromFile);
        QCOMPARE(imported->units, std::string("m"));
        QCOMPARE(imported->mesh.triangles.size(), std::size_t{8});
        const geometry::MassProperties properties = geometry::calcMassProperties(imported->mesh, 1.0);
        QVERIFY(std::abs(properties.volume - 2e-6) < 1e-11);  // the mirrored copy is not inside out
        QVERIFY(std::abs(properties.centre.x()) < 1e-8);
    }

    void readsDeclaredUnits_data() {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("units");
        QTest::addColumn<double>("volume");  // [cubic inches]
        QTest::addColumn<double>("length");  // [inches]
        QTest::addColumn<double>("tolerance");
        QTest::newRow("STEP") << "cylinder_inch.step"
                              << "inch" << base::kPi / 32 << 0.5 << 0.01;
        QTest::newRow("IGES") << "box_inch.igs"
                              << "inch" << 0.015625 << 0.5 << 1e-6;
        QTest::newRow("3MF") << "two_boxes_inch.3mf"
                             << "inch" << 0.03125 << 0.5 << 1e-6;
    }

    void readsDeclaredUnits() {
        QFETCH(QString, file);
        QFETCH(QString, units);
        QFETCH(double, volume);
        QFETCH(double, length);
        QFETCH(double, tolerance);
        const auto imported = part::importMesh(kData / file.toStdString());
        QVERIFY2(imported.ok(), imported ? "" : imported.error().message.c_str());
        QVERIFY(imported->unitsFromFile);
        QCOMPARE(QString::fromStdString(imported->units), units);
        const double inch = 0.0254;
        const double found = geometry::calcMassProperties(imported->mesh, 1.0).volume / std::pow(inch, 3);
        QVERIFY(std::abs(found / volume - 1.0) < tolerance);
        QVERIFY(std::abs(geometry::calcBoundingBox(imported->mesh).size().maxCoeff() / inch - length) < 1e-5);

        // The user knows better: the same numbers as millimetres.
        const auto asMillimetres = part::importMesh(kData / file.toStdString(), "mm");
        QVERIFY(asMillimetres.ok());
        QVERIFY(!asMillimetres->unitsFromFile);
        QVERIFY(!asMillimetres->notes.empty());
        const double shrunk = geometry::calcMassProperties(asMillimetres->mesh, 1.0).volume / 1e-9;
        QVERIFY(std::abs(shrunk / volume - 1.0) < tolerance);
    }

    void unitsAreNeverAssumedAgainstTheOdds_data() {
        QTest::addColumn<QByteArray>("content");
        QTest::newRow("in metres") << scaled(scaled(scaled(kObj, "10", "0.01"), "20", "0.02"), "30", "0.03");
        QTest::newRow("in micrometres")
            << scaled(scaled(scaled(kObj, "10", "10000"), "20", "20000"), "30", "30000");
    }

    void unitsAreNeverAssumedAgainstTheOdds() {
        QFETCH(QByteArray, content);
        const std::filesystem::path path = write("odd.obj", content);
        const auto imported = part::importMesh(path);
        QVERIFY(!imported.ok());
        for (const char* text : {"um: ", "mm: ", "cm: ", "m: ", "inch: ", "30 mm", "--units"}) {
            QVERIFY2(imported.error().message.find(text) != std::string::npos,
                     imported.error().message.c_str());
        }
        QVERIFY(part::importMesh(path, "um").ok());
    }

    void unitsAsAsked_data() {
        QTest::addColumn<QString>("units");
        QTest::addColumn<double>("metres");
        QTest::newRow("um") << "um" << 1e-6;
        QTest::newRow("mm") << "mm" << 1e-3;
        QTest::newRow("cm") << "cm" << 1e-2;
        QTest::newRow("m") << "m" << 1.0;
        QTest::newRow("inch") << "inch" << 0.0254;
        QTest::newRow("IN") << "IN" << 0.0254;
        QTest::newRow("Millimeter") << "Millimeter" << 1e-3;
        QTest::newRow("ft") << "ft" << 0.3048;
    }

    void unitsAsAsked() {
        QFETCH(QString, units);
        QFETCH(double, metres);
        const auto imported = part::importMesh(write("a.obj", kObj), units.toStdString());
        QVERIFY(imported.ok());
        QVERIFY(std::abs(geometry::calcBoundingBox(imported->mesh).size().z() / (30.0 * metres) - 1.0) <
                1e-6);
    }

    void badFilesAreRefused_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("content");
        QTest::addColumn<QString>("message");
        const QByteArray binary = binaryStl();
        QByteArray many = binary;
        const std::uint32_t announced = 4000000000U;
        std::memcpy(many.data() + 80, &announced, sizeof announced);
        QTest::newRow("empty") << "a.stl" << QByteArray() << "is empty";
        QTest::newRow("unknown extension") << "a.docx" << QByteArray("x") << ".stl .obj";
        QTest::newRow("no extension") << "part" << QByteArray("x") << "not supported";
        QTest::newRow("text as STL") << "a.stl" << QByteArray("Dear all,\nsee the part.\n")
                                     << "not an STL file";
        QTest::newRow("solid, no facets") << "a.stl" << QByteArray("solid gold\nis heavy\n") << "no facets";
        QTest::newRow("ASCII STL cut short") << "a.stl" << QByteArray(kAsciiStl).left(300) << "cut short";
        QTest::newRow("binary STL cut short") << "a.stl" << binary.left(400) << "truncated";
        QTest::newRow("binary STL, header only") << "a.stl" << QByteArray(60, '\1') << "too short";
        QTest::newRow("binary STL, absurd count") << "a.stl" << many << "4000000000 triangles";
        QTest::newRow("binary STL, longer than said") << "a.stl" << binary + binary << "damaged";
        QTest::newRow("binary STL, none") << "a.stl" << QByteArray(84, '\0') << "without triangles";
        QTest::newRow("not a number") << "a.stl" << scaled(kAsciiStl, "10 0 0", "nan 0 0") << "not a number";
        QTest::newRow("garbage as OBJ") << "a.obj" << QByteArray("no geometry here\n") << "a.obj";
        QTest::newRow("points only") << "a.obj" << QByteArray("v 0 0 0\nv 1 0 0\nv 0 1 0\n") << "a.obj";
        QTest::newRow("PLY cut short") << "a.ply" << QByteArray(kPly).left(190) << "cut short";
        QTest::newRow("PLY, no such vertex") << "a.ply" << scaled(kPly, "3 1 2 3", "3 1 2 9") << "a.ply";
        QTest::newRow("OFF cut short") << "a.off" << QByteArray(kOff).left(40) << "cut short";
        QTest::newRow("OBJ, no such vertex") << "a.obj" << scaled(kObj, "f 2 3 4", "f 2 3 9") << "a.obj";
        QTest::newRow("garbage as PLY") << "a.ply" << QByteArray("ply\nformat ascii 1.0\n") << "a.ply";
        using namespace mesh_files;
        QTest::newRow("PLY, property first")
            << "a.ply" << ply().replace("element vertex", "property int a\nelement vertex")
            << "a property before the first element";
        QTest::newRow("PLY, too many")
            << "a.ply" << ply().replace("vertex 8", "vertex 4000000000000") << "cut short";
        QTest::newRow("PLY, long list") << "a.ply" << ply().replace("\n4 0 2 3 1", "\n400000000 0 2 3 1")
                                        << "more entries than the file can hold";
        QTest::newRow("PLY, no corners")
            << "a.ply" << ply().replace("vertex_indices", "indices") << "no list \"vertex_indices\"";
        QTest::newRow("PLY, unknown type") << "a.ply" << ply().replace("float x", "real x") << "\"real\"";
        QTest::newRow("OBJ, no number") << "a.obj" << obj().replace("v 10 0 0", "v 10 O 0") << "line 2";
        QTest::newRow("OFF, binary") << "a.off" << QByteArray("OFF BINARY\n\0\0\0", 14) << "binary";
        QTest::newRow("OFF, too many") << "a.off" << off().replace("8 6 12", "80000000 6 12") << "cut short";
        QTest::newRow("STL, two corners")
            << "a.stl" << stl().replace(" vertex 0 0 0\n", " \n") << "facet 1 has 2 corners";
        QTest::newRow("glTF 1") << "a.gltf" << embeddedGltf().replace("2.0", "1.0") << "glTF 1.0";
        QTest::newRow("glTF, no such vertex")
            << "a.gltf" << embeddedGltf().replace("\"count\":8", "\"count\":7") << "6 of its 12 triangles";
        QTest::newRow("glTF, deep") << "a.gltf" << QByteArray(100000, '[') << "deeper than";
        QTest::newRow("glTF, a loop")
            << "a.gltf" << embeddedGltf().replace("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}")
            << "below itself";
        QTest::newRow("glTF, cut short") << "a.gltf" << embeddedGltf().left(200) << "at byte";
        QTest::newRow("glTF, quantized")
            << "a.gltf" << embeddedGltf().replace("5126", "5122") << "KHR_mesh_quantization";
        QTest::newRow("GLB, cut short") << "a.glb" << glb(true).chopped(20) << "cut short";
        QTest::newRow("garbage as glTF") << "a.gltf" << QByteArray("{}") << "a.gltf";
        QTest::newRow("garbage as 3MF") << "a.3mf" << QByteArray("PK no zip") << "a.3mf";
        QTest::newRow("garbage as STEP") << "a.step" << QByteArray("ISO-10303-21;\nnonsense\n") << "a.step";
        QTest::newRow("garbage as IGES") << "a.igs" << QByteArray("nonsense\n") << "a.igs";
    }

    void badFilesAreRefused() {
        QFETCH(QString, name);
        QFETCH(QByteArray, content);
        QFETCH(QString, message);
        const auto imported = part::importMesh(write(name, content));
        QVERIFY(!imported.ok());
        const std::string& found = imported.error().message;
        QVERIFY2(found.find(message.toStdString()) != std::string::npos, found.c_str());
        QVERIFY2(found.find(name.toStdString()) != std::string::npos, found.c_str());
    }

    void truncatedStepIsRefused() {
        QFile file(QString::fromStdString((kData / "cylinder_inch.step").string()));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const auto imported = part::importMesh(write("cut.step", file.read(2000)));
        QVERIFY(!imported.ok());
        QVERIFY(imported.error().message.find("cut.step") != std::string::npos);
    }

    void placesThatAreNoFiles() {
        const auto missing = part::importMesh("/nowhere/part.stl");
        QVERIFY(!missing.ok());
        QVERIFY(missing.error().message.find("does not exist") != std::string::npos);
        const auto folder = part::importMesh(folder_.path().toStdString());
        QVERIFY(!folder.ok());
        QVERIFY(folder.error().message.find("is not a file") != std::string::npos);
    }

    void unknownUnitIsRefused() {
        const auto imported = part::importMesh(write("a.obj", kObj), "furlong");
        QVERIFY(!imported.ok());
        QVERIFY(imported.error().message.find("furlong") != std::string::npos);
        QVERIFY(imported.error().message.find("mm") != std::string::npos);
    }
};

QTEST_GUILESS_MAIN(ImportTest)
#include "import_test.moc"
