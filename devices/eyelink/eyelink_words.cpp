#include "devices/eyelink/eyelink_words.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

// The host's names have eight letters and digits.
constexpr std::size_t letters_of_whom = 2, digits_of_time = 6;
constexpr std::string_view base_36 = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// The number that follows a word, wherever the word stands.
std::optional<double> number_after(std::string_view text, std::string_view word) {
    const std::size_t at = text.find(word);
    if (at == std::string_view::npos)
        return std::nullopt;
    text.remove_prefix(at + word.size());
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    double number = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    return read.ec == std::errc{} && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// The number that stands before a word.
std::optional<double> number_before(std::string_view text, std::string_view word) {
    const std::size_t at = text.find(word);
    if (at == std::string_view::npos)
        return std::nullopt;
    text = text.substr(0, at);
    text.remove_suffix(text.size() - (text.find_last_not_of(" \t") + 1));
    return number_after(text.substr(text.find_last_of(" \t") + 1), "");
}

bool is_for_viewers(std::string_view text) {
    return text.starts_with("!V") || text.starts_with("TRIALID") || text.starts_with("TRIAL_RESULT");
}

} // namespace

std::vector<EyelinkMode> eyelink_modes(std::string_view list) {
    std::vector<EyelinkMode> modes;
    while (!list.empty()) {
        const std::size_t begin = std::min(list.find_first_not_of(" \t\r\n,"), list.size());
        list.remove_prefix(begin);
        const std::string_view word = list.substr(0, list.find_first_of(" \t\r\n,"));
        list.remove_prefix(word.size());
        EyelinkMode mode;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), mode.rate_hz);
        if (read.ec != std::errc{} || mode.rate_hz < 1 || mode.rate_hz > 100'000)
            continue;
        mode.can_both_eyes =
            std::string_view(read.ptr, word.data() + word.size()).find('B') != std::string_view::npos;
        modes.push_back(mode);
    }
    return modes;
}

EyelinkGrant eyelink_grant(std::span<const EyelinkMode> modes, const TrackerWish& wish) {
    const bool both =
        wish.both_eyes && (modes.empty() || std::ranges::any_of(modes, &EyelinkMode::can_both_eyes));
    EyelinkGrant grant{static_cast<int>(std::lround(wish.rate_hz)), both};
    if (modes.empty()) {
        if (both)
            grant.rate_hz = std::min(grant.rate_hz, 1000);
        return grant;
    }
    int below = 0, lowest = 0;
    for (const EyelinkMode& mode : modes) {
        if (both && !mode.can_both_eyes)
            continue;
        if (mode.rate_hz <= grant.rate_hz)
            below = std::max(below, mode.rate_hz);
        lowest = lowest == 0 ? mode.rate_hz : std::min(lowest, mode.rate_hz);
    }
    grant.rate_hz = below > 0 ? below : lowest;
    return grant;
}

std::optional<double> eyelink_software_version(std::string_view model) {
    const std::size_t last = model.find_last_of(' ');
    return last == std::string_view::npos ? std::nullopt : number_after(model.substr(last), "");
}

EyelinkVariable eyelink_variable(std::string_view command) {
    const std::size_t equals = command.find(" = ");
    if (equals == std::string_view::npos)
        return {command, {}};
    return {command.substr(0, equals), command.substr(equals + 3)};
}

