#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "render/window/signal_settings.h"

namespace overt {
namespace {

using Source = SignalSetting::Source;

/// A setting that may change bytes: the one value with which it does not, what it does else, and what
/// nvidia-settings is told to have it safe.
struct SignalRule {
    Source source;
    std::string_view name, safe, does;
    std::string_view assignment = {};
};

// xrandr writes a matrix of CTM as pairs of 32 bits, the lower first: 1 is "0 1".
constexpr SignalRule rules[] = {
    {Source::randr, "Broadcast RGB", "Full",
     "the range of values may be squeezed into 16 to 235, as television wants it"},
    {Source::randr, "output_csc", "bypass", "the driver turns red, green and blue into other colours"},
    {Source::randr, "Colorspace", "Default", "the driver may turn red, green and blue into other colours"},
    {Source::randr, "dither", "off", "the driver adds a pattern to the picture"},
    {Source::randr, "dithering mode", "off", "the driver adds a pattern to the picture"},
    {Source::randr, "underscan", "off", "the picture may be shrunk to leave a border"},
    {Source::randr, "abm level", "0", "the driver changes contrast to save power"},
    {Source::randr, "CTM", "0 1 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0 1", "a matrix mixes red, green and blue"},
    {Source::randr, "CscMatrix", "65536 0 0 0 0 65536 0 0 0 0 65536 0", "a matrix mixes red, green and blue"},
    {Source::randr_crtc, "rotation", "normal", "the picture is turned or mirrored"},
    {Source::randr_crtc, "transformation", "none", "the picture is scaled or sheared, which resamples it"},
    {Source::nvidia, "ColorRange", "0",
     "the range of values is squeezed into 16 to 235, as television wants it", "ColorRange=0"},
    {Source::nvidia, "ColorSpace", "0", "red, green and blue are sent as YCbCr", "ColorSpace=0"},
    {Source::nvidia, "CurrentDithering", "0", "the driver adds a pattern to the picture", "Dithering=2"},
};

std::string quoted(std::string_view name) {
    return name.find(' ') == std::string_view::npos ? std::string(name) : fmt::format("\"{}\"", name);
}

std::string command_for(const SignalRule& rule, const std::string& output) {
    if (rule.source == Source::nvidia)
        return fmt::format("nvidia-settings -a '[dpy:{}]/{}'", output, rule.assignment);
    if (rule.source == Source::randr_crtc)
        return rule.name == "rotation"
                   ? fmt::format("xrandr --output {} --rotate normal --reflect normal", output)
                   : fmt::format("xrandr --output {} --transform none", output);
    std::string value(rule.safe);
    std::replace(value.begin(), value.end(), ' ', ',');
    return fmt::format("xrandr --output {} --set {} {}", output, quoted(rule.name), value);
}

SignalVerdict judge_depth(const SignalSetting& setting, OutputMode mode, const std::string& output) {
    const int bits = row_of(mode).framebuffer_bits;
    const std::string wanted = fmt::format("{}", bits);
    if (setting.value == wanted)
        return {true, wanted};
    return {false, fmt::format("{}, where {} writes {} bits: the driver may dither, or widen them; xrandr "
                               "--output {} --set \"max bpc\" {}",
                               setting.value, name_of(mode), bits, output, bits)};
}

} // namespace

SignalVerdict judge_signal_setting(const SignalSetting& setting, OutputMode mode, const std::string& output) {
    if (setting.source == Source::randr && setting.name == "max bpc")
        return judge_depth(setting, mode, output);
    if (setting.source == Source::nvidia && setting.name == "nvidia-settings")
        return {false, "does not answer: colour range and dithering are not known; apt-get install "
                       "nvidia-settings"};
    const SignalRule* const rule = std::ranges::find_if(rules, [&](const SignalRule& one) {
        return one.source == setting.source && one.name == setting.name;
    });
    if (rule == std::end(rules) || setting.value == rule->safe)
        return {true, setting.value};
    return {false, fmt::format("{}: {}; {}", setting.value, rule->does, command_for(*rule, output))};
}

} // namespace overt
