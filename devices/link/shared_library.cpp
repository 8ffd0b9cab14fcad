#include "devices/link/shared_library.h"

#include <cstdlib>

#include <dlfcn.h>
#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

std::vector<std::string> library_candidates(const std::string& setting, const char* variable,
                                            const std::vector<std::string>& usual_names) {
    if (!setting.empty())
        return {setting};
    if (const char* const named = std::getenv(variable); named && *named)
        return {named};
    return usual_names;
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
