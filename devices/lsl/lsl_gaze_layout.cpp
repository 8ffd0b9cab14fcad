#include "devices/lsl/lsl_gaze_layout.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

std::string lower(std::string_view text) {
    std::string word;
    for (const char each : text)
        word += static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
    return word;
}

/// The words of a label: "LeftGazePointX", "left_gaze_x" and "gaze x (left)" alike.
std::vector<std::string> words_of(std::string_view label) {
    std::vector<std::string> words(1);
    char before = ' ';
    for (const char each : label) {
        const bool is_word = std::isalnum(static_cast<unsigned char>(each)) != 0;
        const bool begins = std::isupper(static_cast<unsigned char>(each)) != 0 &&
                            std::islower(static_cast<unsigned char>(before)) != 0;
        if ((!is_word || begins) && !words.back().empty())
            words.emplace_back();
        if (is_word)
            words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
        before = each;
    }
    if (words.back().empty())
        words.pop_back();
    return words;
}

bool has(const std::vector<std::string>& words, std::initializer_list<std::string_view> any) {
    return std::ranges::any_of(words, [&](const std::string& word) {
        return std::ranges::find(any, std::string_view(word)) != any.end();
    });
}

bool begins_any(const std::vector<std::string>& words, std::string_view beginning) {
    return std::ranges::any_of(words, [&](const std::string& word) { return word.starts_with(beginning); });
}

/// `is_on_screen`: that a place is one on the screen is known without its words.
std::optional<LslMeaning> meaning_of_label(std::string_view label, bool is_on_screen) {
    const std::vector<std::string> words = words_of(label);
    if (has(words, {"confidence"}))
        return LslMeaning::confidence;
    if (begins_any(words, "diameter") || (begins_any(words, "pupil") && !has(words, {"x", "y", "z"})))
        return LslMeaning::pupil;
    const bool is_gaze =
        is_on_screen || has(words, {"gaze", "por", "pog", "screen", "norm"}) || words.size() == 1;
    // Points and directions in space are no places on a screen.
    if (!is_gaze || has(words, {"3d", "normal", "normal0", "normal1", "direction", "origin", "velocity"}))
        return std::nullopt;
    if (has(words, {"x"}))
        return LslMeaning::screen_x;
    if (has(words, {"y"}))
        return LslMeaning::screen_y;
    return std::nullopt;
}

std::string table_of(const std::vector<LslChannel>& channels) {
    std::string table;
    for (std::size_t i = 0; i < channels.size(); ++i)
        table += fmt::format("{}{} \"{}\" ({})", i == 0 ? "" : ", ", i + 1, channels[i].label,
                             channels[i].type.empty() ? "no type" : channels[i].type);
    return table;
}

/// What a place is multiplied with to be in px; nothing for a unit that is not known.
std::optional<double> scale_of(StreamUnit unit, const LslChannel& channel, double screen_px) {
    const std::string told = lower(channel.unit);
    if (unit == StreamUnit::px ||
        (unit == StreamUnit::as_told && (told.starts_with("pixel") || told == "px")))
        return 1.0;
    // App-TobiiPro calls shares of the screen so.
    const bool tells_shares = told.starts_with("normali") || told == "screencoords";
    if (unit == StreamUnit::normalized || (unit == StreamUnit::as_told && tells_shares))
        return screen_px;
    const bool tells_percent = told.starts_with("percent") || told == "%";
    if (unit == StreamUnit::percent || (unit == StreamUnit::as_told && tells_percent))
        return 0.01 * screen_px;
    return std::nullopt;
}

/// What a place of the eye is multiplied with to be in mm: by its unit, without one as it is.
double mm_of(const LslChannel& channel) {
    const std::string told = lower(channel.unit);
    if (told == "m" || told.starts_with("met"))
        return 1000.0;
    return told == "cm" || told.starts_with("centimet") ? 10.0 : 1.0;
}

std::size_t channel_of(const LslAssignment& assignment, const std::vector<LslChannel>& channels,
                       const std::string& stream) {
    const auto found = std::ranges::find(channels, assignment.label, &LslChannel::label);
    if (found != channels.end())
        return static_cast<std::size_t>(found - channels.begin());
    const auto number = number_in<std::size_t>(assignment.label);
    if (number && *number >= 1 && *number <= channels.size())
        return *number - 1;
    throw DeviceError(fmt::format("The stream {} has no channel \"{}\"; it has {}.", stream, assignment.label,
                                  table_of(channels)));
}

} // namespace

