#include "app/session/recorded_options.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const RecordedOption& option) {
    throw RecordError(fmt::format(
        "table run_option: this version of the program knows no option --{} with the value \"{}\": take "
        "the version that recorded the session (`overt show` names it), or a newer one",
        option.name, option.value));
}

template <class Number> Number number_of(const RecordedOption& option) {
    const auto number = number_in<Number>(option.value);
    if (!number)
        refuse(option);
    return *number;
}

template <NamedEnum Enum> Enum one_called(const RecordedOption& option) {
    const auto found = std::ranges::find(names_of<Enum>, option.value);
    if (found == names_of<Enum>.end())
        refuse(option);
    return static_cast<Enum>(found - names_of<Enum>.begin());
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
        add("address", options.tracker_address);
    if (options.virtual_time)
        add("virtual-time");
    if (!options.draws_stimuli)
        add("no-pictures");
    if (options.trials)
        add("trials", std::to_string(*options.trials));
    add("maps", std::string(name_of(options.maps)));
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
        else if (name == "address" || name == "tracker-address") // as earlier programs call it
            options.tracker_address = option.value;
        else if (name == "virtual-time")
            options.virtual_time = true;
        else if (name == "no-pictures")
            options.draws_stimuli = false;
        else if (name == "trials")
            options.trials = number_of<int>(option);
        else if (name == "verify-output")
            options.verify_output = true;
        else if (name == "maps")
            options.maps = one_called<MapTime>(option);
        else if (name == "quality")
            options.quality = one_called<BakeQuality>(option);
        else
            refuse(option);
    }
}

const std::string* recorded_value(const std::vector<RecordedOption>& recorded, std::string_view name) {
    const auto found = std::ranges::find(recorded, name, &RecordedOption::name);
    return found == recorded.end() ? nullptr : &found->value;
}

} // namespace overt
