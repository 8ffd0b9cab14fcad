/// What becomes of trials whose drift check fails.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr Degrees good{0.3}, bad{3.0};

Sitting with_policy(const std::string& policy, std::vector<std::optional<Degrees>> drifts, int checks = 3) {
    Sitting sitting(short_protocol("[tracker]\ndrift_limit_deg = 1\non_drift = \"" + policy +
                                   "\"\ndrift_checks = " + std::to_string(checks) + "\n"));
    sitting.tracker.first_drifts = std::move(drifts);
    sitting.tracker.drift = good;
    return sitting;
}

} // namespace

TEST_CASE("a failed drift check that is only noted changes nothing else", "[unit]") {
    Sitting sitting = with_policy("note", {bad});
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.tracker.drift_checks == 2);
    CHECK(sitting.tracker.calibrations == 1);
    CHECK(sitting.log.started == std::vector<int>{0, 1});
    CHECK(sitting.log.count("drift check failed") == 1);
    CHECK(sitting.log.outcomes[0].drift->value == bad.value);
}

TEST_CASE("a failed drift check is made again, as often as the protocol says", "[unit]") {
    Sitting once = with_policy("retry", {bad, good});
    CHECK(once.run().completed_trials == 2);
    CHECK(once.tracker.drift_checks == 3);
    CHECK(once.log.started == std::vector<int>{0, 1}); // the same attempt
    CHECK(once.log.outcomes[0].drift->value == good.value);
    CHECK(once.log.count("drift check failed") == 1);

    Sitting always = with_policy("retry", {bad, std::nullopt, bad, bad, bad, bad});
    CHECK(always.run().completed_trials == 2); // it is presented all the same
    CHECK(always.tracker.drift_checks == 6);
    CHECK(always.tracker.calibrations == 1);
    CHECK(always.log.count("drift check failed") == 6);
    CHECK(always.log.outcomes[0].drift->value == bad.value);

    Sitting blind = with_policy("retry", {bad, std::nullopt}, 2);
    CHECK(blind.run().completed_trials == 2);
    CHECK_FALSE(blind.log.outcomes[0].drift); // of the last check, in which no eye was found
    CHECK(blind.tracker.drift_checks == 3);
}

TEST_CASE("a failed drift check calibrates, and the trial begins anew; not for ever", "[unit]") {
    Sitting once = with_policy("recalibrate", {bad});
    CHECK(once.run().completed_trials == 2);
    CHECK(once.tracker.calibrations == 2);
    CHECK(once.tracker.drift_checks == 3);
    CHECK(once.log.started == std::vector<int>{0, 0, 1});
    CHECK(once.log.completed == std::vector<bool>{false, true, true});

    Sitting always = with_policy("recalibrate", {bad, bad, bad, good}, 3);
    CHECK(always.run().completed_trials == 2);
    CHECK(always.tracker.calibrations == 3);
    CHECK(always.log.started == std::vector<int>{0, 0, 0, 1});
    CHECK(always.log.outcomes[2].drift->value == bad.value);

    // Each trial has checks of its own.
    Sitting both = with_policy("recalibrate", {bad, good, bad, good}, 2);
    CHECK(both.run().completed_trials == 2);
    CHECK(both.log.started == std::vector<int>{0, 0, 1, 1});
    CHECK(both.tracker.calibrations == 3);
}

TEST_CASE("a trial whose drift check fails is rejected, and comes again as rejected ones do", "[unit]") {
    Sitting sitting = with_policy("reject", {bad});
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.tracker.calibrations == 1);
    CHECK(sitting.log.started == std::vector<int>{0, 1, 0}); // at the end of the block
    CHECK(sitting.log.completed == std::vector<bool>{false, true, true});
    CHECK(sitting.log.outcomes[0].shown_refreshes == 0);
}
