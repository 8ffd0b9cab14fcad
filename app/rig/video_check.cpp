#include "app/rig/video_check.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/cli/own_folders.h"
#include "experiment/base/error.h"
#include "experiment/base/folder_lock.h"
#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"

namespace overt {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const VideoCheck& check) {
    const VideoPath& path = check.path;
    return {{"product", path.product},
            {"serial_number", path.serial_number},
            {"graphics", path.graphics},
            {"driver", path.driver},
            {"output", path.output},
            {"width_px", path.width_px},
            {"height_px", path.height_px},
            {"refresh_hz", path.refresh_hz},
            {"checked_utc", check.checked_utc},
            {"passed", check.passed},
            {"verdict", check.verdict}};
}

/// Throws what the library throws for what is not there or is something else.
VideoCheck check_from(const Json& json) {
    const auto text = [&](const char* name) { return json.at(name).get<std::string>(); };
    const auto number = [&](const char* name) { return json.at(name).get<int>(); };
    return {{text("product"), text("serial_number"), text("graphics"), text("driver"), text("output"),
             number("width_px"), number("height_px"), json.at("refresh_hz").get<double>()},
            text("checked_utc"),
            json.at("passed").get<bool>(),
            text("verdict")};
}

/// Of "2026-11-23T20:06:10Z" the day; nothing of what is no date.
std::optional<std::chrono::sys_days> day_of(const std::string& utc) {
    const auto part = [&](std::size_t from, std::size_t length) {
        int number = -1;
        if (from + length <= utc.size())
            std::from_chars(utc.data() + from, utc.data() + from + length, number);
        return number;
    };
    const std::chrono::year_month_day date(std::chrono::year(part(0, 4)),
                                           std::chrono::month(static_cast<unsigned>(part(5, 2))),
                                           std::chrono::day(static_cast<unsigned>(part(8, 2))));
    return date.ok() ? std::optional(std::chrono::sys_days(date)) : std::nullopt;
}

/// What has changed since a check of another path.
std::string differences(const VideoPath& then, const VideoPath& now) {
    std::vector<std::string> changed;
    const auto compare = [&](const char* what, const auto& before, const auto& after) {
        if (before != after)
            changed.push_back(fmt::format("{} was {}, is {}", what, before, after));
    };
    compare("the box", then.product + " " + then.serial_number, now.product + " " + now.serial_number);
    compare("the graphics card", then.graphics, now.graphics);
    compare("the driver", then.driver, now.driver);
    compare("the output", then.output, now.output);
    const auto mode = [](const VideoPath& path) {
        return fmt::format("{} x {} at {} Hz", path.width_px, path.height_px, path.refresh_hz);
    };
    compare("the mode", mode(then), mode(now));
    return fmt::format("{}", fmt::join(changed, "; "));
}

/// Why there is nothing to go by.
std::string what_is_missing(const std::vector<VideoCheck>& checks, const VideoPath& path) {
    const auto of_box = std::ranges::find_if(
        checks, [&](const VideoCheck& check) { return check.path.serial_number == path.serial_number; });
    if (of_box == checks.end())
        return fmt::format("it was never checked with the box {}", path.serial_number);
    return fmt::format("it was checked on {}, and since then {}", of_box->checked_utc,
                       differences(of_box->path, path));
}

} // namespace

VideoPath video_path(const BoxIdentity& box, const GlDescription& graphics, const MonitorInfo& monitor) {
    return {
        box.product,  box.serial_number, graphics.renderer, graphics.version,
        monitor.name, monitor.size_px.x, monitor.size_px.y, std::round(100.0 * monitor.refresh_hz) / 100.0};
}

std::filesystem::path video_check_file() { return state_folder() / "video_checks.json"; }

std::vector<VideoCheck> read_video_checks(const std::filesystem::path& file) {
    std::error_code unknown;
    if (!std::filesystem::exists(file, unknown))
        return {};
    const Json json = parse_json(read_whole_file(file));
    try {
        std::vector<VideoCheck> checks;
        if (!json.is_array())
            throw Error("no list");
        for (const Json& check : json)
            checks.push_back(check_from(check));
        return checks;
    } catch (const std::exception&) {
        throw InputError(fmt::format("{}: is no list of checks as overt display verify --hardware keeps it: "
                                     "delete it, and check again",
                                     file.string()));
    }
}

void keep_video_check(const std::filesystem::path& file, const VideoCheck& check) {
    std::vector<VideoCheck> checks = read_video_checks(file);
    std::erase_if(checks, [&](const VideoCheck& one) { return one.path == check.path; });
    checks.insert(checks.begin(), check);
    Json json = Json::array();
    for (const VideoCheck& one : checks)
        json.push_back(json_of(one));
    std::filesystem::create_directories(file.parent_path());
    write_whole_file(file, json_text(json));
}

ScreenFinding require_video_check(const std::vector<VideoCheck>& checks, const VideoPath& path, int days,
                                  const std::string& now_utc) {
    constexpr const char* what = "bytes at the box";
    if (days == 0)
        return {ScreenFinding::Weight::risk, what,
                "not checked, as the protocol says ([display] video_check_days = 0)"};
    const auto refuse = [&](const std::string& why) {
        throw InputError(fmt::format(
            "nothing proves that the display box receives the bytes that are drawn: {}.\nRun `overt display "
            "verify --hardware`, which takes a minute; or write video_check_days = 0 under [display], and "
            "the record says that it was not checked. Nothing was recorded.",
            why));
    };
    const auto found =
        std::ranges::find_if(checks, [&](const VideoCheck& check) { return check.path == path; });
    if (found == checks.end())
        refuse(what_is_missing(checks, path));
    if (!found->passed)
        refuse(fmt::format("the check of {} failed: {}", found->checked_utc, found->verdict));
    const auto then = day_of(found->checked_utc), now = day_of(now_utc);
    if (!then || !now || *now - *then > std::chrono::days(days))
        refuse(fmt::format("the last check is of {}, and the protocol wants one of the last {} days "
                           "([display] video_check_days)",
                           found->checked_utc, days));
    return {ScreenFinding::Weight::good, what,
            fmt::format("as drawn: checked on {} with {}, {}, output {}", found->checked_utc, path.graphics,
                        path.driver, path.output)};
}

} // namespace overt
