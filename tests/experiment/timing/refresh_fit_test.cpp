#include "experiment/timing/refresh_fit.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/timing/refresh_count.h"

using namespace overt;

namespace {

constexpr double nominal_hz = 120.0;

/// Stamps of a display that is off its nominal rate, some refreshes passed over, with scatter.
struct Stamps {
    std::vector<StampedRefresh> stamps;
    std::vector<std::int64_t> truth;
    double interval_ns;

    Stamps(std::uint64_t seed, double drift_ppm, double jitter_ms, int count = 960)
        : interval_ns(1e9 / (nominal_hz * (1.0 + 1e-6 * drift_ppm))) {
        RandomStream random(seed, "stamps");
        std::int64_t refresh = 700;
        for (int i = 0; i < count; ++i) {
            double deviation = random.normal();
            while (std::abs(deviation) > 3.0)
                deviation = random.normal();
            const double at_ns = static_cast<double>(refresh) * interval_ns + 1e6 * jitter_ms * deviation;
            stamps.push_back({refresh, SessionTime(SessionDuration(std::llround(at_ns)))});
            truth.push_back(refresh);
            refresh += 1 + (random.below(50) == 0 ? random.below(4) : 0);
        }
    }
    double error_ms(const RefreshFit& fit, std::int64_t refresh) const {
        return 1e-6 * std::abs(static_cast<double>(fit.begin_of(refresh).time.time_since_epoch().count()) -
                               static_cast<double>(refresh) * interval_ns);
    }
};

} // namespace

TEST_CASE("the line through stamps of 1 ms scatter is right to a tenth of that", "[unit]") {
    double squares = 0.0;
    int covered = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Stamps given(seed, 80.0, 1.0);
        const RefreshFit fit(given.stamps, nominal_hz, true);
        const std::int64_t middle = given.truth[480];
        squares += std::pow(given.error_ms(fit, middle), 2);
        covered += given.error_ms(fit, middle) <= 1e3 * to_seconds(fit.begin_of(middle).uncertainty);
        CHECK(fit.jitter_sd_ns() == Approx(1e6).epsilon(0.1));
        CHECK(fit.inconsistent_count() == 0);
        CHECK(std::abs(fit.interval().ns - given.interval_ns) < 4.0 * fit.interval().uncertainty_ns);
    }
    CHECK(std::sqrt(squares / 100.0) < 0.1);
    CHECK(covered >= 88); // two standard errors: 95 of 100
}

TEST_CASE("an interval known from other presentations makes the ends as certain as the middle", "[unit]") {
    double alone = 0.0, together = 0.0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Stamps given(seed, -120.0, 1.0);
        const RefreshFit fit(given.stamps, nominal_hz, true);
        const RefreshFit helped(given.stamps, nominal_hz, true, KnownInterval{given.interval_ns, 1.0});
        alone += std::pow(given.error_ms(fit, given.truth.front()), 2);
        together += std::pow(given.error_ms(helped, given.truth.front()), 2);
        CHECK(helped.begin_of(given.truth.front()).uncertainty <
              fit.begin_of(given.truth.front()).uncertainty);
    }
    CHECK(together < 0.5 * alone);
}

TEST_CASE("without a count the refreshes are found from the stamps alone, at 119.88 Hz too", "[unit]") {
    for (const double drift_ppm : {0.0, 250.0, -1000.0}) {
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            Stamps given(seed, drift_ppm, 0.9);
            for (StampedRefresh& stamp : given.stamps)
                stamp.refresh = 700; // nothing is known but where it begins
            const RefreshFit fit(given.stamps, nominal_hz, false);
            int wrong = 0;
            for (std::size_t i = 0; i < given.truth.size(); ++i)
                wrong += fit.refresh_of(i) != given.truth[i];
            CAPTURE(drift_ppm, seed);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("wrong stamps are named, and move the line by nothing to speak of", "[unit]") {
    for (const bool counted : {true, false}) {
        Stamps given(3, 40.0, 0.05);
        const RefreshFit before(given.stamps, nominal_hz, counted);
        const std::vector<std::pair<std::size_t, double>> faults{
            {50, 1.0}, {300, -20.0}, {301, 7.0}, {800, 40.0}};
        for (const auto& [i, ms] : faults)
            given.stamps[i].stamp += from_seconds(1e-3 * ms);
        const RefreshFit fit(given.stamps, nominal_hz, counted);
        CHECK(fit.inconsistent_count() == static_cast<int>(faults.size()));
        for (const auto& [i, ms] : faults)
            CHECK(fit.is_inconsistent(i));
        for (const std::int64_t refresh : {given.truth.front(), given.truth[480], given.truth.back()})
            CHECK(std::abs(given.error_ms(fit, refresh) - given.error_ms(before, refresh)) < 0.002);
    }
}

TEST_CASE("one stamp and two are a line as well", "[unit]") {
    const std::vector<StampedRefresh> one{{7, SessionTime(std::chrono::milliseconds(1000))}};
    const RefreshFit single(one, 100.0, true);
    CHECK(single.begin_of(7).time == one[0].stamp);
    CHECK(single.begin_of(9).time == one[0].stamp + std::chrono::milliseconds(20));
    const std::vector<StampedRefresh> two{one[0], {9, SessionTime(std::chrono::milliseconds(1020))}};
    const RefreshFit pair(two, 100.0, true);
    CHECK(pair.begin_of(8).time == SessionTime(std::chrono::milliseconds(1010)));
}

TEST_CASE("counting while stamps come in is right through jitter, drift and refreshes that go by", "[unit]") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Stamps given(seed, 900.0, 0.6);
        RefreshCount count(nominal_hz);
        int wrong = 0;
        const std::int64_t first = count.at(given.stamps[0].stamp);
        for (std::size_t i = 1; i < given.truth.size(); ++i)
            wrong += count.at(given.stamps[i].stamp) - first != given.truth[i] - given.truth[0];
        CAPTURE(seed);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a stamp that was counted one too many is taken back where the next refresh goes by", "[unit]") {
    RefreshCount count(100.0);
    const auto at = [&](double refreshes) {
        return count.at(SessionTime(SessionDuration(std::llround(refreshes * 1e7))));
    };
    for (int refresh = 0; refresh < 40; ++refresh)
        REQUIRE(at(refresh) == refresh + 1);
    // Stamped six tenths late, and taken for the refresh after it. Counts only rise, so those after it are
    // one too high.
    CHECK(at(40.6) == 42);
    CHECK(at(41.0) == 43);
    CHECK(at(42.0) == 44);
    // A refresh goes by unseen, and the count is right again.
    CHECK(at(44.0) == 45);
    for (int refresh = 45; refresh < 60; ++refresh)
        CHECK(at(refresh) == refresh + 1);
}
