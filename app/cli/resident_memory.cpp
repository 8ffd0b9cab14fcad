#include "app/cli/resident_memory.h"

#include <fstream>

#include <malloc.h>
#include <unistd.h>

namespace overt {

double resident_memory_mb() {
    ::malloc_trim(0);
    std::ifstream file("/proc/self/statm");
    double all_pages = 0.0, resident_pages = 0.0;
    file >> all_pages >> resident_pages;
    return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

} // namespace overt