namespace {

/// Its words in capitals, split at blanks and commas, in the order of letters.
std::vector<std::string> words_of_value(std::string_view value) {
    std::vector<std::string> words(1);
    for (const char each : value) {
        const bool is_between = std::string_view(" \t\r\n,").find(each) != std::string_view::npos;
        if (is_between && !words.back().empty())
            words.emplace_back();
        if (!is_between)
            words.back() += static_cast<char>(std::toupper(static_cast<unsigned char>(each)));
    }
    if (words.back().empty())
        words.pop_back();
    return words;
}

std::optional<double> number_of_word(const std::string& word) {
    constexpr std::string_view is_true[] = {"YES", "ON", "TRUE"}, is_false[] = {"NO", "OFF", "FALSE"};
    if (std::ranges::find(is_true, word) != std::end(is_true))
        return 1.0;
    if (std::ranges::find(is_false, word) != std::end(is_false))
        return 0.0;
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

} // namespace

bool eyelink_means_same(std::string_view asked, std::string_view told) {
    std::vector<std::string> ours = words_of_value(asked), theirs = words_of_value(told);
    const auto is_number = [](const std::string& word) { return number_of_word(word).has_value(); };
    if (ours.size() != theirs.size())
        return false;
    if (std::ranges::all_of(ours, is_number) && std::ranges::all_of(theirs, is_number))
        return std::ranges::equal(ours, theirs, [](const std::string& one, const std::string& other) {
            return std::abs(*number_of_word(one) - *number_of_word(other)) <= 0.5;
        });
    std::ranges::sort(ours);
    std::ranges::sort(theirs);
    return ours == theirs;
}

std::vector<EyelinkCommand> eyelink_commands(const TrackerWish& wish, const EyelinkSettings& settings,
                                             const EyelinkGrant& grant, std::optional<double> software) {
    const ScreenGeometry& screen = wish.screen;
    std::vector<EyelinkCommand> commands;
    const auto needed = [&](std::string text) { commands.push_back({std::move(text), true}); };
    const auto wished = [&](std::string text) { commands.push_back({std::move(text), false}); };
    const auto proved = [&](std::string text) { commands.push_back({std::move(text), true, true}); };
    proved(fmt::format("screen_pixel_coords = 0 0 {} {}", screen.screen_px.x - 1, screen.screen_px.y - 1));
    // Millimetres from the middle: left, top, right, bottom.
    needed(fmt::format("screen_phys_coords = {0:.1f} {1:.1f} {2:.1f} {3:.1f}", -0.5 * screen.screen_mm.x,
                       0.5 * screen.screen_mm.y, 0.5 * screen.screen_mm.x, -0.5 * screen.screen_mm.y));
    proved(fmt::format("screen_distance = {:.0f}", screen.viewing_distance_mm));
    proved(fmt::format("sample_rate = {}", grant.rate_hz));
    wished(fmt::format("binocular_enabled = {}", grant.both_eyes ? "YES" : "NO"));
    if (!grant.both_eyes)
        proved(fmt::format("active_eye = {}", wish.eye == Eye::left ? "LEFT" : "RIGHT"));
    proved(fmt::format("calibration_type = HV{}", settings.calibration_points));
    wished("randomize_calibration_order = YES");
    wished("randomize_validation_order = YES");
    wished("select_parser_configuration = 0"); // the standard one, for cognitive research
    proved("pupil_size_diameter = NO");
    needed("file_event_filter = LEFT,RIGHT,FIXATION,SACCADE,BLINK,MESSAGE,BUTTON,INPUT");
    wished("file_event_data = GAZE,GAZERES,HREF,AREA,VELOCITY,STATUS");
    // HTARGET: the place and distance of the target on the forehead, in the tracker's remote mode.
    proved(fmt::format("file_sample_data = LEFT,RIGHT,GAZE,HREF,AREA,{}GAZERES,BUTTON,STATUS,INPUT",
                       software.value_or(0.0) >= 4.0 ? "HTARGET," : ""));
    needed("link_event_filter = LEFT,RIGHT,FIXATION,SACCADE,BLINK,BUTTON,INPUT");
    wished("link_event_data = GAZE,GAZERES,HREF,AREA,VELOCITY,STATUS");
    proved("link_sample_data = LEFT,RIGHT,GAZE,GAZERES,AREA,STATUS,INPUT");
    wished("button_function 5 'accept_target_fixation'");
    return commands;
}

std::string eyelink_display_coords(const ScreenGeometry& screen) {
    return fmt::format("DISPLAY_COORDS 0 0 {} {}", screen.screen_px.x - 1, screen.screen_px.y - 1);
}

std::string eyelink_file_name(std::string_view whom, std::chrono::sys_seconds at) {
    using namespace std::chrono;
    const auto in_capitals = [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    };
    const auto may_stand = [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); };
    std::string name(letters_of_whom, '0');
    std::size_t place = letters_of_whom;
    for (std::size_t i = whom.size(); i > 0 && place > 0; --i)
        if (const char c = in_capitals(whom[i - 1]); may_stand(c))
            name[--place] = c;
    std::string digits(digits_of_time, '0');
    std::int64_t seconds = (at - sys_days(year(2020) / January / 1)).count();
    for (std::size_t i = digits.size(); i > 0; --i, seconds /= 36)
        digits[i - 1] = base_36[static_cast<std::size_t>(seconds % 36)];
    return name + digits;
}

