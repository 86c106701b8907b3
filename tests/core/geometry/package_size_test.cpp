// Packages that unpack to more than a model has, or to something else than they say.

#include "core/geometry/three_mf.h"

#include <zip.h>

#include <QtTest>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

using namespace trapwright;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

std::string pack(const Files& files) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(nullptr, 0, 0, &error);
    zip_source_keep(source);
    zip_t* archive = zip_open_from_source(source, ZIP_TRUNCATE, &error);
    for (const auto& [name, content] : files)
        zip_file_add(archive, name.c_str(), zip_source_buffer(archive, content.data(), content.size(), 0), 0);
    zip_close(archive);
    zip_stat_t whole;
    zip_source_stat(source, &whole);
    std::string bytes(whole.size, '\0');
    zip_source_open(source);
    zip_source_read(source, bytes.data(), bytes.size());
    zip_source_close(source);
    zip_source_free(source);
    return bytes;
}

/// The package with other sizes of all its files, in their headers and in the directory.
std::string lie(std::string package, std::uint32_t size) {
    for (const auto& [mark, offset] : {std::pair{"PK\3\4", 22}, std::pair{"PK\1\2", 24}})
        for (std::size_t at = package.find(mark); at != std::string::npos; at = package.find(mark, at + 4))
            std::memcpy(package.data() + at + offset, &size, sizeof size);
    return package;
}

/// Numbers as models have them; they pack to about a third.
std::string makeText(std::size_t size) {
    std::string text;
    for (std::uint64_t i = 1; text.size() < size; ++i)
        text += "<vertex x=\"" + std::to_string(i * 2654435761U % 100000007U) + "\"/>";
    return text;
}

}  // namespace

class PackageSizeTest : public QObject {
    Q_OBJECT

 private slots:
    void modelsPass() {
        const auto status = geometry::checkPackageSize(pack(
            {{"3D/3dmodel.model", makeText(std::size_t{20} << 20U)}, {"_rels/.rels", "x"}, {"empty", ""}}));
        QVERIFY2(status.ok(), status ? "" : status.error().message.c_str());
    }

    void bombsAreRefused_data() {
        QTest::addColumn<QByteArray>("package");
        QTest::addColumn<QString>("message");
        const std::string zeros(std::size_t{64} << 20U, '\0');
        Files many;
        for (int i = 0; i < 40; ++i)
            many.emplace_back("part" + std::to_string(i), "text");
        const auto bytes = [](const std::string& text) {
            return QByteArray(text.data(), static_cast<int>(text.size()));
        };
        QTest::newRow("one file of zeros") << bytes(pack({{"3D/a.model", zeros}})) << "which no model does";
        QTest::newRow("many files") << bytes(lie(pack(many), 15U << 20U)) << "more than 512 MiB";
        QTest::newRow("says 4 GiB") << bytes(lie(pack({{"a", "text"}}), 0xfffffff0U)) << "more than 512 MiB";
        QTest::newRow("says less") << bytes(lie(pack({{"a", zeros}}), 1000))
                                   << "larger than the package says";
        QTest::newRow("says more") << bytes(lie(pack({{"a", makeText(5000)}}), 6000)) << "smaller than";
        QTest::newRow("cut short") << bytes(pack({{"a", makeText(5000)}})).left(700) << "not a zip package";
        QTest::newRow("nothing") << QByteArray() << "nothing in it";
    }

    void bombsAreRefused() {
        QFETCH(QByteArray, package);
        QFETCH(QString, message);
        const auto status =
            geometry::checkPackageSize({package.constData(), static_cast<std::size_t>(package.size())});
        QVERIFY(!status.ok());
        QVERIFY2(status.error().message.find(message.toStdString()) != std::string::npos,
                 status.error().message.c_str());
    }
};

QTEST_APPLESS_MAIN(PackageSizeTest)
#include "package_size_test.moc"
