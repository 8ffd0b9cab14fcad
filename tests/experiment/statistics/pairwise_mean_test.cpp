/// Means over pairs: known answers, and how often their intervals hold the truth.
#include "experiment/statistics/pairwise_mean.h"

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

TEST_CASE("the mean over pairs counts each pair once, and says where there is none", "[unit]") {
    PairwiseMean mean(4);
    CHECK(mean.estimate(0.95, "nobody").absent == "nobody");
    mean.add(0, 1, 1.0);
    mean.add(1, 0, 3.0); // the same pair: 2
    mean.add(2, 3, 5.0);
    CHECK(*mean.estimate(0.95, "").value == 3.5);
    // Of sums of two numbers it is twice the mean, and its interval that of Student, twice as wide.
    PairwiseMean sums(5);
    const double of_observer[5] = {1.0, 2.0, 4.0, 7.0, 11.0};
    for (std::size_t a = 0; a < 5; ++a) {
        for (std::size_t b = a + 1; b < 5; ++b)
            sums.add(a, b, of_observer[a] + of_observer[b]);
    }
    const Estimate found = sums.estimate(0.95, "");
    CHECK(*found.value == Approx(10.0));
    REQUIRE(found.interval);
    CHECK(found.interval->high - 10.0 == Approx(2.0 * 2.776445 * std::sqrt(16.5 / 5.0)).epsilon(1e-5));
}

TEST_CASE("intervals of means over pairs hold the truth as often as they say", "[unit]") {
    // Of numbers of the observers (what pairs share), of products, whose mean over one of the two is 0, and
    // of noise of the pair.
    for (const int kind : {0, 1, 2}) {
        for (const std::size_t observers : {6u, 12u}) {
            constexpr int studies = 1000;
            int holding = 0;
            for (int study = 0; study < studies; ++study) {
                RandomStream random(11, "pairs", static_cast<std::uint64_t>(study));
                std::vector<double> own(observers);
                for (double& one : own)
                    one = random.normal();
                PairwiseMean mean(observers);
                for (std::size_t a = 0; a < observers; ++a) {
                    for (std::size_t b = a + 1; b < observers; ++b)
                        mean.add(a, b,
                                 kind == 0   ? own[a] + own[b] + 0.5 * random.normal()
                                 : kind == 1 ? own[a] * own[b]
                                             : random.normal());
                }
                holding += mean.estimate(0.95, "").interval->contains(0.0);
            }
            CAPTURE(kind, observers, holding);
            CHECK(holding >= 0.93 * studies);
            CHECK(holding <= 0.998 * studies);
        }
    }
}
