/// Memory that does not suffice for a file, said with the file's name.
#pragma once

#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

/// Gives what `read()` gives. Throws Error that names the file if memory runs out in it; InputError of an
/// inner file passes.
template <class Read> auto with_memory_for(const std::filesystem::path& file, Read&& read) {
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw Error(fmt::format(
            "{}: the memory of this machine does not suffice to read it: close other programs, or make "
            "it smaller",
            file.string()));
    }
}

} // namespace overt
