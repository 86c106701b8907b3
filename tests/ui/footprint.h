#pragma once

#include <dirent.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>

namespace trapwright::tests {

/// What a program may lose bit by bit.
struct Footprint {
    double resident = 0.0;  // [MiB]
    double used = 0.0;      // of the heap [MiB]
    int threads = 0;
    int files = 0;
};

inline int countEntries(const char* folder) {
    DIR* list = ::opendir(folder);
    int count = 0;
    while (list != nullptr && ::readdir(list) != nullptr)
        ++count;
    if (list != nullptr) ::closedir(list);
    return count - 2;
}

inline Footprint measureFootprint() {
    double all = 0.0;
    double resident = 0.0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    const struct mallinfo2 heap = ::mallinfo2();
    constexpr double kMebi = 1024.0 * 1024.0;
    return {resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMebi,
            static_cast<double>(heap.uordblks + heap.hblkhd) / kMebi, countEntries("/proc/self/task"),
            // The folder that is read is open itself.
            countEntries("/proc/self/fd") - 1};
}

}  // namespace trapwright::tests
