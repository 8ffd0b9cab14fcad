#include "devices/lsl/lsl_stream_search.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

using Streams = std::vector<LslOwned<LslStreamInfo>>;

/// liblsl advises to look for a second or two.
constexpr SessionDuration looking_time = std::chrono::seconds(2);
constexpr std::int32_t most_streams = 256;

std::string told(const char* text) { return text ? text : ""; }

/// A property that a stream may be told by: what an experimenter calls it, and what liblsl does.
struct Property {
    std::string_view word, property;
    std::string LslStreamChoice::*value;
    const char* (*LslLibrary::*get)(LslStreamInfo*);
};
// The one that tells most comes first: by that it is looked for.
constexpr Property properties[] = {
    {"uid", "uid", &LslStreamChoice::uid, &LslLibrary::get_uid},
    {"source_id", "source_id", &LslStreamChoice::source_id, &LslLibrary::get_source_id},
    {"name", "name", &LslStreamChoice::name, &LslLibrary::get_name},
    {"host", "hostname", &LslStreamChoice::host, &LslLibrary::get_hostname},
    {"type", "type", &LslStreamChoice::type, &LslLibrary::get_type},
};

std::string_view without_blanks(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
    text.remove_prefix(begin);
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

std::string in_words(const LslStreamChoice& choice) {
    if (choice.is_open())
        return "type Gaze (or EyeTracking, Eyetracker, ET)";
    std::vector<std::string> words;
    for (const Property& each : properties)
        if (!(choice.*each.value).empty())
            words.push_back(fmt::format("{} \"{}\"", each.word, choice.*each.value));
    return fmt::format("{}", fmt::join(words, " and "));
}

bool is_meant(const LslLibrary& library, LslStreamInfo* stream, const LslStreamChoice& choice) {
    if (choice.is_open())
        return is_lsl_type_of_gaze(told(library.get_type(stream)));
    return std::ranges::all_of(properties, [&](const Property& each) {
        const std::string& wanted = choice.*each.value;
        return wanted.empty() || told((library.*each.get)(stream)) == wanted;
    });
}

/// Adds the streams that are new.
void look_once(const LslLibrary& library, const LslStreamChoice& choice, SessionDuration time,
               Streams& streams) {
    std::array<LslStreamInfo*, std::size_t{most_streams}> found{};
    const auto room = static_cast<std::uint32_t>(found.size());
    std::int32_t count = 0;
    if (choice.is_open()) {
        count = library.resolve_all(found.data(), room, to_seconds(time));
    } else {
        const auto is_told = [&](const Property& each) { return !(choice.*each.value).empty(); };
        const auto by = std::ranges::find_if(properties, is_told);
        // A second one is waited for, to see that there is one only; a uid is no other stream's. Where more
        // is told than it is looked for by, any number of others may answer first.
        const std::int32_t awaited = !choice.uid.empty()                              ? 1
                                     : std::ranges::count_if(properties, is_told) > 1 ? most_streams
                                                                                      : 2;
        count = library.resolve_byprop(found.data(), room, std::string(by->property).c_str(),
                                       (choice.*by->value).c_str(), awaited, to_seconds(time));
    }
    for (std::int32_t i = 0; i < count; ++i) {
        LslOwned<LslStreamInfo> stream(found[static_cast<std::size_t>(i)], LslRelease{&library});
        const std::string uid = told(library.get_uid(stream.get()));
        // One that has two addresses may come twice.
        const bool is_known = std::ranges::any_of(
            streams, [&](const auto& each) { return told(library.get_uid(each.get())) == uid; });
        if (!is_known && is_meant(library, stream.get(), choice))
            streams.push_back(std::move(stream));
    }
}

std::string list_of(const LslLibrary& library, const Streams& streams) {
    std::string list;
    for (const LslOwned<LslStreamInfo>& stream : streams) {
        const auto value = [&](const char* (*get)(LslStreamInfo*)) { return told(get(stream.get())); };
        const std::string source = value(library.get_source_id);
        list += fmt::format("\n  \"{}\" of type {} on {}, source_id={}, uid={}", value(library.get_name),
                            value(library.get_type), value(library.get_hostname),
                            source.empty() ? "(none)" : source, value(library.get_uid));
    }
    return list;
}

} // namespace

LslStreamChoice parse_lsl_choice(std::string_view address) {
    LslStreamChoice choice;
    if (address.find('=') == std::string_view::npos) {
        choice.name = address;
        return choice;
    }
    for (std::string_view rest = address; !without_blanks(rest).empty();) {
        const std::string_view part = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(part.size() + 1, rest.size()));
        const std::size_t equals = part.find('=');
        const std::string_view word = without_blanks(part.substr(0, equals));
        const auto known = std::ranges::find(properties, word, &Property::word);
        if (known == std::end(properties) || equals == std::string_view::npos)
            throw InputError(
                fmt::format("\"{}\" does not say which stream: write its name, or what tells it, "
                            "such as \"source_id=…, host=…\"; words are uid, source_id, name, host "
                            "and type (a name with an equals sign: name=…)",
                            address));
        choice.*known->value = without_blanks(part.substr(equals + 1));
    }
    return choice;
}

bool is_lsl_type_of_gaze(std::string_view type) {
    std::string letters;
    for (const char each : type)
        if (std::isalpha(static_cast<unsigned char>(each)) != 0)
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
    constexpr std::string_view of_gaze[] = {"gaze", "eyegaze", "eyetracking", "eyetracker", "et"};
    return std::ranges::find(of_gaze, letters) != std::end(of_gaze);
}

LslOwned<LslStreamInfo> find_lsl_stream(const LslLibrary& library, const LslStreamChoice& choice,
                                        SessionDuration patience) {
    Streams streams;
    for (SessionDuration left = patience; streams.empty() && left > SessionDuration::zero();) {
        const SessionDuration time = std::min(left, looking_time);
        look_once(library, choice, time, streams);
        left -= time;
    }
    // A question or an answer of these packets may be lost: of two streams on a busy machine, one look in
    // eight found only one (two programs with liblsl 1.17 on a machine of 2 cores).
    if (streams.size() == 1 && choice.uid.empty())
        look_once(library, choice, looking_time, streams);
    if (streams.empty())
        throw DeviceError(fmt::format(
            "No stream of {} is on the network; start the tracker's program and its output to the "
            "Lab Streaming Layer, and let UDP port 16571 through the firewalls.",
            in_words(choice)));
    if (streams.size() > 1)
        throw DeviceError(
            fmt::format("{} streams could be meant:{}\nSay which with what tells it apart, such "
                        "as address = \"source_id=…\" or \"uid=…\".",
                        streams.size(), list_of(library, streams)));
    return std::move(streams.front());
}

} // namespace overt
