// Mesh files that were damaged on their way: each is read, or refused with a message that names it. A crash
// or a reader that does not come back ends the test.

#include <unistd.h>

#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "core/base/file.h"
#include "core/geometry/three_mf.h"
#include "core/part/import.h"
#include "core/part/shapes.h"
#include "mesh_files.h"

using namespace trapwright;

namespace {

constexpr unsigned kPatience = 120;  // [s] for all files of a format

/// Up to three changes: other bytes, cuts, repeats, and words that readers stumble over.
std::string damage(std::string bytes, std::mt19937& random) {
    const std::vector<std::string> words = {"-1",        "999999999999",      "1e999",           "nan", "\n",
                                            "property ", {0, '\xff', '\xff'}, "list uchar int ", "{[[", "\"",
                                            "\\\n",      "endfacet "};
    for (std::uint32_t changes = 1 + random() % 3; changes > 0 && !bytes.empty(); --changes) {
        const std::size_t at = random() % bytes.size();
        const std::size_t length = 1 + random() % std::min<std::size_t>(40, bytes.size() - at);
        switch (random() % 5) {
            case 0:
                bytes[at] = static_cast<char>(random());
                break;
            case 1:
                bytes.erase(at, length);
                break;
            case 2:
                bytes.insert(at, bytes.substr(at, length));
                break;
            case 3:
                bytes.insert(at, words[random() % words.size()]);
                break;
            default:
                bytes.resize(at);
        }
    }
    return bytes;
}

}  // namespace

class MeshDamageTest : public QObject {
    Q_OBJECT

 private slots:
    void damagedFilesAreReadOrRefused_data() {
        QTest::addColumn<QString>("extension");
        QTest::addColumn<QByteArray>("whole");
        QTest::newRow("OBJ") << "obj" << mesh_files::obj();
        QTest::newRow("OFF") << "off" << mesh_files::off();
        QTest::newRow("COFF") << "off"
                              << "COFF\n8 6 0\n" + mesh_files::vertices("", " 255 0 0 255") +
                                     mesh_files::sides("4", 0, "", " 3 0 0 255");
        QTest::newRow("PLY") << "ply" << mesh_files::ply();
        QTest::newRow("PLY, little-endian") << "ply" << mesh_files::binaryPly(false);
        QTest::newRow("PLY, big-endian") << "ply" << mesh_files::binaryPly(true);
        QTest::newRow("STL in text") << "stl" << mesh_files::stl();
        QTest::newRow("binary STL") << "stl" << mesh_files::binaryStl("solid cube");
        QTest::newRow("glTF") << "gltf" << mesh_files::embeddedGltf();
        QTest::newRow("GLB") << "glb" << mesh_files::glb(true);
        const std::string package = folder_.filePath("whole.3mf").toStdString();
        const geometry::TriangleMesh box = part::makeBox({0.01, 0.01, 0.01});
        QVERIFY(geometry::write3mf(package, {&box, 1}, "box").ok());
        const std::string bytes = base::readFile(package).value();
        QTest::newRow("3MF") << "3mf" << QByteArray(bytes.data(), static_cast<int>(bytes.size()));
    }

    // TRAPWRIGHT_MESH_DAMAGES asks for another number of files than 300.
    void damagedFilesAreReadOrRefused() {
        QFETCH(QString, extension);
        QFETCH(QByteArray, whole);
        const std::string path = folder_.filePath("damaged." + extension).toStdString();
        QVERIFY(base::writeFile(path, whole.toStdString()).ok());
        const auto first = part::importMesh(path, "mm");
        QVERIFY2(first.ok(), first ? "" : first.error().message.c_str());

        const int files = qEnvironmentVariableIsSet("TRAPWRIGHT_MESH_DAMAGES")
                              ? qEnvironmentVariableIntValue("TRAPWRIGHT_MESH_DAMAGES")
                              : 300;
        std::mt19937 random(1);
        int read = 0;
        ::alarm(kPatience);
        for (int i = 0; i < files; ++i) {
            const std::string bytes = damage(whole.toStdString(), random);
            std::ofstream(path, std::ios::binary) << bytes;  // without the sync of our own writer
            const auto imported = part::importMesh(path, "mm");
            if (imported) {
                ++read;
                QVERIFY(!imported->mesh.triangles.empty());
            } else {
                QVERIFY2(imported.error().message.find(path) != std::string::npos,
                         imported.error().message.c_str());
            }
        }
        ::alarm(0);
        qInfo("%d files: %d read, %d refused", files, read, files - read);
        QVERIFY(read < files);
    }

 private:
    QTemporaryDir folder_;
};

QTEST_APPLESS_MAIN(MeshDamageTest)
#include "mesh_damage_test.moc"
