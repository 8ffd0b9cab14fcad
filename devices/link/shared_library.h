/// A vendor's library that is loaded while the program runs, since it comes with no package: the program is
/// built, and runs, without it.
#pragma once

#include <string>
#include <vector>

#include "experiment/ports/vendor_libraries.h"

namespace overt {

/// Which files to try for a library: `file` alone, if it is named; else what the library's variable of the
/// environment names alone, if it is set; else its usual names, which the system's search path finds.
std::vector<std::string> library_candidates(const std::string& file, const VendorLibrary& library);

/// The files of all that SharedLibrary has loaded, as the system names them. From any thread.
std::vector<std::string> loaded_vendor_libraries();

/// Stays loaded until the program ends: such libraries have threads of their own, which an unloading would
/// leave without code.
class SharedLibrary {
  public:
    /// Opens the first candidate that can be. Throws DeviceError if none can: `what` names the library,
    /// `remedy` says how to get it ("install …"), and the system's reason for each candidate is told.
    SharedLibrary(const std::vector<std::string>& candidates, const std::string& what,
                  const std::string& remedy);

    /// Where it was found, as it was named.
    const std::string& file() const noexcept { return file_; }

    /// The function of that name, or nothing.
    template <class Function> void find(Function*& function, const char* name) const noexcept {
        function = reinterpret_cast<Function*>(address_of(name));
    }
    /// As find(); a name that is not there is added to `missing`.
    template <class Function>
    void require(Function*& function, const char* name, std::vector<std::string>& missing) const {
        find(function, name);
        if (!function)
            missing.emplace_back(name);
    }

  private:
    void* address_of(const char* name) const noexcept;

    std::string file_;
    void* handle_ = nullptr;
};

} // namespace overt
