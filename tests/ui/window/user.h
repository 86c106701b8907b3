#pragma once

#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QSettings>
#include <QTemporaryDir>
#include <QtTest>

#include "core/part/bundled.h"
#include "tests/ui/window/window_user.h"
#include "ui/pages/page.h"

/// What the tests of the window share.
namespace trapwright::tests {

inline constexpr int kPatience = 20000;  // [ms] for what happens in the background, on a busy machine

inline std::filesystem::path bundled(const char* name) {
    return part::findBundledFile(part::findBundledPart(name).value());
}

/// Settings and drafts of a test go to a folder of its own.
inline void useFolder(const QTemporaryDir& folder, const QString& program) {
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder.path());
    qputenv("XDG_DATA_HOME", folder.filePath("data").toLocal8Bit());
    QCoreApplication::setOrganizationName("Trapwright");
    QCoreApplication::setApplicationName(program);
}

/// The window, which has no engine, and what a user does in it.
struct User : WindowUser {
    User() : WindowUser({trial::EngineRegistry(), "trapwright test", {}}) {}

    bool import(const char* name) {
        window.openFile(bundled(name));
        return QTest::qWaitFor([&] { return session() != nullptr; }, kPatience);
    }
    bool show(const QString& page) {
        window.showPage(page);
        return QTest::qWaitFor([&] { return find<pages::Page>("page." + page)->isVisible(); });
    }
    /// From a list, as people read it.
    void choose(const QString& field, const QString& text) {
        auto* list = find<QComboBox>("field." + field);
        const int at = list->findText(text);
        QVERIFY2(at >= 0, qPrintable(text));
        list->setCurrentIndex(at);
        emit list->activated(at);
    }
    void type(const QString& field, const QString& text) {
        auto* edit = find<QLineEdit>("field." + field);
        edit->setFocus();
        edit->selectAll();
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
    }
};

}  // namespace trapwright::tests
