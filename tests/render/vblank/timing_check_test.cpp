#include <catch2/catch.hpp>

#include <cmath>

#include "experiment/base/random.h"
#include "render/vblank/timing_check.h"

using namespace overt;
using Weight = ScreenFinding::Weight;

namespace {

/// Flips at every refresh of a screen, but for those that are missed; stamps are late by up to `late_ms`.
std::vector<FlipReport> watched(double hz, int flips, VblankSource source, double late_ms = 0.0,
                                std::vector<int> missed_at = {}) {
    RandomStream random(7, "stamps", 1);
    std::vector<FlipReport> reports;
    std::int64_t refresh = 1000;
    for (int i = 0; i < flips; ++i) {
        refresh += 1 + static_cast<std::int64_t>(std::ranges::count(missed_at, i));
        FlipReport report;
        report.source = source;
        report.refresh = {counts_refreshes(source) ? refresh : i};
        report.vertical_blank =
            SessionTime(from_seconds(static_cast<double>(refresh) / hz + 1e-3 * late_ms * random.uniform()));
        reports.push_back(report);
    }
    return reports;
}

TimingFacts good_facts() {
    TimingFacts facts;
    facts.measured = summarise_refreshes(watched(120.0, 600, VblankSource::present_swap, 0.02));
    facts.swaps = {true, 1};
    facts.blanks_are_real = true;
    facts.output.refresh_hz = 120.0;
    facts.output.may_vary_its_refresh = false;
    facts.system.is_x11 = true;
    facts.swap_modes = SwapModes{.flipped = 600};
    return facts;
}

ScreenFinding finding_of(const TimingFacts& facts, std::string_view what, double nominal_hz = 120.0) {
    for (const ScreenFinding& finding : judge_timing(facts, nominal_hz, "the protocol"))
        if (finding.what == what)
            return finding;
    return {Weight::good, "absent", ""};
}

} // namespace

TEST_CASE("a screen's rate comes out of stamps that count, and of stamps that do not", "[unit]") {
    for (const VblankSource source : {VblankSource::drm_vblank, VblankSource::swap_return}) {
        const RefreshMeasurement found =
            summarise_refreshes(watched(119.88, 600, source, 1.0, {50, 300, 300, 301}));
        CHECK(found.source == source);
        CHECK(found.flips == 600);
        CHECK(found.mean_hz == Approx(119.88).epsilon(2e-5));
        CHECK(found.mean_se_hz < 0.01);
        CHECK(found.missed == 4);
        // The difference of two uniform numbers has a standard deviation of 1 / sqrt(6).
        CHECK(found.interval_sd_ms == Approx(1.0 / std::sqrt(6.0)).epsilon(0.1));
    }
}

TEST_CASE("stamps off the line are counted, and change neither rate nor scatter", "[unit]") {
    std::vector<FlipReport> flips = watched(100.0, 500, VblankSource::drm_vblank, 0.01);
    for (const std::size_t wrong : {100u, 250u, 400u})
        flips[wrong].vertical_blank += std::chrono::milliseconds(3);
    const RefreshMeasurement found = summarise_refreshes(flips);
    CHECK(found.outliers == 3);
    CHECK(found.mean_hz == Approx(100.0).epsilon(1e-5));
    CHECK(found.interval_sd_ms < 0.02);
}

TEST_CASE("of fewer than three flips nothing is said, and a session refused", "[unit]") {
    TimingFacts facts = good_facts();
    facts.measured = summarise_refreshes(watched(100.0, 2, VblankSource::drm_vblank));
    CHECK(facts.measured.mean_hz == 0.0);
    CHECK(finding_of(facts, "measured refresh").weight == Weight::refusal);
}

TEST_CASE("swaps tell how many pictures are queued before one waits", "[unit]") {
    const double interval = 0.010;
    const auto behaviour = [&](std::vector<double> swap_s) { return judge_swaps(swap_s, interval); };
    std::vector<double> double_buffered(20, interval);
    double_buffered[0] = 0.0001;
    CHECK(behaviour(double_buffered).wait);
    CHECK(behaviour(double_buffered).at_once == 1);

    std::vector<double> queued(20, interval);
    queued[0] = queued[1] = queued[2] = 0.0001;
    CHECK(behaviour(queued).wait);
    CHECK(behaviour(queued).at_once == 3);

    const std::vector<double> tearing(20, 0.0002);
    CHECK_FALSE(behaviour(tearing).wait);
    // One that took long for another reason is no wait for the display.
    std::vector<double> disturbed = tearing;
    disturbed[5] = 0.020;
    CHECK_FALSE(behaviour(disturbed).wait);
}

