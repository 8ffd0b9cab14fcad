#include "app/session/recorded_options.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

constexpr std::pair<MapTime, std::string_view> names_of_map_times[] = {
    {MapTime::automatic, "auto"}, {MapTime::live, "live"}, {MapTime::prepared, "prepared"}};

[[noreturn]] void refuse(const RecordedOption& option) {
    throw RecordError(fmt::format(
        "table run_option: this version of the program knows no option --{} with the value \"{}\": take "
        "the version that recorded the session (`overt show` names it), or a newer one",
        option.name, option.value));
}

template <class Number> Number number_of(const RecordedOption& option) {
    Number number{};
    const char* const end = option.value.data() + option.value.size();
    const auto [rest, error] = std::from_chars(option.value.data(), end, number);
    if (error != std::errc() || rest != end)
        refuse(option);
    return number;
}

fs::path way_to(const fs::path& file, const fs::path& folder) {
    std::error_code unknown;
    const fs::path way = fs::relative(fs::absolute(file), fs::absolute(folder), unknown);
    return unknown || way.empty() ? file.filename() : way;
}

} // namespace

std::vector<RecordedOption> recorded_options(const RunOptions& options, const fs::path& session_folder) {
    std::vector<RecordedOption> recorded{{"protocol", way_to(options.protocol, session_folder).string()}};
    const auto add = [&](const char* name, std::string value = {}) {
        recorded.push_back({name, std::move(value)});
    };
    if (options.simulate_observer)
        add("simulate-observer", std::to_string(*options.simulate_observer));
    for (const std::string& key : options.operator_keys)
        add("simulate-operator", key);
    if (!options.tracker.empty())
        add("tracker", options.tracker);
    if (!options.tracker_address.empty())
        add("tracker-address", options.tracker_address);
    if (options.virtual_time)
        add("virtual-time");
    if (!options.draws_stimuli)
        add("no-pictures");
    if (options.trials)
        add("trials", std::to_string(*options.trials));
    for (const auto& [time, name] : names_of_map_times)
        if (time == options.maps)
            add("maps", std::string(name));
    if (options.verify_output)
        add("verify-output");
    if (options.quality)
        add("quality", std::string(name_of(*options.quality)));
    return recorded;
}

void take_recorded_options(const std::vector<RecordedOption>& recorded, RunOptions& options) {
    options.draws_stimuli = true;
    for (const RecordedOption& option : recorded) {
        const std::string& name = option.name;
        if (name == "protocol")
            continue; // where its file lies is for the caller to find
        if (name == "simulate-observer")
            options.simulate_observer = number_of<std::uint64_t>(option);
        else if (name == "simulate-operator")
            options.operator_keys.push_back(option.value);
        else if (name == "tracker")
            options.tracker = option.value;
        else if (name == "tracker-address")
            options.tracker_address = option.value;
        else if (name == "virtual-time")
            options.virtual_time = true;
        else if (name == "no-pictures")
            options.draws_stimuli = false;
        else if (name == "trials")
            options.trials = number_of<int>(option);
        else if (name == "verify-output")
            options.verify_output = true;
        else if (name == "maps") {
            const auto* const time =
                std::find_if(std::begin(names_of_map_times), std::end(names_of_map_times),
                             [&](const auto& entry) { return entry.second == option.value; });
            if (time == std::end(names_of_map_times))
                refuse(option);
            options.maps = time->first;
        } else if (name == "quality") {
            const auto& names = names_of<BakeQuality>;
            const auto found = std::find(names.begin(), names.end(), option.value);
            if (found == names.end())
                refuse(option);
            options.quality = static_cast<BakeQuality>(found - names.begin());
        } else {
            refuse(option);
        }
    }
}

const std::string* recorded_value(const std::vector<RecordedOption>& recorded, std::string_view name) {
    const auto found = std::find_if(recorded.begin(), recorded.end(),
                                    [&](const RecordedOption& option) { return option.name == name; });
    return found == recorded.end() ? nullptr : &found->value;
}

} // namespace overt
