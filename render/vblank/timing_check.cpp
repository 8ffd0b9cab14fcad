#include "render/vblank/timing_check.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {
namespace {

using Weight = ScreenFinding::Weight;

/// A screen with a fixed refresh keeps its intervals to a microsecond; how late the system tells scatters by
/// far less than this share of one.
constexpr double regular_share = 0.05;

/// Of all stamps, or refreshes: more are a machine that is busy with something else.
constexpr double tolerable_share = 0.01;

/// What is looked at, where a finding may be a doubt about times.
constexpr const char* blank_finding = "vertical blank";
constexpr const char* way_finding = "pictures";
constexpr const char* go_between_finding = "compositor";
/// That the window's refreshes may be another screen's.
constexpr const char* mode_finding = "screen";

bool knows_swaps(VblankSource source) {
    return source == VblankSource::glx_sync_control || source == VblankSource::egl_sync_control ||
           source == VblankSource::present_swap;
}

ScreenFinding source_finding(const TimingFacts& facts) {
    const std::string refused = facts.refused_sources.empty()
                                    ? std::string()
                                    : fmt::format(" (not {})", fmt::join(facts.refused_sources, "; not "));
    const std::string source(name_of(facts.measured.source));
    if (facts.measured.source == VblankSource::swap_return)
        return {Weight::refusal, blank_finding,
                fmt::format("no source tells when it begins, times are those of the {}{}", source, refused)};
    if (!facts.blanks_are_real)
        return {Weight::refusal, blank_finding,
                fmt::format("{}: not a real one, the server counts by a timer{}", source, refused)};
    return {Weight::good, blank_finding, source + refused};
}

ScreenFinding rate_finding(const TimingFacts& facts, double nominal_hz, std::string_view nominal_from) {
    const RefreshMeasurement& measured = facts.measured;
    if (measured.mean_hz <= 0.0)
        return {Weight::refusal, "measured refresh", "the screen showed no pictures"};
    if (std::abs(measured.mean_hz / nominal_hz - 1.0) <= largest_rate_deviation)
        return {Weight::good, "measured refresh", describe(measured)};
    return {
        Weight::refusal, "measured refresh",
        fmt::format("{}, where {} says {} Hz: frames would be lit for another time; set the screen's mode "
                    "(xrandr --output NAME --rate {}), or correct [display] refresh_hz",
                    describe(measured), nominal_from, nominal_hz, nominal_hz)};
}

ScreenFinding regularity_finding(const RefreshMeasurement& measured) {
    const double interval_ms = measured.mean_hz > 0.0 ? 1e3 / measured.mean_hz : 0.0;
    const double flips = measured.flips;
    if (measured.interval_sd_ms > regular_share * interval_ms)
        return {Weight::risk, "regularity",
                fmt::format("intervals of {:.3f} ms scatter by {:.3f} ms: the refresh varies (FreeSync, "
                            "G-Sync), or the machine is busy",
                            interval_ms, measured.interval_sd_ms)};
    if (measured.missed > tolerable_share * flips || measured.outliers > tolerable_share * flips)
        return {
            Weight::risk, "regularity",
            fmt::format("of {} flips of an empty picture {} came late: the machine is busy with something "
                        "else",
                        measured.flips, std::max(measured.missed, measured.outliers))};
    return {Weight::good, "regularity",
            fmt::format("intervals scatter by {:.3f} ms", measured.interval_sd_ms)};
}

ScreenFinding swap_finding(const TimingFacts& facts) {
    const SwapBehaviour& swaps = facts.swaps;
    if (!swaps.wait)
        return {Weight::risk, "swaps",
                "return without waiting for the display: pictures may tear; switch the driver's "
                "synchronisation with the vertical blank on"};
    if (swaps.at_once <= 1)
        return {Weight::good, "swaps", "wait for the display, two buffers"};
    const std::string found =
        fmt::format("{} pictures are queued before one waits (triple buffering)", swaps.at_once);
    if (knows_swaps(facts.measured.source))
        return {Weight::good, "swaps", found + "; each is waited for"};
    return {Weight::risk, "swaps",
            found + ": they are lit later than their swap returns; switch the driver's triple buffering, or "
                    "the compositor, off"};
}

bool is_off_its_mode(const TimingFacts& facts) {
    return facts.output.refresh_hz && facts.measured.mean_hz > 0.0 &&
           std::abs(facts.measured.mean_hz / *facts.output.refresh_hz - 1.0) > largest_rate_deviation;
}

/// Why pictures come to the screen by being copied; empty if they do not, or nobody tells.
std::string how_copied(const TimingFacts& facts) {
    const SwapModes modes = facts.swap_modes.value_or(SwapModes());
    const auto remedy = [&] {
        const bool is_shared = !facts.output.neighbours.empty();
        return fmt::format("let the window fill its X screen (no --windowed){}, without a compositor",
                           is_shared
                               ? fmt::format(", with no other monitor on it (xrandr --output {} --off, or "
                                             "an X screen of its own, docs/rig.md)",
                                             fmt::join(facts.output.neighbours, " --off --output "))
                               : "");
    };
    if (modes.all_copied() > tolerable_share * modes.all())
        return fmt::format("of {} pictures {} were copied to the screen and {} flipped, by X Present: a copy "
                           "may be torn, and lit at another refresh than its swap's; {}",
                           modes.all(), modes.all_copied(), modes.flipped, remedy());
    if (modes.all() == 0 && facts.is_software)
        return "pictures are drawn by software and copied into the window whenever they are ready; install "
               "the "
               "graphics card's driver of OpenGL";
    return {};
}

ScreenFinding find_way(const TimingFacts& facts) {
    if (std::string copied = how_copied(facts); !copied.empty())
        return {Weight::refusal, way_finding, std::move(copied)};
    if (!facts.swap_modes)
        return {Weight::risk, way_finding,
                "whether they are flipped or copied is not told: there is no X Present"};
    const SwapModes& modes = *facts.swap_modes;
    if (modes.all() == 0)
        return {Weight::risk, way_finding,
                "whether they are flipped or copied is not told: the driver shows none through X Present; "
                "prove times with a photodiode"};
    const std::string found = fmt::format("{} of {} flipped", modes.flipped, modes.all());
    if (modes.skipped > 0)
        return {Weight::risk, way_finding,
                fmt::format("{}, {} replaced before they were shown", found, modes.skipped)};
    return {Weight::good, way_finding, found};
}

void add_surroundings(std::vector<ScreenFinding>& findings, const TimingFacts& facts) {
    if (std::string between = facts.system.go_between(); !between.empty())
        findings.push_back({Weight::refusal, go_between_finding, std::move(between)});
    else
        findings.push_back({Weight::good, go_between_finding, "none"});
    if (const auto& others = facts.output.neighbours; !others.empty())
        findings.push_back(
            {Weight::risk, "other monitors",
             fmt::format(
                 "{} shows another part of the same X screen: pictures of a window beside it are "
                 "usually copied, and their refreshes may be told by the other monitor; switch it off "
                 "for the session (xrandr --output {} --off), or give the observer's monitor an X "
                 "screen of its own (docs/rig.md)",
                 fmt::join(others, " and "), fmt::join(others, " --off --output "))});
}

void add_output_findings(std::vector<ScreenFinding>& findings, const TimingFacts& facts) {
    if (facts.output.may_vary_its_refresh)
        findings.push_back(
            *facts.output.may_vary_its_refresh
                ? ScreenFinding{Weight::risk, "variable refresh",
                                "the screen can wait for late pictures: switch VariableRefresh (FreeSync, "
                                "G-Sync, Adaptive-Sync) off, in the driver or in the screen's own menu"}
                : ScreenFinding{Weight::good, "variable refresh", "not offered by the screen"});
    const double measured_hz = facts.measured.mean_hz;
    if (!facts.output.refresh_hz || measured_hz <= 0.0)
        return;
    const double mode_hz = *facts.output.refresh_hz;
    if (!is_off_its_mode(facts))
        findings.push_back({Weight::good, mode_finding, fmt::format("its mode has {:.3f} Hz", mode_hz)});
    else
        // Either rate may be the protocol's: with the wrong one every refresh would be recorded as shown in
        // time.
        findings.push_back(
            {Weight::refusal, mode_finding,
             fmt::format(
                 "its mode has {:.3f} Hz, the window is shown at {:.3f}: times are told by {}; switch "
                 "other screens and the compositor off, or make this screen the primary",
                 mode_hz, measured_hz,
                 facts.blanks_are_real ? "another screen's refreshes, or a compositor's"
                                       : "a timer of the server, which does not know the screen's")});
}

} // namespace

