#include "render/window/screen_check.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/window/monitor_choice.h"

namespace overt {
namespace {

using Weight = ScreenFinding::Weight;

/// The value an entry of 16 bits stands for in a table of so many entries.
std::size_t level_of(std::uint16_t entry, std::size_t entries) {
    return static_cast<std::size_t>(entry) * entries / 65536;
}

ScreenFinding gamma_finding(const ScreenFacts& facts, const DisplaySettings& display) {
    const GammaRamp& ramp = facts.gamma_ramp;
    const std::string found = describe(ramp);
    if (ramp.red.empty() && ramp.server_gamma == ServerGamma{})
        return {Weight::risk, "gamma table", found};
    if (is_identity(ramp))
        return {Weight::good, "gamma table", found};
    return {row_of(display.output).is_packed ? Weight::refusal : Weight::risk, "gamma table",
            found + ": take the colour profile and the night light off this screen "
                    "(xrandr --output NAME --gamma 1:1:1, xgamma -gamma 1)"};
}

ScreenFinding linearisation_finding(const DisplaySettings& display) {
    const auto good = [](std::string finding) {
        return ScreenFinding{Weight::good, "linearisation", std::move(finding)};
    };
    if (display.characterisation)
        return good("measured: " + display.characterisation_file.filename().string());
    switch (display.linearised_by) {
    case LinearisedBy::display:
        return good("by the display itself, as the protocol says");
    case LinearisedBy::box:
        return good(
            fmt::format("by the table {} of the display box, as the protocol says", display.box_gamma_table));
    case LinearisedBy::none:
        return good(fmt::format("by overt, for a gamma of {:g}, as the protocol says", display.gamma));
    case LinearisedBy::unsaid:
        break;
    }
    return {Weight::refusal, "linearisation",
            "nothing says what makes light proportional to the signal: measure it (overt display "
            "characterise), or write [display] linearised_by = \"display\", \"box\" or \"none\""};
}

/// Gaze is related to frames by when they are lit.
ScreenFinding latency_finding(const DisplaySettings& display) {
    if (display.latency_ms > 0.0)
        return {Weight::good, "latency", fmt::format("{:g} ms, as the protocol says", display.latency_ms)};
    return {
        Weight::risk, "latency",
        "not measured: frames are taken to be lit at their vertical blank; measure it with a light sensor "
        "(overt doctor --photodiode) and set [display] latency_ms"};
}

ScreenFinding depth_finding(const ScreenFacts& facts, const DisplaySettings& display) {
    const int needed = row_of(display.output).framebuffer_bits;
    const std::string found = fmt::format("{} bits per channel", facts.bits_per_channel);
    // Such a window gets a visual of depth 32, of which the screen's own depth says nothing.
    if (facts.bits_per_channel == needed && facts.system.depth > 3 * needed)
        return {
            row_of(display.output).is_packed ? Weight::refusal : Weight::risk, "depth",
            fmt::format("{} in a window on an X screen of {} bits: it is drawn apart from the screen (depth "
                        "32) and its values are converted on their way; set DefaultDepth {} in xorg.conf{}",
                        found, facts.system.depth, 3 * needed,
                        row_of(display.output).is_packed ? "" : ", or take output = \"native-10bit\"")};
    if (facts.bits_per_channel == needed)
        return {Weight::good, "depth", found};
    return {Weight::refusal, "depth",
            fmt::format("{}, where {} sends {}: set the screen to a depth of {} bits", found,
                        name_of(display.output), needed, 3 * needed)};
}

ScreenFinding size_finding(const ScreenFacts& facts, const DisplaySettings& display) {
    const glm::ivec2 wanted(display.width_px, display.height_px);
    if (facts.monitor.size_px == wanted)
        return {Weight::good, "resolution", fmt::format("{} x {} px", wanted.x, wanted.y)};
    const std::string found =
        fmt::format("the screen has {} x {} px, the protocol says {} x {}", facts.monitor.size_px.x,
                    facts.monitor.size_px.y, wanted.x, wanted.y);
    // A window that is asked for as one is a part of the screen.
    return {facts.is_fullscreen ? Weight::refusal : Weight::risk, "resolution", found};
}

ScreenFinding scaling_finding(const ScreenFacts& facts) {
    if (facts.window_size != facts.framebuffer_px)
        return {Weight::refusal, "scaling",
                fmt::format("a window of {} x {} shows {} x {} pixels: the desktop scales it, which "
                            "resamples every stimulus; set its scaling to 100 %",
                            facts.window_size.x, facts.window_size.y, facts.framebuffer_px.x,
                            facts.framebuffer_px.y)};
    const glm::vec2 scale = facts.monitor.content_scale;
    const bool is_whole = scale == glm::vec2(1.0f);
    // Under X11 the scale is advice on the size of text and changes no pixel.
    if (is_whole || (facts.system.is_x11 && !facts.system.is_wayland && !facts.system.is_xwayland))
        return {Weight::good, "scaling", "pixel for pixel"};
    return {Weight::refusal, "scaling",
            fmt::format("the desktop enlarges by {:.0f} %: set its scaling to 100 %",
                        100.0 * static_cast<double>(scale.x))};
}

ScreenFinding rate_finding(const ScreenFacts& facts, const DisplaySettings& display) {
    if (facts.monitor.refresh_hz <= 0.0)
        return {Weight::risk, "refresh rate",
                fmt::format("the screen does not say its own; the protocol says {} Hz", display.refresh_hz)};
    if (has_rate(facts.monitor, display.refresh_hz))
        return {Weight::good, "refresh rate", describe_rate(facts.monitor)};
    return {Weight::refusal, "refresh rate",
            fmt::format("the screen runs at {}, the protocol says {} Hz: frames would be lit for another "
                        "time; set its mode, or correct [display] refresh_hz",
                        describe_rate(facts.monitor), display.refresh_hz)};
}

ScreenFinding system_finding(const ScreenFacts& facts) {
    const WindowSystem& system = facts.system;
    if (system.is_wayland || system.is_xwayland)
        return {Weight::risk, "window system",
                system.description() +
                    ": its compositor decides when and how a window is shown; take an X11 session"};
    if (system.has_compositor)
        return {Weight::risk, "window system",
                system.description() + ": pictures may be delayed by a refresh; switch compositing off"};
    return {Weight::good, "window system", system.description()};
}

ScreenFinding place_finding(const ScreenFacts& facts, const DisplaySettings& display) {
    if (facts.is_fullscreen)
        return {Weight::good, "place", "the whole of " + describe(facts.monitor)};
    return {Weight::risk, "place",
            fmt::format("a window on {}, not the whole screen{}", describe(facts.monitor),
                        has_t_lock(display.output)
                            ? ": messages to the display box work only if it begins at the left edge"
                            : "")};
}

} // namespace

ScreenFacts facts_of(const WindowContext& window) {
    return {examine_window_system(), window.monitor(),
            window.gamma_ramp(),     window.window_size(),
            window.framebuffer_px(), window.bits_per_channel(),
            window.is_fullscreen(),  read_signal_settings(window.monitor().name)};
}

ScreenFacts facts_at(const MonitorInfo& monitor, int bits_per_channel) {
    return {
        examine_window_system(), monitor, gamma_ramp_of(monitor.number),     monitor.size_px, monitor.size_px,
        bits_per_channel,        true,    read_signal_settings(monitor.name)};
}

bool is_identity(const std::vector<std::uint16_t>& ramp) {
    for (std::size_t i = 0; i < ramp.size(); ++i)
        if (level_of(ramp[i], ramp.size()) != i)
            return false;
    return !ramp.empty();
}

bool is_identity(const GammaRamp& ramp) {
    return is_identity(ramp.red) && is_identity(ramp.green) && is_identity(ramp.blue) &&
           ramp.server_gamma == ServerGamma{};
}

std::string describe(const GammaRamp& ramp) {
    if (const ServerGamma& gamma = ramp.server_gamma; gamma != ServerGamma{})
        return fmt::format(
            "not the identity: the X server reckons a gamma of {:g} (red), {:g} (green) and {:g} (blue) "
            "into it, as xgamma sets it",
            gamma.red, gamma.green, gamma.blue);
    if (ramp.red.empty())
        return "cannot be read here";
    const std::pair<const char*, const std::vector<std::uint16_t>*> channels[] = {
        {"red", &ramp.red}, {"green", &ramp.green}, {"blue", &ramp.blue}};
    for (const auto& [name, channel] : channels)
        for (std::size_t i = 0; i < channel->size(); ++i)
            if (const std::size_t sent = level_of((*channel)[i], channel->size()); sent != i)
                return fmt::format("not the identity: of {}, {} becomes {} of {}", name, i, sent,
                                   channel->size() - 1);
    return fmt::format("the identity, {} entries", ramp.red.size());
}

std::vector<ScreenFinding> judge_signal(std::span<const SignalSetting> settings, OutputMode mode,
                                        const std::string& output) {
    const bool is_packed = row_of(mode).is_packed;
    std::vector<ScreenFinding> findings;
    for (const SignalSetting& setting : settings) {
        SignalVerdict verdict = judge_signal_setting(setting, mode, output);
        findings.push_back({verdict.is_safe ? Weight::good
                            : is_packed     ? Weight::refusal
                                            : Weight::risk,
                            setting.name, std::move(verdict.finding)});
    }
    if (is_packed && settings.empty())
        findings.push_back({Weight::risk, "driver's settings",
                            "not told: whether the driver dithers or limits what it sends is shown by the "
                            "box (overt display verify --hardware)"});
    return findings;
}

std::vector<ScreenFinding> judge_screen(const ScreenFacts& facts, const DisplaySettings& display) {
    std::vector<ScreenFinding> findings = {
        place_finding(facts, display),  size_finding(facts, display), rate_finding(facts, display),
        depth_finding(facts, display),  scaling_finding(facts),       gamma_finding(facts, display),
        linearisation_finding(display), latency_finding(display),     system_finding(facts)};
    for (ScreenFinding& finding : judge_signal(facts.signal, display.output, facts.monitor.name))
        findings.push_back(std::move(finding));
    return findings;
}

void refuse_unfit_screen(const std::vector<ScreenFinding>& findings) {
    std::string refusals;
    for (const ScreenFinding& finding : findings)
        if (finding.weight == Weight::refusal)
            refusals += fmt::format("\n  {}: {}", finding.what, finding.finding);
    if (!refusals.empty())
        throw GraphicsError(
            fmt::format("the screen would not show what the protocol says:{}\nA trial run that shows "
                        "nothing in time needs none of this: --virtual-time",
                        refusals));
}

} // namespace overt
