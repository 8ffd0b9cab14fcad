#include <catch2/catch.hpp>

#include <algorithm>

#include "render/vblank/timing_check.h"

using namespace overt;
using Weight = ScreenFinding::Weight;

namespace {

/// A screen with nothing to say against it.
TimingFacts flipping_screen() {
    TimingFacts facts;
    facts.measured.source = VblankSource::present_swap;
    facts.measured.flips = 600;
    facts.measured.mean_hz = 120.0;
    facts.swaps = {true, 1};
    facts.blanks_are_real = true;
    facts.output.refresh_hz = 120.0;
    facts.system.is_x11 = true;
    facts.swap_modes = SwapModes{.flipped = 600};
    return facts;
}

ScreenFinding way_finding_of(const TimingFacts& facts, std::string_view what) {
    for (const ScreenFinding& finding : judge_timing(facts, 120.0, "the protocol"))
        if (finding.what == what)
            return finding;
    return {Weight::good, "absent", ""};
}

bool is_doubted(const TimingFacts& facts, const std::string& word) {
    const std::vector<std::string> doubts = doubts_about_times(facts);
    return std::ranges::any_of(
        doubts, [&](const std::string& doubt) { return doubt.find(word) != std::string::npos; });
}

} // namespace

TEST_CASE("pictures that are copied prove no times, those that are flipped to may", "[unit]") {
    TimingFacts facts = flipping_screen();
    CHECK(doubts_about_times(facts).empty());
    CHECK(way_finding_of(facts, "pictures").weight == Weight::good);
    for (const SwapModes copied : {SwapModes{.copied = 600}, SwapModes{.suboptimal_copied = 600},
                                   SwapModes{.flipped = 590, .copied = 10}}) {
        facts.swap_modes = copied;
        CHECK(is_doubted(facts, "copied"));
        CHECK(is_doubted(facts, "--windowed"));
        CHECK(way_finding_of(facts, "pictures").weight == Weight::refusal);
    }
    facts.swap_modes = SwapModes{.flipped = 598, .copied = 2}; // as a window comes up
    CHECK(doubts_about_times(facts).empty());
    facts.swap_modes = SwapModes{.flipped = 598, .skipped = 2};
    CHECK(way_finding_of(facts, "pictures").weight == Weight::risk);
}

TEST_CASE("where no server tells how pictures are shown, that is a risk, but software only copies",
          "[unit]") {
    TimingFacts facts = flipping_screen();
    for (const auto& untold : {std::optional<SwapModes>(), std::optional(SwapModes())}) {
        facts.swap_modes = untold;
        facts.is_software = false;
        CHECK(doubts_about_times(facts).empty());
        CHECK(way_finding_of(facts, "pictures").weight == Weight::risk);
        facts.is_software = true;
        CHECK(is_doubted(facts, "software"));
        CHECK(way_finding_of(facts, "pictures").weight == Weight::refusal);
    }
}

TEST_CASE("a compositor and Xwayland are refused by name with what to do", "[unit]") {
    TimingFacts facts = flipping_screen();
    CHECK(way_finding_of(facts, "compositor").weight == Weight::good);
    facts.system.has_compositor = true;
    facts.system.compositor = "picom";
    CHECK(is_doubted(facts, "(picom)"));
    CHECK(is_doubted(facts, "turn the compositor off"));
    CHECK(way_finding_of(facts, "compositor").weight == Weight::refusal);
    facts.system.is_xwayland = true;
    CHECK(is_doubted(facts, "Xwayland"));
    CHECK(way_finding_of(facts, "compositor").weight == Weight::refusal);
    facts.system = {};
    facts.system.is_wayland = true;
    CHECK(is_doubted(facts, "Wayland's compositor"));
}

TEST_CASE("another monitor of the same X screen is named, and what to do where pictures are copied",
          "[unit]") {
    TimingFacts facts = flipping_screen();
    CHECK(way_finding_of(facts, "other monitors").what == "absent");
    facts.output.neighbours = {"HDMI-1"};
    CHECK(way_finding_of(facts, "other monitors").weight == Weight::risk);
    CHECK(way_finding_of(facts, "other monitors").finding.find("xrandr --output HDMI-1 --off") !=
          std::string::npos);
    CHECK(doubts_about_times(facts).empty());
    facts.swap_modes = SwapModes{.copied = 600};
    CHECK(is_doubted(facts, "xrandr --output HDMI-1 --off"));
}

TEST_CASE("without the claim what proves no times is a risk, and nothing else changes", "[unit]") {
    TimingFacts facts = flipping_screen();
    facts.swap_modes = SwapModes{.copied = 600};
    facts.system.has_compositor = true;
    facts.blanks_are_real = false;
    for (const ScreenFinding& finding : without_claim(judge_timing(facts, 120.0, "the protocol"))) {
        INFO(finding.what);
        CHECK(finding.weight != Weight::refusal);
        // Nobody saw the refreshes that would have to be counted.
        CHECK(finding.finding.find("refreshes missed") == std::string::npos);
    }
}