std::string_view eyelink_message(std::string_view text, SessionDuration age, std::span<char> into) noexcept {
    if (into.empty())
        return {};
    char* end = into.data();
    if (!is_for_viewers(text)) {
        const auto ago_ms = std::chrono::round<std::chrono::milliseconds>(age).count();
        // A text that begins with a number would be taken for a time, were there none before it.
        const bool is_ambiguous =
            !text.empty() && (text[0] == '-' || text[0] == '+' || (text[0] >= '0' && text[0] <= '9'));
        if (ago_ms != 0 || is_ambiguous) {
            end = std::to_chars(into.data(), into.data() + into.size(), ago_ms).ptr;
            if (end < into.data() + into.size())
                *end++ = ' ';
        }
    }
    const std::size_t room = into.size() - static_cast<std::size_t>(end - into.data());
    const std::size_t length = std::min(text.size(), room);
    std::memcpy(end, text.data(), length);
    return {into.data(), static_cast<std::size_t>(end - into.data()) + length};
}

std::optional<ValidationResult> eyelink_validation(std::string_view sentence) {
    const auto mean = number_after(sentence, "ERROR"), max = number_before(sentence, "max");
    if (!mean || !max || *mean < 0.0 || *max < *mean)
        return std::nullopt;
    return ValidationResult{{*mean}, {*max}};
}

std::optional<int> eyelink_targets(std::string_view sentence) {
    const auto targets = number_after(sentence, " HV");
    return targets && *targets >= 1.0 ? std::optional(static_cast<int>(*targets)) : std::nullopt;
}

std::optional<Degrees> eyelink_drift(std::string_view sentence) {
    const auto offset = number_after(sentence, "OFFSET");
    if (!offset || *offset < 0.0)
        return std::nullopt;
    return Degrees{*offset};
}

std::optional<std::string> eyelink_connection_problem(std::int16_t result, const std::string& address) {
    switch (result) {
    case 0:
        return std::nullopt;
    case -202:
        return "The EyeLink's host runs another version than its library understands: install the library "
               "that "
               "belongs to the host's software.";
    case -203:
        return fmt::format(
            "The EyeLink at {} is busy: another program is connected to it. End that program, or "
            "restart the host's software.",
            address);
    default:
        return fmt::format(
            "No EyeLink answers at {} ({}). Is the host running its tracking software, is the network cable "
            "in, "
            "and has this computer's network card an address on the same net, such as 100.1.1.2 with mask "
            "255.255.255.0?",
            address, result == -201 ? "time-out" : fmt::format("error {}", result));
    }
}

std::optional<std::string> eyelink_transfer_problem(std::int32_t result) {
    if (result > 0)
        return std::nullopt;
    switch (result) {
    case 0:
        return "it was cancelled, or the file is empty";
    case -110:
        return "it was broken off";
    case -111:
        return "the file cannot be opened";
    case -112:
        return "the host does not answer";
    case -113:
        return "bad data arrived";
    default:
        return fmt::format("error {}", result);
    }
}

} // namespace overt
