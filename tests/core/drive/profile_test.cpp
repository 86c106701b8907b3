#include "core/drive/profile.h"

#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <fstream>

#include "core/drive/profile_folder.h"

using namespace trapwright;
using drive::Table;

Q_DECLARE_METATYPE(trapwright::drive::Table)

namespace {

drive::ProfileFolder bundled() {
    return drive::readProfileFolder(std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/drives");
}

drive::Profile bundled(const std::string& name) {
    const drive::ProfileFolder folder = bundled();
    const auto it = std::find_if(folder.profiles.begin(), folder.profiles.end(),
                                 [&](const drive::Profile& profile) { return profile.name == name; });
    return it == folder.profiles.end() ? drive::Profile{} : *it;
}

constexpr const char* kGood = R"({"format": "trapwright drive", "version": 1, "name": "mine", "title": "Mine",
    "checkedAgainst": "nothing", "protocol": "modbus-tcp",
    "modbus": {"setPoint": {"holdingRegister": 10, "zero": 0, "one": 4095}}})";

std::string with(const char* what, const char* by) {
    return QString(kGood).replace(what, by).toStdString();
}

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

}  // namespace

class ProfileTest : public QObject {
    Q_OBJECT

 private slots:
    void allBundledOnesAreGood() {
        const drive::ProfileFolder folder = bundled();
        for (const std::string& problem : folder.problems)
            qWarning("%s", problem.c_str());
        QVERIFY(folder.problems.empty());
        QCOMPARE(folder.profiles.size(), std::size_t(8));
        for (const drive::Profile& profile : folder.profiles) {
            QVERIFY(!profile.checkedAgainst.empty());
            QVERIFY(!profile.wiring.empty());
            QVERIFY(profile.isVirtual || !profile.sources.empty());
        }
    }

    // Numbers as the makers' manuals print them, which count from 1 within 0xxxx and 4xxxx.
    void addressesOfTheManuals_data() {
        QTest::addColumn<QString>("profile");
        QTest::addColumn<int>("setPoint");
        QTest::addColumn<Table>("table");
        QTest::addColumn<int>("enable");
        QTest::newRow("ADAM-6024") << "adam-6024" << 40011 << Table::coil << 17;
        QTest::newRow("ioLogik E1241") << "iologik-e1241" << 41025 << Table::holdingRegister << 41026;
        QTest::newRow("WAGO 750") << "wago-750" << 40001 << Table::coil << 1;
    }
    void addressesOfTheManuals() {
        QFETCH(QString, profile);
        QFETCH(int, setPoint);
        QFETCH(Table, table);
        QFETCH(int, enable);
        const drive::Profile read = bundled(profile.toStdString());
        QCOMPARE(read.modbus.setPoint.value().place.address, setPoint - 40001);
        QVERIFY(read.modbus.setPoint->place.table == Table::holdingRegister);
        QVERIFY(read.modbus.enable.value().place.table == table);
        QCOMPARE(read.modbus.enable->place.address, enable - (table == Table::coil ? 1 : 40001));
    }

    void theWagoWatchdogIsSet() {
        const drive::Profile wago = bundled("wago-750");
        // In steps of 100 ms at 0x1000; triggered by function codes 1 to 6, 15 and 16 at 0x1001; begun at
        // 0x1003.
        std::map<int, double> written;
        for (const drive::Write& write : wago.modbus.atConnect)
            written[write.place.address] = write.value;
        QCOMPARE(written[0x1000] * 0.1, wago.watchdog.value());
        int mask = 0;
        for (const int code : {1, 2, 3, 4, 5, 6, 15, 16})
            mask |= 1 << (code - 1);
        QCOMPARE(static_cast<int>(written[0x1001]), mask);
        QVERIFY(written[0x1003] != 0.0);
        QCOMPARE(wago.modbus.setPointReadBack.value().place.address, 0x0200);
    }

    void theAsycubeIsTriggeredAgainAndAgain() {
        const drive::Profile asycube = bundled("asycube");
        QVERIFY(!asycube.hasSetPoint());
        const auto& writes = asycube.modbus.whileEnabled;
        QCOMPARE(writes.size(), std::size_t(4));
        QCOMPARE(writes[1].place.address, 3);
        // Longer than a beat, or it would stutter; shorter than its watchdog as a whole.
        QVERIFY(writes[1].value * 1e-3 > 1.0 / asycube.heartbeat);
        QVERIFY(writes[1].value * 1e-3 + 1.0 / asycube.heartbeat <= asycube.watchdog.value() + 1e-9);
        // A rising edge.
        QCOMPARE(writes[2].value, 0.0);
        QCOMPARE(writes[3].value, 1.0);
    }

