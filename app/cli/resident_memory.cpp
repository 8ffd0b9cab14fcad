#include "app/cli/resident_memory.h"

#include <fstream>
#include <string>

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

double peak_memory_mb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word != "VmHWM:")
            continue;
        double kilobytes = 0.0;
        status >> kilobytes;
        return 1.024e-3 * kilobytes;
    }
    return 0.0;
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

} // namespace overt
