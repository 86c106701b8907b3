// A child program that does what its request says: what foreign libraries do to programs on bad days.

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include "core/base/child_process.h"

namespace {

// Not to be turned into a loop.
int (*volatile next)(int) = nullptr;

int descend(int depth) {
    std::array<char, 4096> room{};
    room[static_cast<std::size_t>(depth) % room.size()] = 1;
    return next(depth + 1) + room[static_cast<std::size_t>(depth * 7) % room.size()];
}

}  // namespace

int main(int count, char** arguments) {
    const auto duty = trapwright::base::ChildDuty::begin(count, arguments);
    if (!duty) return 2;
    const std::string& request = duty->request();
    duty->tellStage("waking up");
    duty->tellStage(request.substr(0, 20));
    if (request == "abort") std::abort();
    if (request == "segfault") std::raise(SIGSEGV);
    if (request == "exit") std::exit(0);
    if (request == "stack") {
        next = descend;
        return next(0);
    }
    if (request == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
    if (request == "spin") {
        for (std::atomic<int> i = 0;; ++i) {
        }
    }
    if (request == "memory") {
        std::vector<void*> blocks;
        while (true) {
            blocks.push_back(::operator new(16U << 20U));
            std::memset(blocks.back(), 1, 16U << 20U);
        }
    }
    if (request == "chatter") {
        for (int i = 0; i < 100000; ++i) {
            std::puts("chatter");
            std::fputs("chatter\n", stderr);
        }
    }
    if (request == "nonsense") {
        for (int i = 0; i < 100; ++i)
            (void)!::write(3, "nonsense", 8);
        return 0;
    }
    if (request == "flood") {
        while (true)
            duty->tellStage(std::string(1U << 20U, 'x'));
    }
    if (request == "half") {
        (void)!::write(3, "r\x40\0\0\0\0\0\0\0half", 13);
        return 0;
    }
    if (request == "open files") {
        for (int i = 4; i < 200; ++i)
            if (::lseek(i, 0, SEEK_CUR) != -1) std::abort();
    }
    if (request == "process") return duty->answer(std::to_string(::getpid())) ? (::sleep(3600), 0) : 1;
    return duty->answer("answer to " + request) ? 0 : 1;
}
