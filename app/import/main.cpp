#include "core/work/part_process.h"

int main(int argc, char** argv) {
    return trapwright::work::serveImport(argc, argv);
}
