#include "core/geometry/mesh_files.h"

#include <sys/resource.h>
#include <unistd.h>

#include <QTemporaryDir>
#include <QTest>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "core/geometry/mass_properties.h"
#include "core/geometry/three_mf.h"
#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;
namespace fs = std::filesystem;

namespace {

base::Status write(const fs::path& path, const TriangleMesh& mesh) {
    return path.extension() == ".3mf" ? write3mf(path, {&mesh, 1}, "cup") : writeStl(path, mesh);
}

base::Result<TriangleMesh> read(const fs::path& path) {
    return path.extension() == ".3mf" ? read3mf(path) : readStl(path);
}

void writeText(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

std::size_t countFiles(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// While it lives no file can grow past `bytes`, as on a full disk.
class FileSizeLimit {
 public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

 private:
    rlimit before_{};
    void (*handler_)(int);
};

void addFormats() {
    QTest::addColumn<QString>("fileName");
    QTest::newRow("STL") << "mesh.stl";
    QTest::newRow("3MF") << "mesh.3mf";
}

}  // namespace

class MeshFilesTest : public QObject {
    Q_OBJECT

 private slots:
    void init() { folder_ = std::make_unique<QTemporaryDir>(); }

    void whatIsWrittenIsRead_data() { addFormats(); }
    void whatIsWrittenIsRead() {
        QFETCH(QString, fileName);
        const TriangleMesh mesh = shapes::makeCup(24, 0.005, 0.01, 0.001);
        const auto written = write(path(fileName), mesh);
        QVERIFY2(written.ok(), written.ok() ? "" : written.error().message.c_str());
        QCOMPARE(countFiles(path("")), std::size_t(1));
        const auto back = read(path(fileName));
        QVERIFY2(back.ok(), back.ok() ? "" : back.error().message.c_str());
        QCOMPARE(back->triangles.size(), mesh.triangles.size());
        QCOMPARE(back->vertices.size(), mesh.vertices.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (int k = 0; k < 3; ++k)
                QVERIFY((back->vertices[back->triangles[i][k]] - mesh.vertices[mesh.triangles[i][k]]).norm() <
                        1e-8);
        QVERIFY(std::abs(calcMassProperties(*back, 1.0).volume / calcMassProperties(mesh, 1.0).volume - 1.0) <
                1e-5);
    }

    void stlIsInMillimetres() {
        QVERIFY(writeStl(path("box.stl"), shapes::makeBox({0, 0, 0}, {0.004, 0.008, 0.012})).ok());
        std::ifstream file(path("box.stl"), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        QCOMPARE(bytes.size(), std::size_t(84 + 12 * 50));
        QVERIFY(!bytes.starts_with("solid"));
        float largest = 0.0F;
        for (int i = 0; i < 12; ++i)
            for (int k = 3; k < 12; ++k) {
                float value = 0.0F;
                std::memcpy(&value, bytes.data() + 84 + 50 * i + 4 * k, sizeof value);
                largest = std::max(largest, value);
            }
        QCOMPARE(largest, 12.0F);
    }

    void fullDiskLeavesTheOldFile_data() { addFormats(); }
    void fullDiskLeavesTheOldFile() {
        QFETCH(QString, fileName);
        QVERIFY(write(path(fileName), shapes::makeBox({0, 0, 0}, {0.004, 0.008, 0.012})).ok());
        {
            const FileSizeLimit limit(700);
            const auto written = write(path(fileName), shapes::makeCup(64, 0.005, 0.01, 0.001));
            QVERIFY(!written.ok());
            QVERIFY(written.error().message.find(path(fileName).string()) != std::string::npos);
        }
        QCOMPARE(countFiles(path("")), std::size_t(1));
        const auto back = read(path(fileName));
        QVERIFY(back.ok());
        QCOMPARE(back->triangles.size(), std::size_t(12));
    }

    void readOnlyFolderIsAnError_data() { addFormats(); }
    void readOnlyFolderIsAnError() {
        QFETCH(QString, fileName);
        if (geteuid() == 0) {
            // Permissions do not bind root; a folder that does not exist takes the same way.
            QVERIFY(!write(path("nowhere") / fileName.toStdString(), shapes::makeL()).ok());
            return;
        }
        fs::permissions(path(""), fs::perms::owner_read | fs::perms::owner_exec);
        const auto written = write(path(fileName), shapes::makeL());
        fs::permissions(path(""), fs::perms::owner_all);
        QVERIFY(!written.ok());
        QCOMPARE(countFiles(path("")), std::size_t(0));
    }

    void badFilesAreErrors_data() {
        QTest::addColumn<QString>("fileName");
        QTest::addColumn<QString>("content");
        for (const char* name : {"bad.stl", "bad.3mf"}) {
            QTest::addRow("%s missing", name) << name << QString();
            QTest::addRow("%s empty", name) << name << "";
            QTest::addRow("%s text", name) << name << QString("solid of words, ").repeated(20);
        }
    }
    void badFilesAreErrors() {
        QFETCH(QString, fileName);
        QFETCH(QString, content);
        if (!content.isNull()) writeText(path(fileName), content.toStdString());
        const auto mesh = read(path(fileName));
        QVERIFY(!mesh.ok());
        QVERIFY(mesh.error().message.find(path(fileName).string()) != std::string::npos);
    }

    void badMeshesAreNotWritten_data() { addFormats(); }
    void badMeshesAreNotWritten() {
        QFETCH(QString, fileName);
        QVERIFY(!write(path(fileName), {}).ok());
        TriangleMesh mesh = shapes::makeL();
        mesh.vertices[3].x() = std::nan("");
        QVERIFY(!write(path(fileName), mesh).ok());
        QCOMPARE(countFiles(path("")), std::size_t(0));
    }

 private:
    [[nodiscard]] fs::path path(const QString& name) const {
        return fs::path(folder_->path().toStdString()) / name.toStdString();
    }
    std::unique_ptr<QTemporaryDir> folder_;
};

QTEST_APPLESS_MAIN(MeshFilesTest)
#include "mesh_files_test.moc"
