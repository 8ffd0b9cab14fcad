/// Effects of factors within observers: with two levels the sign flips of differences; no more is found than
/// chance allows, whatever levels vary at and whatever is missing; what lies beside has no part in it.
#include "experiment/statistics/factor_tests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

namespace {

/// Numbers of observers at each cell; nothing: missing.
FactorTrials trials_of(std::size_t observers, std::size_t cells,
                       const std::function<std::optional<double>(std::size_t, std::size_t)>& value) {
    FactorTrials trials;
    for (std::size_t observer = 0; observer < observers; ++observer) {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            if (const auto number = value(observer, cell)) {
                trials.values.push_back(*number);
                trials.observers.push_back(observer);
                trials.cells.push_back(cell);
            }
        }
    }
    return trials;
}

/// Beside an interaction: what each factor does by itself.
void add_single_factors(FactorTrials& trials, std::size_t levels_of_b) {
    trials.beside.resize(2);
    for (const std::size_t cell : trials.cells) {
        trials.beside[0].push_back(cell / levels_of_b);
        trials.beside[1].push_back(cell % levels_of_b);
    }
}

FactorTrials normal_trials(std::uint64_t seed, std::size_t observers, std::size_t cells, double effect) {
    return trials_of(observers, cells, [=](std::size_t observer, std::size_t cell) {
        RandomStream random(seed, "made-up observers", observer * 100 + cell);
        return std::optional(10.0 * static_cast<double>(observer) + random.normal() +
                             (cell == 0 ? effect : 0.0));
    });
}

} // namespace

TEST_CASE("an effect of two levels is the sign flip of observers' differences", "[unit]") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const FactorTrials trials = normal_trials(seed, 9, 2, 0.8);
        std::vector<double> differences;
        double sum = 0.0, squares = 0.0;
        for (std::size_t observer = 0; observer < 9; ++observer) {
            differences.push_back(trials.values[2 * observer] - trials.values[2 * observer + 1]);
            sum += differences.back();
            squares += differences.back() * differences.back();
        }
        const auto test = main_effect_test(trials, 2);
        REQUIRE(test);
        CHECK(test->test.is_exact);
        CHECK(test->test.p == sign_flip_test(differences)->p);
        CHECK(test->statistic == Approx(std::abs(sum) / std::sqrt(squares)));
        CHECK(test->least_p == 2.0 / 512.0);
        CHECK(test->observers == 9);
    }
}

TEST_CASE("an interaction of two by two is the sign flip of the difference of differences", "[unit]") {
    FactorTrials trials = normal_trials(7, 10, 4, 0.9);
    std::vector<double> contrasts;
    for (std::size_t i = 0; i < trials.values.size(); i += 4)
        contrasts.push_back(trials.values[i] - trials.values[i + 1] - trials.values[i + 2] +
                            trials.values[i + 3]);
    add_single_factors(trials, 2);
    const auto test = interaction_test(trials, 2, 2);
    REQUIRE(test);
    CHECK(test->test.p == sign_flip_test(contrasts)->p);
    CHECK(test->observers == 10);
    CHECK(test->least_p == 2.0 / 1024.0);
}

TEST_CASE("of three levels the difference of two counts that is largest against its own scatter", "[unit]") {
    const FactorTrials trials = normal_trials(5, 6, 3, 1.5);
    const auto largest = [&](unsigned flips) {
        double size = 0.0;
        for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u)}) {
            double sum = 0.0, squares = 0.0;
            for (unsigned observer = 0; observer < 6; ++observer) {
                const double difference = trials.values[3 * observer + a] - trials.values[3 * observer + b];
                sum += flips >> observer & 1u ? -difference : difference;
                squares += difference * difference;
            }
            size = std::max(size, sum * sum / squares);
        }
        return size;
    };
    int hits = 0;
    for (unsigned flips = 0; flips < 64; ++flips)
        hits += largest(flips) >= largest(0) * (1.0 - 1e-9);
    const auto test = main_effect_test(trials, 3);
    REQUIRE(test);
    CHECK(test->test.p == hits / 64.0);
    CHECK(test->statistic == Approx(std::sqrt(largest(0))));
}

