/// Libraries of the makers of devices, which come with no package and are loaded while the program runs: by a
/// name of theirs from where the system looks, or from the file that a variable of the environment names. An
/// option of the command line sets that variable. A protocol never says which: it may come from anybody.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace overt {

struct VendorLibrary {
    std::string_view name;                  ///< as --library NAME=FILE has it
    std::string_view what;                  ///< in words
    const char* variable;                   ///< of the environment
    std::array<const char*, 4> usual_names; ///< in the order in which they are tried; the last may be null
};

inline constexpr auto vendor_libraries = std::to_array<VendorLibrary>({
    {"eyelink", "the EyeLink's library", "OVERT_EYELINK_LIBRARY", {"libeyelink_core.so"}},
    {"tobii",
     "Tobii's library",
     "OVERT_TOBII_LIBRARY",
     {"libtobii_research.so.2", "libtobii_research.so.1", "libtobii_research.so"}},
    {"lsl",
     "the library of the Lab Streaming Layer",
     "OVERT_LSL_LIBRARY",
     {"liblsl.so.2", "liblsl.so", "liblsl.so.1", "liblsl64.so"}},
});

/// The library of that name, which must be one of them.
constexpr const VendorLibrary& vendor_library(std::string_view name) {
    for (const VendorLibrary& library : vendor_libraries)
        if (library.name == name)
            return library;
    throw "no vendor's library has that name";
}

} // namespace overt
