#include "devices/lsl/lsl_library.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

LslLibrary::LslLibrary(const SharedLibrary& library) : file_(library.file()) {
    std::vector<std::string> missing;
    const auto require = [&](auto*& function, const char* name) { library.require(function, name, missing); };
    require(local_clock, "lsl_local_clock");
    require(resolve_byprop, "lsl_resolve_byprop");
    require(resolve_all, "lsl_resolve_all");
    require(create_streaminfo, "lsl_create_streaminfo");
    require(destroy_streaminfo, "lsl_destroy_streaminfo");
    require(get_name, "lsl_get_name");
    require(get_type, "lsl_get_type");
    require(get_source_id, "lsl_get_source_id");
    require(get_hostname, "lsl_get_hostname");
    require(get_uid, "lsl_get_uid");
    require(get_channel_count, "lsl_get_channel_count");
    require(get_channel_format, "lsl_get_channel_format");
    require(get_nominal_srate, "lsl_get_nominal_srate");
    require(get_desc, "lsl_get_desc");
    require(child, "lsl_child");
    require(next_sibling_n, "lsl_next_sibling_n");
    require(empty, "lsl_empty");
    require(child_value_n, "lsl_child_value_n");
    require(append_child, "lsl_append_child");
    require(append_child_value, "lsl_append_child_value");
    require(create_inlet, "lsl_create_inlet");
    require(destroy_inlet, "lsl_destroy_inlet");
    require(get_fullinfo, "lsl_get_fullinfo");
    require(open_stream, "lsl_open_stream");
    require(pull_sample_d, "lsl_pull_sample_d");
    require(time_correction, "lsl_time_correction");
    require(create_outlet, "lsl_create_outlet");
    require(destroy_outlet, "lsl_destroy_outlet");
    require(push_sample_strtp, "lsl_push_sample_strtp");
    require(push_sample_dtp, "lsl_push_sample_dtp");
    library.find(library_version, "lsl_library_version");
    library.find(time_correction_ex, "lsl_time_correction_ex");
    if (!missing.empty())
        throw DeviceError(
            fmt::format("{} is no liblsl that can be used: it lacks {}; install version 1.13 or "
                        "later (https://github.com/sccn/liblsl/releases).",
                        file_, fmt::join(missing, ", ")));
}

std::shared_ptr<const LslLibrary> load_lsl(const std::string& file) {
    const SharedLibrary library(
        library_candidates(file, vendor_library("lsl")), "The library of the Lab Streaming Layer (liblsl)",
        "Install it (https://github.com/sccn/liblsl/releases has a package for Debian), or name its file "
        "with --library lsl=FILE or in the environment variable OVERT_LSL_LIBRARY.");
    return std::make_shared<const LslLibrary>(library);
}

} // namespace overt
