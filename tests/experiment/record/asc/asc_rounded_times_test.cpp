/// Times of samples that a converter rounded to single precision.
#include "tests/experiment/record/asc/field_case.h"

using namespace overt;
using namespace overt::testing;
using namespace overt::field_case;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("times rounded to single precision are told by the rate", "[unit]") {
    ImportBench bench;
    for (const double rate_hz : {250.0, 500.0, 1000.0, 2000.0})
        for (const std::int64_t start_ms :
             {8'388'607, 8'388'609, 16'777'215, 16'777'217, 20'000'003, 33'554'431, 33'554'435, 50'000'001}) {
            CAPTURE(rate_hz, start_ms);
            constexpr int count = 400;
            const auto interval_us = static_cast<std::int64_t>(1e6 / rate_hz);
            std::string text = fmt::format("START\t{} \tLEFT\tSAMPLES\tEVENTS\n"
                                           "SAMPLES\tGAZE\tLEFT\tRATE\t{:.2f}\tTRACKING\tCR\n",
                                           start_ms, rate_hz);
            std::vector<std::int64_t> true_us;
            for (int n = 0; n < count; ++n) {
                true_us.push_back(1000 * start_ms + interval_us * n);
                const auto rounded = static_cast<float>(1e-3 * static_cast<double>(true_us.back()));
                text += fmt::format("{:.1f}\t  500.5\t  400.5\t 1000.0\t...\n", rounded);
            }
            text += fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  38.00\t  38.00\n",
                                start_ms + interval_us * count / 1000 + 1);
            const std::vector<GazeSample> samples = samples_of(bench.import(text));
            CHECK(bench.summary.survey.skipped_lines == 0);
            REQUIRE(samples.size() == static_cast<std::size_t>(count));
            for (int n = 0; n < count; ++n)
                REQUIRE(samples[static_cast<std::size_t>(n)].sampled_at.time_since_epoch().count() ==
                        true_us[static_cast<std::size_t>(n)]);
        }
}

TEST_CASE("a gap in rounded times stays one, and no time is farther off than the rounding", "[unit]") {
    ImportBench bench;
    std::string text; // no START, no rate
    std::vector<std::int64_t> true_ms;
    for (int n = 0; n < 600; ++n) {
        true_ms.push_back(20'000'001 + n + (n >= 300 ? 5000 : n >= 200 ? 7 : 0));
        text += fmt::format("{:.1f}\t  500.5\t  400.5\t 1000.0\t...\n", static_cast<float>(true_ms.back()));
    }
    const std::vector<GazeSample> samples = samples_of(bench.import(text));
    REQUIRE(samples.size() == true_ms.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        CHECK(std::abs(samples[i].sampled_at.time_since_epoch().count() - 1000 * true_ms[i]) <= 1000);

    // A tracker that is slower than it says by a hundredth: its stamps are right to a millisecond.
    std::string slow = "START\t20000001 \tLEFT\tSAMPLES\tEVENTS\n"
                       "SAMPLES\tGAZE\tLEFT\tRATE\t1000.00\tTRACKING\tCR\n";
    std::vector<double> true_of_slow_ms;
    for (int n = 0; n < 600; ++n) {
        true_of_slow_ms.push_back(20'000'001 + 1.01 * n);
        slow += fmt::format("{:.1f}\t  500.5\t  400.5\t 1000.0\t...\n",
                            static_cast<float>(true_of_slow_ms.back()));
    }
    const std::vector<GazeSample> kept = samples_of(bench.import(slow));
    REQUIRE(kept.size() == true_of_slow_ms.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
        CHECK(std::abs(1e-3 * static_cast<double>(kept[i].sampled_at.time_since_epoch().count()) -
                       true_of_slow_ms[i]) <= 2.001);
}