TEST_CASE("what lies beside has no part in an effect, whatever is missing", "[unit]") {
    const auto value = [](double rows, double columns) {
        return [=](std::size_t observer, std::size_t cell) -> std::optional<double> {
            if ((observer * 7 + cell) % 9 == 0)
                return std::nullopt;
            RandomStream random(8, "made-up observers", observer * 100 + cell);
            return random.normal() + rows * static_cast<double>(cell / 3) +
                   columns * static_cast<double>(cell % 3) * static_cast<double>(cell % 3);
        };
    };
    FactorTrials plain = trials_of(6, 6, value(0.0, 0.0)), moved = trials_of(6, 6, value(5.0, -2.0));
    add_single_factors(plain, 3);
    add_single_factors(moved, 3);
    const auto before = interaction_test(plain, 2, 3), after = interaction_test(moved, 2, 3);
    REQUIRE(before);
    CHECK(after->statistic == Approx(before->statistic).epsilon(1e-9));
    CHECK(after->test.p == before->test.p);
    CHECK(before->observers == 6); // who lack a cell stay
    // Of the columns, with the rows beside.
    for (FactorTrials* trials : {&plain, &moved}) {
        trials->beside = {trials->beside[0]};
        for (std::size_t& cell : trials->cells)
            cell %= 3;
    }
    const auto effect = main_effect_test(moved, 3);
    CHECK(effect->test.p == effect->least_p); // -2 and -8 of a scatter of 1
    for (std::size_t i = 0; i < moved.values.size(); ++i)
        moved.values[i] += 2.0 * static_cast<double>(moved.cells[i] * moved.cells[i]);
    CHECK(main_effect_test(moved, 3)->statistic == Approx(main_effect_test(plain, 3)->statistic));
}

TEST_CASE("without an effect few studies find one, though observers differ at one level alone and trials are "
          "missing",
          "[unit]") {
    // One level, or one level's cells, at which observers differ ten times as much as at the others.
    for (const std::size_t observers : {6u, 12u, 24u}) {
        for (const bool of_cells : {false, true}) {
            int main_effects = 0, interactions = 0;
            constexpr int studies = 300;
            for (int study = 0; study < studies; ++study) {
                RandomStream random(3, "null studies",
                                    static_cast<std::uint64_t>(study) * 100 + observers +
                                        1000000u * of_cells);
                FactorTrials trials;
                std::vector<std::size_t> columns;
                for (std::size_t observer = 0; observer < observers; ++observer) {
                    std::array<double, 3> own{};
                    for (std::size_t a = 0; a < 3; ++a)
                        own[a] = (!of_cells && a == 2 ? 2.0 : 0.2) * random.normal();
                    for (std::size_t cell = 0; cell < 6; ++cell) {
                        const double of_cell = (of_cells && cell / 2 == 2 ? 2.0 : 0.2) * random.normal();
                        const double number = own[cell / 2] + of_cell + 0.3 * random.normal();
                        if (random.uniform() < 0.1)
                            continue;
                        trials.values.push_back(number);
                        trials.observers.push_back(observer);
                        trials.cells.push_back(cell);
                    }
                }
                add_single_factors(trials, 2);
                PermutationSettings settings;
                settings.permutations = 99;
                settings.most_exact = 2048;
                settings.seed = static_cast<std::uint64_t>(study);
                interactions += interaction_test(trials, 3, 2, settings)->test.p <= 0.05;
                trials.beside = {trials.beside[1]};
                for (std::size_t& cell : trials.cells)
                    cell /= 2;
                main_effects += main_effect_test(trials, 3, settings)->test.p <= 0.05;
            }
            CAPTURE(observers, of_cells);
            // Binomial with 5 % of 300: no more than 28 with probability 0.999.
            CHECK(main_effects <= 28);
            CHECK(interactions <= 28);
        }
    }
}

TEST_CASE("observers without two levels are left out, and one alone is no test", "[unit]") {
    FactorTrials trials;
    trials.values = {1.0, 2.0, 5.0};
    trials.observers = {0, 0, 1};
    trials.cells = {0, 2, 1};
    CHECK_FALSE(main_effect_test(trials, 3));
    CHECK_FALSE(main_effect_test({}, 3));
    CHECK_FALSE(interaction_test({}, 2, 2));
    trials.values.insert(trials.values.end(), {1.0, 4.0});
    trials.observers.insert(trials.observers.end(), {2, 2});
    trials.cells.insert(trials.cells.end(), {1, 2});
    const auto test = main_effect_test(trials, 3);
    REQUIRE(test);
    CHECK(test->observers == 2);
    CHECK(test->least_p == 0.5);
}

TEST_CASE("values that are all the same are no effect", "[unit]") {
    const auto test =
        main_effect_test(trials_of(7, 3, [](std::size_t, std::size_t) { return std::optional(0.3); }), 3);
    REQUIRE(test);
    CHECK(test->test.p == 1.0);
    CHECK(test->statistic == 0.0);
}
