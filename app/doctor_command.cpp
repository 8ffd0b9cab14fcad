#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/statvfs.h>

#include "app/cache_folder.h"
#include "app/commands.h"

namespace overt {

namespace {

struct Line {
    std::string what, finding;
};

double free_gb(const std::filesystem::path& folder) {
    std::filesystem::path existing = folder;
    while (!existing.empty() && !std::filesystem::exists(existing))
        existing = existing.parent_path();
    std::error_code error;
    const auto space = std::filesystem::space(existing, error);
    return error ? 0.0 : static_cast<double>(space.available) / 1e9;
}

std::string realtime_priority() {
    rlimit limit{};
    if (getrlimit(RLIMIT_RTPRIO, &limit) != 0 || limit.rlim_cur == 0) {
        return "none allowed (set rtprio in /etc/security/limits.conf for real sessions)";
    }
    return limit.rlim_cur == RLIM_INFINITY ? "allowed without limit"
                                           : fmt::format("allowed up to {}", limit.rlim_cur);
}

std::vector<Line> examine() {
    std::vector<Line> lines;
    for (const ContextAttempt& attempt : survey_contexts())
        lines.push_back({fmt::format("OpenGL, {}", name_of(attempt.kind)), attempt.outcome});
    try {
        const auto context = make_headless_context(std::nullopt);
        lines.push_back({"headless sessions take", fmt::format("{}, {}", name_of(context->description().kind),
                                                               context->description().renderer)});
    } catch (const std::exception& error) {
        lines.push_back({"headless sessions", error.what()});
    }
    lines.push_back({"processors", fmt::format("{}", std::thread::hardware_concurrency())});
    lines.push_back({"real-time priority", realtime_priority()});
    lines.push_back({"free disk, here", fmt::format("{:.1f} GB", free_gb(std::filesystem::current_path()))});
    lines.push_back({"free disk, cache",
                     fmt::format("{:.1f} GB in {}", free_gb(cache_folder()), cache_folder().string())});
    return lines;
}

} // namespace

int run_doctor(const DoctorOptions& options) {
    const std::vector<Line> lines = examine();
    if (options.json) {
        auto json = nlohmann::ordered_json::array();
        for (const Line& line : lines)
            json.push_back({{"what", line.what}, {"finding", line.finding}});
        fmt::print("{}\n", nlohmann::ordered_json{{"doctor", json}}.dump(2));
        return 0;
    }
    for (const Line& line : lines)
        fmt::print("{:<24} {}\n", line.what, line.finding);
    return 0;
}

} // namespace overt
