/// The reliability of maps: known answers, and how often its intervals hold the truth.
#include "experiment/statistics/map_agreement.h"

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/map_similarity.h"

using namespace overt;

TEST_CASE("the reliability of maps is what all their halves say on average", "[unit]") {
    RandomStream random(3, "maps of four");
    std::vector<std::vector<double>> maps(4, std::vector<double>(50));
    std::vector<double> areas(50);
    for (std::size_t v = 0; v < areas.size(); ++v) {
        areas[v] = 0.5 + random.uniform();
        const double shared = random.normal();
        for (std::vector<double>& map : maps)
            map[v] = 3.0 + shared + random.normal();
    }
    // Rulon: 1 - variance of the difference of the halves / variance of their sum.
    const auto variance = [&](const std::vector<double>& signs) {
        std::vector<double> of(areas.size(), 0.0);
        for (std::size_t i = 0; i < maps.size(); ++i) {
            for (std::size_t v = 0; v < of.size(); ++v)
                of[v] += signs[i] * maps[i][v];
        }
        const double area = std::accumulate(areas.begin(), areas.end(), 0.0),
                     mean = integral(of, areas) / area;
        double sum = 0.0;
        for (std::size_t v = 0; v < of.size(); ++v)
            sum += areas[v] * (of[v] - mean) * (of[v] - mean);
        return sum;
    };
    double of_halves = 0.0;
    for (const std::vector<double>& signs :
         {std::vector{1.0, 1.0, -1.0, -1.0}, {1.0, -1.0, 1.0, -1.0}, {1.0, -1.0, -1.0, 1.0}})
        of_halves += (1.0 - variance(signs) / variance({1.0, 1.0, 1.0, 1.0})) / 3.0;
    const MapAgreement agreement = map_agreement(maps, areas, 0.95);
    CHECK(*agreement.reliability.value == Approx(of_halves).epsilon(1e-12));
    const double r = *agreement.of_halves.value;
    CHECK(2.0 * r / (1.0 + r) == Approx(of_halves).epsilon(1e-12));
    // Of two observers there are only two halves, and no interval.
    const MapAgreement two = map_agreement(std::span(maps).first(2), areas, 0.95);
    CHECK_FALSE(two.reliability.interval);
    CHECK(map_agreement(std::span(maps).first(1), areas, 0.95).reliability.absent ==
          "halves need two observers with fixations");
    const std::vector<std::vector<double>> constant(3, std::vector<double>(50, 2.0));
    CHECK(map_agreement(constant, areas, 0.95).reliability.absent == "the maps are constant");
}

TEST_CASE("intervals of the reliability hold the truth about as often as they say", "[unit]") {
    // Maps of observers: a pattern that all have, and noise of their own. With the variances 1 and s^2 the
    // mean of n observers has the reliability 1 / (1 + s^2 / n). Places of a map are as independent as some
    // hundred of them; observers have noise of different size, as those with few fixations do.
    for (const std::size_t observers : {6u, 12u}) {
        for (const double noise : {1.0, 3.0}) {
            constexpr int places = 120, studies = 400;
            const std::vector<double> areas(places, 1.0);
            int holding = 0;
            double mean = 0.0, truth = 0.0;
            for (int i = 0; i < studies; ++i) {
                RandomStream random(7, "reliability", static_cast<std::uint64_t>(i));
                std::vector<double> pattern(places);
                for (double& value : pattern)
                    value = random.normal();
                std::vector<std::vector<double>> maps(observers, pattern);
                double noise_of_mean = 0.0;
                for (std::size_t k = 0; k < observers; ++k) {
                    const double own = noise * (k % 2 == 0 ? 0.8 : 1.2);
                    noise_of_mean += own * own / static_cast<double>(observers * observers);
                    for (double& value : maps[k])
                        value += own * random.normal();
                }
                truth = 1.0 / (1.0 + noise_of_mean);
                const MapAgreement agreement = map_agreement(maps, areas, 0.95);
                mean += *agreement.reliability.value / studies;
                holding += agreement.reliability.interval->contains(truth);
            }
            CAPTURE(observers, noise, truth, mean, holding);
            CHECK(mean == Approx(truth).margin(0.02));
            CHECK(holding >= 0.92 * studies);
            CHECK(holding <= 0.985 * studies);
        }
    }
}