    void problemsSayWhatWhereAndWhatToDo_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QStringList>("parts");
        const auto row = [](const char* name, const std::string& text, const QStringList& parts) {
            QTest::newRow(name) << QString::fromStdString(text) << parts;
        };
        row("not JSON", with("\"version\": 1,", "\"version\": 1"), {"not JSON", "line 1", "comma"});
        row("empty", "", {"not JSON"});
        row("a list", "[]", {"{ ... }"});
        row("a number that no double holds", with("\"version\": 1", "\"version\": 1e999"), {"1e999"});
        row("deep nesting", std::string(100000, '['), {"not JSON"});
        row("deep nesting that ends", std::string(5000, '[') + std::string(5000, ']'), {"levels deep"});
        row("another format", with("trapwright drive", "trapwright track"),
            {"\"format\"", "trapwright drive"});
        row("a later version", with("\"version\": 1", "\"version\": 2"), {"\"version\"", "1"});
        row("no name", with("\"name\": \"mine\",", ""), {"\"name\"", "missing", "add"});
        row("no title", with("\"title\": \"Mine\",", ""), {"\"title\"", "missing"});
        row("unknown protocol", with("modbus-tcp", "modbus"),
            {"\"protocol\"", "modbus-tcp", "modbus-rtu", "reo"});
        row("a slip of the pen", with("\"zero\"", "\"zreo\""), {"modbus.setPoint.zreo", "there are", "zero"});
        row("a text for a number", with("4095", "\"4095\""), {"modbus.setPoint.one", "no number"});
        row("an address beyond", with("10,", "70000,"), {"modbus.setPoint.holdingRegister", "65535"});
        row("an address below", with("10,", "-1,"), {"modbus.setPoint.holdingRegister", "whole number"});
        row("half an address", with("10,", "1.5,"), {"modbus.setPoint.holdingRegister"});
        row("a place to read only", with("holdingRegister", "inputRegister"),
            {"modbus.setPoint.inputRegister", "only be read", "coil"});
        row("no place", with("\"holdingRegister\": 10,", ""), {"modbus.setPoint", "name one place", "40011"});
        row("two places", with("\"holdingRegister\": 10,", "\"holdingRegister\": 10, \"coil\": 1,"),
            {"modbus.setPoint", "name one place"});
        row("no span", with("4095", "0"), {"modbus.setPoint.one", "100 %"});
        row("an unknown type", with("10,", "10, \"type\": \"uint8\","), {"modbus.setPoint.type", "uint16"});
        row("a bit register", with("10,", "10, \"type\": \"bit\","), {"modbus.setPoint.type", "registers"});
        row("beyond the end", with("10,", "65535, \"type\": \"float32\","),
            {"modbus.setPoint.type", "65535"});
        row("nothing to move",
            with("\"setPoint\": {\"holdingRegister\": 10, \"zero\": 0, \"one\": 4095}", ""),
            {"modbus.setPoint", "nothing", "add"});
        row("a time-out beyond", with("\"version\": 1,", "\"version\": 1, \"timeOut_s\": 30,"),
            {"timeOut_s", "not within", "2"});
        row("a watchdog that is too quick", with("\"version\": 1,", "\"version\": 1, \"watchdog_s\": 0.2,"),
            {"watchdog_s", "longer"});
        row("a bad write", with("\"setPoint\"", "\"atConnect\": [{\"coil\": 1}], \"setPoint\""),
            {"modbus.atConnect[0].value", "missing"});
        row("bad meanings",
            with("\"setPoint\"", "\"fault\": {\"coil\": 1, \"meanings\": {\"x\": 1}}, \"setPoint\""),
            {"modbus.fault.meanings.x", "0x57"});
    }
    void problemsSayWhatWhereAndWhatToDo() {
        QFETCH(QString, text);
        QFETCH(QStringList, parts);
        const auto profile = drive::readProfile(text.toStdString());
        QVERIFY(!profile.ok());
        const QString message = QString::fromStdString(profile.error().message);
        for (const QString& part : parts)
            QVERIFY2(message.contains(part), qPrintable(message));
    }

    void theSmallestOneIsGood() {
        const auto profile = drive::readProfile(kGood);
        QVERIFY2(profile.ok(), profile.ok() ? "" : profile.error().message.c_str());
        QCOMPARE(profile->modbus.setPoint.value().place.address, 10);
        const auto hexadecimal = drive::readProfile(with("10,", "\"0x1F\","));
        QCOMPARE(hexadecimal->modbus.setPoint.value().place.address, 31);
    }

    void usersAddAndReplace() {
        const QTemporaryDir own;
        const std::filesystem::path folder = own.path().toStdString();
        write(folder / "mine.json", kGood);
        write(folder / "other.json", kGood);
        write(folder / "broken.json", "{");
        write(folder / "adam-6024.json", with("\"mine\"", "\"adam-6024\""));
        write(folder / "notes.txt", "no profile");
        const drive::ProfileFolder all = drive::readAllProfiles(folder);
        QCOMPARE(all.profiles.size(), std::size_t(9));
        QCOMPARE(all.problems.size(), std::size_t(2));
        QVERIFY(all.problems[0].find("broken.json") != std::string::npos);
        QVERIFY(all.problems[1].find("other.json") != std::string::npos);
        for (const drive::Profile& profile : all.profiles) {
            if (profile.name == "adam-6024") QCOMPARE(profile.title, std::string("Mine"));
        }
        QCOMPARE(drive::readAllProfiles(folder / "missing").profiles.size(), std::size_t(8));
    }
};

QTEST_APPLESS_MAIN(ProfileTest)
#include "profile_test.moc"