LslAssignment parse_lsl_assignment(std::string_view text) {
    constexpr std::string_view meanings[lsl_meanings] = {"x",     "y",     "confidence", "pupil",
                                                         "eye-x", "eye-y", "eye-z",      "valid"};
    std::string_view rest = text;
    const auto next_word = [&rest] {
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
        const std::string_view word = rest.substr(0, rest.find(' '));
        rest.remove_prefix(word.size());
        return word;
    };
    LslAssignment assignment;
    std::string_view word = next_word();
    if (word == "left" || word == "right") {
        assignment.eye = word == "left" ? Eye::left : Eye::right;
        word = next_word();
    }
    const auto meaning = std::ranges::find(meanings, word);
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    if (meaning == std::end(meanings) || rest.empty())
        throw InputError(
            fmt::format("\"{}\" does not say what a channel means: write eye, meaning and channel, "
                        "such as \"left x 3\"; meanings are {}.",
                        text, fmt::join(meanings, ", ")));
    assignment.meaning = static_cast<LslMeaning>(meaning - std::begin(meanings));
    assignment.label = rest; // which may have blanks in it
    return assignment;
}

std::optional<LslMeaning> lsl_meaning(const LslChannel& channel) {
    const std::string type = lower(channel.type);
    if (type == "screenx")
        return LslMeaning::screen_x;
    if (type == "screeny")
        return LslMeaning::screen_y;
    if (type == "confidence")
        return LslMeaning::confidence;
    if (type == "diameter" || type == "pupil" || type == "pupilsize" || type == "area")
        return LslMeaning::pupil;
    if (type.starts_with("position")) {
        // Of the eye, and not of the point in space that is looked at.
        const std::vector<std::string> words = words_of(channel.label);
        if (!begins_any(words, "eye") && !has(words, {"origin"}))
            return std::nullopt;
        if (type.ends_with('x'))
            return LslMeaning::position_x;
        if (type.ends_with('y'))
            return LslMeaning::position_y;
        return type.ends_with('z') ? std::optional(LslMeaning::position_z) : std::nullopt;
    }
    // What is no type of a channel, but of the whole stream: its label has to tell.
    const bool is_of_stream = type.empty() || type == "gaze" || type == "screen" || type.starts_with("eye");
    return is_of_stream ? meaning_of_label(channel.label, type == "screen") : std::nullopt;
}

std::optional<Eye> lsl_eye(const LslChannel& channel) {
    const std::string eye = lower(channel.eye);
    if (eye == "left" || eye == "l")
        return Eye::left;
    if (eye == "right" || eye == "r")
        return Eye::right;
    if (!eye.empty())
        return std::nullopt;
    const std::vector<std::string> words = words_of(channel.label);
    // Pupil Labs count their cameras: 0 looks at the right eye.
    if (has(words, {"left", "l", "diameter1"}))
        return Eye::left;
    if (has(words, {"right", "r", "diameter0"}))
        return Eye::right;
    return std::nullopt;
}

LslGazeLayout::LslGazeLayout(const std::vector<LslChannel>& channels, const LslLayoutSettings& settings,
                             const TrackerWish& wish, const std::string& stream)
    : screen_px_(wish.screen.screen_px), scale_(1.0), y_is_up_(settings.y_is_up),
      least_confidence_(settings.least_confidence), missing_(settings.missing), eye_(wish.eye) {
    const auto assign = [&](LslMeaning meaning, std::optional<Eye> eye, std::size_t channel) {
        const Side side = !eye ? neither : *eye == Eye::left ? left : right;
        std::optional<std::size_t>& place = places_[side][static_cast<std::size_t>(meaning)];
        if (!place) // the first of several counts
            place = channel;
    };
    for (const LslAssignment& assignment : settings.assignments)
        assign(assignment.meaning, assignment.eye, channel_of(assignment, channels, stream));
    for (std::size_t i = 0; settings.assignments.empty() && i < channels.size(); ++i)
        if (const std::optional<LslMeaning> meaning = lsl_meaning(channels[i]))
            assign(*meaning, lsl_eye(channels[i]), i);
    for (const Places& side : places_)
        if (const std::optional<std::size_t> x = side[static_cast<std::size_t>(LslMeaning::position_x)])
            position_mm_ = mm_of(channels[*x]);
    both_eyes_ = wish.both_eyes && has_gaze(left) && has_gaze(right);
    const Side wished = eye_ == Eye::left ? left : right;
    if (!has_gaze(wished) && !has_gaze(neither))
        throw DeviceError(fmt::format(
            "The stream {} does not tell where on the screen the {} eye looks; it has the channels {}. Name "
            "those that do, or the other eye.",
            stream, wished == left ? "left" : "right", table_of(channels)));
    const Side used = has_gaze(wished) ? wished : neither;
    const LslChannel& x = channels[*places_[used][static_cast<std::size_t>(LslMeaning::screen_x)]];
    const LslChannel& y = channels[*places_[used][static_cast<std::size_t>(LslMeaning::screen_y)]];
    if (lower(x.coordinate_system).find("world") != std::string::npos)
        throw DeviceError(
            fmt::format("The stream {} tells gaze in the picture of a camera that moves with the "
                        "head (\"{}\"), and not on the screen; take the kind \"pupil\" for "
                        "Pupil Core.",
                        stream, x.coordinate_system));
    const std::optional<double> scale_x = scale_of(settings.unit, x, screen_px_.x),
                                scale_y = scale_of(settings.unit, y, screen_px_.y);
    if (!scale_x || !scale_y)
        throw DeviceError(fmt::format("The stream {} tells gaze in \"{}\", which is neither pixels nor "
                                      "normalized nor percent; name the unit.",
                                      stream, x.unit));
    scale_ = {*scale_x, *scale_y};
}

