#include "experiment/base/error.h"

#include <cstdio>
#include <cstdlib>

namespace overt {

void broken_promise(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "overt: internal error: %s:%d: expected %s\n", file, line, condition);
    std::abort();
}

} // namespace overt
