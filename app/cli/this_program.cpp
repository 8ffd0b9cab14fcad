#include "app/cli/this_program.h"

#include <ctime>

#include <fmt/chrono.h>

#include "build_info.h"

namespace overt {

ProgramBuild this_build() { return {build::version, build::compiler, build::flags, build::commit}; }

std::string version_text() {
    return fmt::format("overt {}\ncommit     {}\nbuild      {}\ncompiler   {}\nflags      {}\nlibraries  {}",
                       build::version, *build::commit ? build::commit : "not known",
                       *build::type ? build::type : "no type", build::compiler, build::flags,
                       build::libraries);
}

SessionManifest::Program this_program() {
    static const ContentHash sha256 = hash_of_file("/proc/self/exe");
    return {"overt", build::version, sha256};
}

std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

} // namespace overt
