#include "core/workflow/part_process.h"

int main(int argc, char** argv) {
    return trapwright::workflow::serveImport(argc, argv);
}
