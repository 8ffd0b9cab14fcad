#include "devices/link/shared_library.h"

#include <cstdlib>
#include <filesystem>
#include <mutex>

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

std::mutex loaded_mutex;
std::vector<std::string> loaded; ///< for as long as the program runs, as the libraries are

void note_loaded(void* handle) {
    link_map* entry = nullptr;
    if (dlinfo(handle, RTLD_DI_LINKMAP, &entry) != 0)
        return;
    std::error_code unknown;
    const std::filesystem::path file = std::filesystem::canonical(entry->l_name, unknown);
    const std::scoped_lock lock(loaded_mutex);
    loaded.push_back(unknown ? std::string(entry->l_name) : file.string());
}

} // namespace

std::vector<std::string> loaded_vendor_libraries() {
    const std::scoped_lock lock(loaded_mutex);
    return loaded;
}

std::vector<std::string> library_candidates(const std::string& file, const VendorLibrary& library) {
    if (!file.empty())
        return {file};
    if (const char* const named = std::getenv(library.variable); named && *named)
        return {named};
    std::vector<std::string> names;
    for (const char* const name : library.usual_names)
        if (name)
            names.emplace_back(name);
    return names;
}

SharedLibrary::SharedLibrary(const std::vector<std::string>& candidates, const std::string& what,
                             const std::string& remedy) {
    std::string reasons;
    for (const std::string& candidate : candidates) {
        // Its symbols stay its own.
        handle_ = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle_) {
            file_ = candidate;
            note_loaded(handle_);
            return;
        }
        const char* const reason = dlerror();
        reasons += fmt::format("{}{}", reasons.empty() ? "" : "; ", reason ? reason : candidate.c_str());
    }
    throw DeviceError(fmt::format("{} cannot be loaded: {}. {}", what, reasons, remedy));
}

void* SharedLibrary::address_of(const char* name) const noexcept { return dlsym(handle_, name); }

} // namespace overt
