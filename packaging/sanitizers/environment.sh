# shellcheck shell=bash
# Sourced: what clang's sanitizers are told, whatever they run in.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

export ASAN_OPTIONS="detect_leaks=1:allocator_may_return_null=1:${ASAN_OPTIONS:-}"
export LSAN_OPTIONS="suppressions=$here/leaks.txt:print_suppressions=0:${LSAN_OPTIONS:-}"
export TSAN_OPTIONS="suppressions=$here/threads.txt:second_deadlock_stack=1:${TSAN_OPTIONS:-}"
export UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
for variable in ASAN LSAN TSAN UBSAN; do
    export "${variable}_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-14"
done
export QTEST_FUNCTION_TIMEOUT=3600000  # [ms] of one test function, which is 5 minutes in Qt Test
