#include "experiment/pictures/picture_library.h"

#include <filesystem>

#include <dlfcn.h>
#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

const PictureLibrary& load() {
    // Beside the program, where the build and an installation have it.
    const std::filesystem::path file =
        (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "../lib/overt/overt_pictures.so")
            .lexically_normal();
    // Its symbols stay its own, and what it calls is looked up when it is called.
    void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    const auto library =
        module ? reinterpret_cast<const PictureLibrary* (*)()>(dlsym(module, "overt_picture_library"))
               : nullptr;
    if (!library)
        throw Error(fmt::format(
            "{}: this part of the program, which reads and writes pictures, cannot be loaded: {}. "
            "Build or install overt again.",
            file.string(), dlerror()));
    return *library();
}

} // namespace

const PictureLibrary& picture_library() {
    static const PictureLibrary& library = load();
    return library;
}

} // namespace overt
