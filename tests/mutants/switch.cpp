#include "tests/mutants/switch.h"

#include <cstdlib>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

// More than are ever drawn at once.
unsigned overt_mutants_count = 1u << 16u;
static unsigned char own_bytes[1u << 16u];
unsigned char* overt_mutants_reached = own_bytes;
unsigned overt_mutant_on = 0;

// Before all that a program does at its start.
__attribute__((constructor(101))) static void read_switches() {
    if (const char* const number = std::getenv("OVERT_MUTANT"))
        overt_mutant_on = static_cast<unsigned>(std::atoi(number));
    const char* const path = std::getenv("OVERT_MUTANTS_REACHED");
    if (path == nullptr)
        return;
    const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0)
        return;
    if (ftruncate(file, overt_mutants_count) == 0) {
        void* const bytes = mmap(nullptr, overt_mutants_count, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (bytes != MAP_FAILED)
            overt_mutants_reached = static_cast<unsigned char*>(bytes);
    }
    close(file);
}