TEST_CASE("a good screen has no risk, and each thing that may disturb its times is named", "[unit]") {
    for (const ScreenFinding& finding : judge_timing(good_facts(), 120.0, "the protocol")) {
        INFO(finding.what << ": " << finding.finding);
        CHECK(finding.weight == Weight::good);
    }
    TimingFacts facts = good_facts();
    facts.swaps = {false, 24};
    CHECK(finding_of(facts, "swaps").weight == Weight::risk);
    CHECK(finding_of(facts, "swaps").finding.find("tear") != std::string::npos);

    facts = good_facts();
    facts.swaps = {true, 3};
    CHECK(finding_of(facts, "swaps").weight == Weight::good); // the source tells when each was lit
    facts.measured.source = VblankSource::drm_vblank;
    CHECK(finding_of(facts, "swaps").weight == Weight::risk);
    CHECK(finding_of(facts, "swaps").finding.find("triple") != std::string::npos);

    facts = good_facts();
    facts.blanks_are_real = false;
    CHECK(finding_of(facts, "vertical blank").weight == Weight::refusal);
    facts = good_facts();
    facts.measured.source = VblankSource::swap_return;
    facts.refused_sources = {"GLX_OML_sync_control: the server does not offer it"};
    CHECK(finding_of(facts, "vertical blank").weight == Weight::refusal);
    CHECK(finding_of(facts, "vertical blank").finding.find("does not offer") != std::string::npos);

    facts = good_facts();
    facts.output.may_vary_its_refresh = true;
    CHECK(finding_of(facts, "variable refresh").weight == Weight::risk);
    facts.output.may_vary_its_refresh.reset();
    CHECK(finding_of(facts, "variable refresh").what == "absent");

    facts = good_facts();
    facts.output.refresh_hz = 60.0; // the window is shown with another screen's refreshes
    CHECK(finding_of(facts, "screen").weight == Weight::refusal);
    CHECK_THAT(finding_of(facts, "screen").finding, Catch::Matchers::Contains("another screen's"));
    facts.blanks_are_real = false; // the server's own 60 Hz, by which a protocol of 60 Hz misses nothing
    facts.measured = summarise_refreshes(watched(60.0, 600, VblankSource::present_count, 0.02));
    facts.output.refresh_hz = 120.0;
    CHECK(finding_of(facts, "measured refresh", 60.0).weight == Weight::good);
    CHECK(finding_of(facts, "screen", 60.0).weight == Weight::refusal);
    CHECK_THAT(finding_of(facts, "screen", 60.0).finding, Catch::Matchers::Contains("a timer of the server"));

    facts = good_facts();
    facts.measured.interval_sd_ms = 1.0;
    CHECK(finding_of(facts, "regularity").weight == Weight::risk);
    facts = good_facts();
    facts.measured.missed = 20;
    CHECK(finding_of(facts, "regularity").weight == Weight::risk);
}

TEST_CASE("a screen that runs at another rate than the protocol says is refused, with both", "[unit]") {
    const TimingFacts facts = good_facts();
    CHECK(finding_of(facts, "measured refresh", 119.88).weight == Weight::good);
    CHECK(finding_of(facts, "measured refresh", 120.6).weight == Weight::good);
    const ScreenFinding refused = finding_of(facts, "measured refresh", 120.7);
    CHECK(refused.weight == Weight::refusal);
    CHECK(refused.finding.find("120.7 Hz") != std::string::npos);
    CHECK(refused.finding.find("120.00") != std::string::npos);
    CHECK(refused.finding.find("refresh_hz") != std::string::npos);
}

TEST_CASE("times are doubted without a source, without real blanks, and off the mode's rate; else not",
          "[unit]") {
    CHECK(doubts_about_times(good_facts()).empty());
    TimingFacts facts = good_facts();
    facts.output.refresh_hz.reset(); // a screen that names no rate cannot be asked
    CHECK(doubts_about_times(facts).empty());
    facts = good_facts();
    facts.measured.source = VblankSource::swap_return;
    CHECK(doubts_about_times(facts).size() == 1);
    facts = good_facts();
    facts.blanks_are_real = false;
    CHECK(doubts_about_times(facts).size() == 1);
    facts.output.refresh_hz = 60.0;
    CHECK(doubts_about_times(facts).size() == 2);
    facts = good_facts();
    facts.output.refresh_hz = 120.0 * 1.004;
    CHECK(doubts_about_times(facts).empty());
    facts.output.refresh_hz = 120.0 * 1.006;
    CHECK(doubts_about_times(facts).size() == 1);

    // Without the claim another mode is a risk, and another rate than the protocol's still refused.
    for (const ScreenFinding& finding : without_claim(judge_timing(facts, 60.0, "the protocol"))) {
        INFO(finding.what);
        CHECK((finding.weight == Weight::refusal) == (finding.what == "measured refresh"));
        if (finding.what == "screen")
            CHECK(finding.weight == Weight::risk);
    }
}
