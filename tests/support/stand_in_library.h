/// A stand-in for a vendor's library, as tests steer it.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <dlfcn.h>

namespace overt::test {

/// One of the stand-in libraries, as new. Its state is common to all who load it.
class StandInLibrary {
  public:
    explicit StandInLibrary(std::string file) : path(std::move(file)) {
        library_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library_)
            throw std::runtime_error(dlerror());
        function<void()>("stand_in_reset")();
    }
    StandInLibrary(const StandInLibrary&) = delete;
    StandInLibrary& operator=(const StandInLibrary&) = delete;
    ~StandInLibrary() { dlclose(library_); }

    void set(const char* name, double value) {
        function<void(const char*, double)>("stand_in_set")(name, value);
    }
    void tell(const char* name, const char* text) {
        function<void(const char*, const char*)>("stand_in_tell")(name, text);
    }
    /// All that was said to it, in its order.
    std::vector<std::string> said() const {
        std::vector<std::string> all;
        const auto at = function<const char*(int)>("stand_in_said");
        for (int i = 0; const char* text = at(i); ++i)
            all.emplace_back(text);
        return all;
    }
    /// What one of its functions for tests says.
    int ask(const char* name) const { return function<int()>(name)(); }
    bool heard(const std::string& text) const {
        const auto all = said();
        return std::ranges::find(all, text) != all.end();
    }

    std::string path;

  private:
    template <class Signature> Signature* function(const char* name) const {
        return reinterpret_cast<Signature*>(dlsym(library_, name));
    }
    void* library_ = nullptr;
};

} // namespace overt::test