std::string describe(const RefreshMeasurement& measured) {
    return fmt::format("{:.3f} Hz ± {:.3f}, intervals scatter by {:.3f} ms, {} of {} stamps off the line, {} "
                       "refreshes missed",
                       measured.mean_hz, measured.mean_se_hz, measured.interval_sd_ms, measured.outliers,
                       measured.flips, measured.missed);
}

std::vector<std::string> doubts_about_times(const TimingFacts& facts) {
    std::vector<std::string> doubts;
    if (facts.measured.source == VblankSource::swap_return)
        doubts.emplace_back("no source tells when a vertical blank begins, only when swaps return");
    else if (!facts.blanks_are_real)
        doubts.push_back(fmt::format("{} is no real vertical blank: the server counts by a timer",
                                     name_of(facts.measured.source)));
    for (std::string doubt : {how_copied(facts), facts.system.go_between()})
        if (!doubt.empty())
            doubts.push_back(std::move(doubt));
    if (is_off_its_mode(facts))
        doubts.push_back(
            fmt::format("the window is shown at {:.3f} Hz, but the mode of its screen has {:.3f}",
                        facts.measured.mean_hz, *facts.output.refresh_hz));
    return doubts;
}

std::vector<ScreenFinding> without_claim(std::vector<ScreenFinding> findings) {
    // Nor is a number said of what nobody saw.
    for (ScreenFinding& finding : findings)
        if (finding.what == "measured refresh" && finding.finding.ends_with(" refreshes missed"))
            finding.finding.erase(finding.finding.rfind(", "));
    for (ScreenFinding& finding : findings)
        for (const std::string_view doubted : {blank_finding, way_finding, go_between_finding, mode_finding})
            if (finding.what == doubted && finding.weight == Weight::refusal)
                finding.weight = Weight::risk;
    return findings;
}

std::vector<ScreenFinding> judge_timing(const TimingFacts& facts, double nominal_hz,
                                        std::string_view nominal_from) {
    std::vector<ScreenFinding> findings{source_finding(facts), rate_finding(facts, nominal_hz, nominal_from),
                                        regularity_finding(facts.measured), swap_finding(facts),
                                        find_way(facts)};
    add_surroundings(findings, facts);
    add_output_findings(findings, facts);
    return findings;
}

} // namespace overt
