/// Sizes of files and of memory in sentences.
#pragma once

#include <string>

#include <fmt/format.h>

namespace overt {

/// In megabytes of 1e6 bytes, two digits below ten; from a thousand on in gigabytes.
inline std::string in_bytes(double bytes) {
    return bytes < 9.5e6 ? fmt::format("{:.2g} MB", bytes / 1e6)
           : bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6)
                         : fmt::format("{:.1f} GB", bytes / 1e9);
}

} // namespace overt