bool LslGazeLayout::has_gaze(Side side) const noexcept {
    return places_[side][static_cast<std::size_t>(LslMeaning::screen_x)] &&
           places_[side][static_cast<std::size_t>(LslMeaning::screen_y)];
}

bool LslGazeLayout::is_missing(double value) const noexcept {
    return std::ranges::find(missing_, value) != missing_.end();
}

std::optional<ScreenPoint> LslGazeLayout::gaze_in(std::span<const double> values, Side side) const noexcept {
    const std::optional<double> x = value(values, side, LslMeaning::screen_x),
                                y = value(values, side, LslMeaning::screen_y);
    if (!x || !y || (is_missing(*x) && is_missing(*y)))
        return std::nullopt;
    const glm::dvec2 place_px(*x * scale_.x, *y * scale_.y);
    const auto is_off = [](double at_px, double size_px) { return at_px < 0.0 || at_px > size_px; };
    if ((is_missing(*x) && is_off(place_px.x, screen_px_.x)) ||
        (is_missing(*y) && is_off(place_px.y, screen_px_.y)))
        return std::nullopt;
    return ScreenPoint{place_px.x, y_is_up_ ? screen_px_.y - place_px.y : place_px.y};
}

std::optional<double> LslGazeLayout::value(std::span<const double> values, Side side,
                                           LslMeaning meaning) const noexcept {
    const std::optional<std::size_t> place = places_[side][static_cast<std::size_t>(meaning)];
    if (!place || *place >= values.size() || !std::isfinite(values[*place]))
        return std::nullopt;
    return values[*place];
}

void LslGazeLayout::put_eye(std::span<const double> values, Eye eye, TrackerTime at,
                            TrackerItemSink& sink) const noexcept {
    const Side own = eye == Eye::left ? left : right;
    const Side gazing = has_gaze(own) ? own : neither;
    const auto told = [&](LslMeaning meaning) {
        const std::optional<double> number = value(values, own, meaning);
        return number ? number : value(values, neither, meaning);
    };
    GazeSample sample;
    sample.sampled_at = at;
    sample.eye = eye;
    const std::optional<double> confidence = told(LslMeaning::confidence), pupil = told(LslMeaning::pupil);
    // Of the channels that gaze is taken from: another eye's are none of its business.
    const bool tells_validity = places_[gazing][static_cast<std::size_t>(LslMeaning::validity)].has_value();
    const bool is_valid = !tells_validity || value(values, gazing, LslMeaning::validity).value_or(0.0) != 0.0;
    if (is_valid && confidence.value_or(1.0) >= least_confidence_)
        sample.gaze = gaze_in(values, gazing);
    if (pupil && !is_missing(*pupil))
        sample.pupil_area = static_cast<float>(*pupil);
    sink.put(sample);
    const std::optional<double> at_x = told(LslMeaning::position_x), at_y = told(LslMeaning::position_y),
                                at_z = told(LslMeaning::position_z);
    const bool has_place =
        at_x && at_y && at_z && !(is_missing(*at_x) && is_missing(*at_y) && is_missing(*at_z));
    if (!confidence && !has_place)
        return;
    SampleDetail detail;
    detail.sampled_at = at;
    detail.eye = eye;
    if (confidence)
        detail.confidence = static_cast<float>(*confidence);
    if (has_place)
        detail.eye_mm = glm::vec3(glm::dvec3(*at_x, *at_y, *at_z) * position_mm_);
    sink.put(detail);
}

void LslGazeLayout::take(std::span<const double> values, TrackerTime at,
                         TrackerItemSink& sink) const noexcept {
    if (both_eyes_ || eye_ == Eye::left)
        put_eye(values, Eye::left, at, sink);
    if (both_eyes_ || eye_ == Eye::right)
        put_eye(values, Eye::right, at, sink);
}

} // namespace overt
