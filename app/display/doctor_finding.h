/// What the doctor says of one thing.
#pragma once

#include <string>

namespace overt {

struct DoctorFinding {
    std::string what, finding;
    std::string remedy = {}; ///< a command or sentence that mends it; empty: nothing is missing
};

} // namespace overt
