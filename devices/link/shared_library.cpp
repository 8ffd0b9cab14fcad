#include "devices/link/shared_library.h"

#include <cstdlib>

#include <dlfcn.h>
#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

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
            return;
        }
        const char* const reason = dlerror();
        reasons += fmt::format("{}{}", reasons.empty() ? "" : "; ", reason ? reason : candidate.c_str());
    }
    throw DeviceError(fmt::format("{} cannot be loaded: {}. {}", what, reasons, remedy));
}

void* SharedLibrary::address_of(const char* name) const noexcept { return dlsym(handle_, name); }

} // namespace overt
