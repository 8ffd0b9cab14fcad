/// Whatever goes wrong with a display, the ledger says it, and says nothing else.
#include "app/bench/fault_simulation.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("the ledger gives back every fault of random scripts, and nothing else", "[unit]") {
    int misses = 0, wrong_stamps = 0, bare = 0;
    for (std::uint64_t index = 0; index < 400; ++index) {
        const FaultScript script = random_script(77, index);
        const SimulatedPresentation presentation = simulate_presentation(script);
        CAPTURE(index, script.refresh_hz, script.faults.jitter_sd_ms, script.faults.counts_refreshes);
        REQUIRE(gives_back(presentation, script, fit_of(presentation, script)));
        REQUIRE(accounts_for_all(presentation));
        misses += static_cast<int>(script.misses.size());
        wrong_stamps += static_cast<int>(script.wrong_stamps.size());
        bare += !script.faults.counts_refreshes;
    }
    CHECK(misses > 500);
    CHECK(wrong_stamps > 200);
    CHECK(bare > 100);
}

TEST_CASE("a ledger that differs in one thing does not pass for the script's", "[unit]") {
    FaultScript script = random_script(77, 0);
    for (std::uint64_t index = 1; script.misses.empty() || script.wrong_stamps.empty(); ++index)
        script = random_script(77, index);
    const SimulatedPresentation presentation = simulate_presentation(script);
    const LedgerFit fit = fit_of(presentation, script);
    REQUIRE(gives_back(presentation, script, fit));
    FaultScript other = script;
    ++other.misses.front().refresh_in_trial;
    CHECK_FALSE(gives_back(presentation, other, fit));
    other = script;
    ++other.misses.front().count;
    CHECK_FALSE(gives_back(presentation, other, fit));
    other = script;
    other.misses.pop_back();
    CHECK_FALSE(gives_back(presentation, other, fit));
    other = script;
    other.wrong_stamps.push_back(900);
    CHECK_FALSE(gives_back(presentation, other, fit));
    SimulatedPresentation swapped = presentation;
    ++swapped.lit[100].value;
    CHECK_FALSE(gives_back(swapped, script, fit));
    swapped = presentation;
    swapped.flips.erase(swapped.flips.begin() + 100);
    CHECK_FALSE(accounts_for_all(swapped));
}

TEST_CASE("drift of the display's clock is measured, and no miss is made of it", "[unit]") {
    FaultScript script;
    script.faults.drift_ppm = 150.0;
    script.faults.jitter_sd_ms = 0.5;
    for (const bool counted : {true, false}) {
        script.faults.counts_refreshes = counted;
        const SimulatedPresentation presentation = simulate_presentation(script);
        const LedgerFit fit = fit_of(presentation, script);
        CHECK(fit.missed_runs().empty());
        CHECK(presentation.flips.size() == 960);
        const double nominal_ns = 1e9 / 120.0;
        const KnownInterval interval = fit.line().interval();
        CHECK(std::abs(interval.ns - nominal_ns / 1.00015) < 4.0 * interval.uncertainty_ns);
        CHECK(interval.uncertainty_ns < 1e-5 * nominal_ns);
    }
}
