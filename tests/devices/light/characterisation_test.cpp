/// Characterising a display whose truth is known.
#include <cmath>

#include <catch2/catch.hpp>

#include "devices/simulated/simulated_display.h"
#include "experiment/base/error.h"
#include "experiment/colour/characterisation_fit.h"
#include "experiment/colour/characterisation_text.h"
#include "experiment/colour/patch_plan.h"
#include "experiment/protocol/files/characterisation_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

std::vector<PatchReading> readings_of(const DisplayTruth& truth, std::uint64_t seed,
                                      const PatchPlanSettings& plan = {}) {
    SimulatedPhotometer photometer(truth, seed);
    std::vector<PatchReading> readings;
    for (const glm::dvec3& signal : plan_patches(plan))
        readings.push_back({signal, photometer.measure_xyz(signal)});
    return readings;
}

/// The largest errors of a model against the truth itself, over signals from a fifth of full signal on.
struct TrueErrors {
    double luminance = 0.0, xy = 0.0;
};
TrueErrors errors_of(const DisplayCharacterisation& display, const DisplayTruth& truth, std::uint64_t seed) {
    RandomStream random(seed, "colours to foretell");
    TrueErrors errors;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 signal(random.uniform(0.2, 1.0), random.uniform(0.2, 1.0), random.uniform(0.2, 1.0));
        const glm::dvec3 is = truth.xyz_of(signal), said = display.xyz_of_signal(signal);
        errors.luminance = std::max(errors.luminance, std::abs(said.y / is.y - 1.0));
        const glm::dvec2 off = chromaticity_of(said) - chromaticity_of(is);
        errors.xy = std::max({errors.xy, std::abs(off.x), std::abs(off.y)});
    }
    return errors;
}

} // namespace

TEST_CASE("the truth comes back from noisy readings: luminance within 0.5 %, x and y within 0.001",
          "[unit]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const DisplayTruth truth = DisplayTruth::drawn(seed);
        const auto readings = readings_of(truth, 100 + seed);
        const CharacterisationFit fit = fit_characterisation(readings, CurveModel::table);
        const TrueErrors errors = errors_of(fit.display, truth, seed);
        CAPTURE(seed);
        CHECK(errors.luminance < 0.005);
        CHECK(errors.xy < 0.001);
        // What the readings say of themselves is of the same size.
        const CharacterisationCheck check = check_characterisation(fit.display, readings);
        CHECK(check.patches >= 30);
        CHECK(check.luminance_mean < 0.005);
        CHECK(check.xy_mean < 0.001);
        CHECK(*check.additivity < 0.005);
        CHECK(*check.dependence < 0.005);
        CHECK(fit.repeat_noise == Approx(truth.reading_noise).epsilon(0.3));
    }
}

TEST_CASE("a power's gain, offset and exponent come back", "[unit]") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        DisplayTruth truth = DisplayTruth::drawn(seed);
        truth.shoulders = {};
        const CharacterisationFit fit = fit_characterisation(readings_of(truth, seed), CurveModel::power);
        for (std::size_t i = 0; i < 3; ++i) {
            CAPTURE(seed, i);
            CHECK(fit.channels[i].power.exponent() == Approx(truth.exponents[i]).margin(0.03));
            CHECK(fit.channels[i].power.offset() == Approx(truth.offsets[i]).margin(0.01));
            CHECK(fit.channels[i].gain == Approx(1.0).margin(0.004));
        }
        const TrueErrors errors = errors_of(fit.display, truth, seed);
        CHECK(errors.luminance < 0.005);
        CHECK(errors.xy < 0.001);
    }
}

TEST_CASE("without noise a power is found to the last digits, and the table at its points", "[unit]") {
    DisplayTruth truth = DisplayTruth::drawn(3);
    truth.shoulders = {};
    truth.reading_noise = truth.dark_noise_cd_m2 = 0.0;
    const auto readings = readings_of(truth, 1);
    const CharacterisationFit fit = fit_characterisation(readings, CurveModel::power);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(fit.channels[i].power.exponent() == Approx(truth.exponents[i]).epsilon(1e-5));
    const CharacterisationFit table = fit_characterisation(readings, CurveModel::table);
    for (const PatchReading& reading : readings) {
        const bool is_single = (reading.signal.x > 0) + (reading.signal.y > 0) + (reading.signal.z > 0) == 1;
        if (is_single)
            CHECK(table.display.xyz_of_signal(reading.signal).y == Approx(reading.xyz.y).epsilon(1e-9));
    }
    CHECK(fit.repeat_noise < 1e-9);
}

TEST_CASE("channels that take light from each other are found out", "[unit]") {
    DisplayTruth truth = DisplayTruth::drawn(5);
    truth.crosstalk = 0.04;
    const auto readings = readings_of(truth, 2);
    const CharacterisationFit fit = fit_characterisation(readings, CurveModel::table);
    const CharacterisationCheck check = check_characterisation(fit.display, readings);
    CHECK(*check.additivity == Approx(0.04).epsilon(0.2));
    CHECK(*check.dependence > 0.004);
    CHECK(check.luminance_worst > 0.02);
    CHECK_THAT(characterisation_report(fit.display, fit, check), Catch::Contains("white is 4"));
}

TEST_CASE("what readings lack is said", "[unit]") {
    const auto readings = readings_of(DisplayTruth::drawn(1), 1);
    const auto without = [&](auto is_out) {
        std::vector<PatchReading> left = readings;
        std::erase_if(left, is_out);
        return left;
    };
    using Catch::Contains;
    CHECK_THROWS_WITH(
        fit_characterisation(without([](const PatchReading& r) { return r.signal == glm::dvec3(0.0); }),
                             CurveModel::table),
        Contains("black was not read"));
    CHECK_THROWS_WITH(
        fit_characterisation(without([](const PatchReading& r) { return r.signal == glm::dvec3(0, 1, 0); }),
                             CurveModel::table),
        Contains("green alone was not read at full signal"));
    CHECK_THROWS_WITH(fit_characterisation(
                          without([](const PatchReading& r) { return r.signal.z > 0.0 && r.signal.z < 1.0; }),
                          CurveModel::table),
                      Contains("blue alone was read at 1 levels"));
    auto swapped = readings;
    for (PatchReading& reading : swapped) {
        if (reading.signal == glm::dvec3(0, 0, 1))
            reading.xyz = {0.0, 0.0, 0.0};
    }
    CHECK_THROWS_AS(fit_characterisation(swapped, CurveModel::table), InputError);
    CHECK(check_characterisation(fit_characterisation(readings, CurveModel::table).display,
                                 without([](const PatchReading& r) {
                                     return (r.signal.x > 0) + (r.signal.y > 0) + (r.signal.z > 0) > 1;
                                 }))
              .patches == 0);
}

TEST_CASE("the order of patches is the seed's, each repeat has each patch once", "[unit]") {
    const PatchPlanSettings settings{9, 6, 3, 7};
    const auto plan = plan_patches(settings), again = plan_patches(settings);
    CHECK(plan == again);
    CHECK(plan != plan_patches({9, 6, 3, 8}));
    const std::size_t count = plan.size() / 3;
    CHECK(plan.size() == 3 * (5 + 3 * 9 + 6));
    const auto sorted = [&](std::size_t repeat) {
        std::vector<glm::dvec3> part(plan.begin() + static_cast<std::ptrdiff_t>(repeat * count),
                                     plan.begin() + static_cast<std::ptrdiff_t>((repeat + 1) * count));
        std::sort(part.begin(), part.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        return part;
    };
    CHECK(sorted(0) == sorted(1));
    CHECK(sorted(0) == sorted(2));
}

TEST_CASE("a characterisation that is written is read back as it was", "[unit]") {
    const TemporaryFolder folder;
    const auto readings = readings_of(DisplayTruth::drawn(4), 4);
    for (const CurveModel model : {CurveModel::table, CurveModel::power}) {
        DisplayCharacterisation written = fit_characterisation(readings, model).display;
        written.display = "a \"quoted\" display \\ with\ttab";
        written.date = "2026-11-21";
        written.instrument = "µ-photometer";
        written.screen.width_px = 1920;
        written.screen.refresh_hz = 119.98;
        Diagnostics diagnostics;
        const auto read = read_characterisation(folder.file("d.toml", characterisation_toml(written)),
                                                "d.toml", {}, diagnostics);
        INFO(diagnostics.print());
        REQUIRE(read);
        CHECK(read->display == written.display);
        CHECK(read->instrument == written.instrument);
        CHECK(read->screen.width_px == 1920);
        CHECK(read->screen.refresh_hz == 119.98);
        CHECK(read->black_xyz == written.black_xyz);
        for (std::size_t i = 0; i < 3; ++i) {
            for (int axis = 0; axis < 3; ++axis)
                CHECK(read->primaries_xyz[i][axis] == Approx(written.primaries_xyz[i][axis]).epsilon(1e-12));
            for (int code = 0; code <= 1000; ++code)
                CHECK(read->curves[i].light_of(code / 1000.0) == written.curves[i].light_of(code / 1000.0));
        }
    }
}

TEST_CASE("the noise of repeated readings is that of a sample: n - 1 of n are free", "[unit]") {
    // Two readings of each patch, 1 % above and below their mean: the sample's standard deviation is
    // sqrt(2) %, not the 1 % of the two about their mean.
    DisplayTruth truth = DisplayTruth::drawn(3);
    truth.reading_noise = truth.dark_noise_cd_m2 = 0.0;
    std::vector<PatchReading> readings;
    std::vector<glm::dvec3> seen;
    for (const PatchReading& reading : readings_of(truth, 1)) {
        if (std::find(seen.begin(), seen.end(), reading.signal) != seen.end())
            continue;
        seen.push_back(reading.signal);
        for (const double factor : {0.99, 1.01}) {
            readings.push_back(reading);
            readings.back().xyz *= factor;
        }
    }
    const CharacterisationFit fit = fit_characterisation(readings, CurveModel::table);
    CHECK(fit.repeat_noise == Approx(0.01 * std::sqrt(2.0)).epsilon(1e-6));
}

TEST_CASE("a level that was read darker than the one below it becomes level with it, and is counted",
          "[unit]") {
    DisplayTruth truth = DisplayTruth::drawn(3);
    truth.shoulders = {};
    truth.reading_noise = truth.dark_noise_cd_m2 = 0.0;
    std::vector<PatchReading> readings = readings_of(truth, 1);
    std::vector<double> reds;
    for (const PatchReading& reading : readings)
        if (reading.signal.y == 0.0 && reading.signal.z == 0.0 && reading.signal.x > 0.0)
            reds.push_back(reading.signal.x);
    std::sort(reds.begin(), reds.end());
    reds.erase(std::unique(reds.begin(), reds.end()), reds.end());
    REQUIRE(reds.size() >= 6);
    const double low = reds[reds.size() / 2], high = reds[reds.size() / 2 + 1];
    const glm::dvec3 of_low = truth.xyz_of({low, 0.0, 0.0}), of_high = truth.xyz_of({high, 0.0, 0.0});
    CHECK(fit_characterisation(readings, CurveModel::table).channels[0].levelled == 0);
    for (PatchReading& reading : readings) {
        if (reading.signal == glm::dvec3(low, 0.0, 0.0))
            reading.xyz = of_high;
        else if (reading.signal == glm::dvec3(high, 0.0, 0.0))
            reading.xyz = of_low;
    }
    const CharacterisationFit fit = fit_characterisation(readings, CurveModel::table);
    CHECK(fit.channels[0].levelled == 2);
    CHECK(fit.channels[1].levelled == 0);
    const double between = 0.5 * (of_low.y + of_high.y);
    CHECK(fit.display.xyz_of_signal({low, 0.0, 0.0}).y == Approx(between).epsilon(1e-6));
    CHECK(fit.display.xyz_of_signal({high, 0.0, 0.0}).y == Approx(between).epsilon(1e-6));
}

TEST_CASE("a display that is known by its numbers gives the light that they say", "[unit]") {
    DisplayTruth truth;
    truth.black_xyz = {0.1, 0.2, 0.3};
    truth.primaries_xyz = {glm::dvec3(40.0, 20.0, 2.0), glm::dvec3(30.0, 70.0, 10.0),
                           glm::dvec3(18.0, 7.0, 95.0)};
    truth.exponents = {2.0, 2.2, 2.4};
    const auto same = [](const glm::dvec3& a, const glm::dvec3& b) {
        for (int axis = 0; axis < 3; ++axis)
            CHECK(a[axis] == Approx(b[axis]).margin(1e-12));
    };
    same(truth.xyz_of(glm::dvec3(0.0)), truth.black_xyz);
    same(truth.xyz_of({-0.5, 0.0, 0.0}), truth.black_xyz);
    const glm::dvec3 white =
        truth.black_xyz + truth.primaries_xyz[0] + truth.primaries_xyz[1] + truth.primaries_xyz[2];
    same(truth.xyz_of(glm::dvec3(1.0)), white);
    same(truth.xyz_of(glm::dvec3(1.7)), white);
    for (std::size_t i = 0; i < 3; ++i) {
        glm::dvec3 signal(0.0);
        signal[static_cast<int>(i)] = 0.5;
        same(truth.xyz_of(signal),
             truth.black_xyz + std::pow(0.5, truth.exponents[i]) * truth.primaries_xyz[i]);
    }
    // A shoulder bends the middle by a quarter of itself, an offset lifts or cuts the low end.
    truth.shoulders[0] = 0.12;
    same(truth.xyz_of({0.5, 0.0, 0.0}), truth.black_xyz + 0.25 * 1.03 * truth.primaries_xyz[0]);
    same(truth.xyz_of({0.2, 0.0, 0.0}),
         truth.black_xyz + 0.04 * (1.0 + 0.12 * 0.16) * truth.primaries_xyz[0]);
    same(truth.xyz_of({1.0, 0.0, 0.0}), truth.black_xyz + truth.primaries_xyz[0]);
    truth.shoulders[0] = 0.0;
    truth.offsets[0] = 0.1;
    same(truth.xyz_of({0.5, 0.0, 0.0}),
         truth.black_xyz + (0.55 * 0.55 - 0.01) / 0.99 * truth.primaries_xyz[0]);
    truth.offsets[0] = -0.1;
    same(truth.xyz_of({0.05, 0.0, 0.0}), truth.black_xyz);
    same(truth.xyz_of({0.5, 0.0, 0.0}), truth.black_xyz + 0.45 * 0.45 * truth.primaries_xyz[0]);
    truth.offsets[0] = 0.0;
    // By crosstalk a channel sinks by half the share for each other one that is fully lit.
    truth.crosstalk = 0.1;
    same(truth.xyz_of({1.0, 0.0, 0.0}), truth.black_xyz + truth.primaries_xyz[0]);
    same(truth.xyz_of({1.0, 1.0, 0.0}),
         truth.black_xyz + 0.95 * (truth.primaries_xyz[0] + truth.primaries_xyz[1]));
    same(truth.xyz_of(glm::dvec3(1.0)), truth.black_xyz + 0.9 * (white - truth.black_xyz));
}

TEST_CASE("displays that are drawn lie within what is usual, each its own", "[unit]") {
    const std::array<glm::dvec3, 3> usual{glm::dvec3(43.0, 22.5, 2.1), glm::dvec3(35.0, 70.0, 11.5),
                                          glm::dvec3(18.5, 7.5, 97.0)};
    const glm::dvec3 black(0.1, 0.11, 0.17);
    glm::dvec3 lowest(10.0), highest(0.0);
    double least_shoulder = 1.0, most_shoulder = -1.0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const DisplayTruth truth = DisplayTruth::drawn(seed);
        for (std::size_t i = 0; i < 3; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(truth.primaries_xyz[i][axis] >= usual[i][axis] * 0.9 * 0.97);
                CHECK(truth.primaries_xyz[i][axis] <= usual[i][axis] * 1.1 * 1.03);
            }
            CHECK(truth.exponents[i] >= 1.9);
            CHECK(truth.exponents[i] <= 2.5);
            CHECK(truth.offsets[i] >= -0.02);
            CHECK(truth.offsets[i] <= 0.01);
            CHECK(std::abs(truth.shoulders[i]) <= 0.15);
            least_shoulder = std::min(least_shoulder, truth.shoulders[i]);
            most_shoulder = std::max(most_shoulder, truth.shoulders[i]);
        }
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(truth.black_xyz[axis] >= 0.7 * black[axis]);
            CHECK(truth.black_xyz[axis] <= 1.3 * black[axis]);
        }
        lowest = glm::min(lowest, truth.black_xyz / black);
        highest = glm::max(highest, truth.black_xyz / black);
        CHECK(truth.crosstalk == 0.0);
    }
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(lowest[axis] < 0.75);
        CHECK(highest[axis] > 1.25);
    }
    CHECK(least_shoulder < -0.14);
    CHECK(most_shoulder > 0.14);
    // A photometer's readings are true on average, and spread by its shares.
    DisplayTruth truth = DisplayTruth::drawn(1);
    truth.reading_noise = 0.01;
    truth.dark_noise_cd_m2 = 0.0;
    SimulatedPhotometer photometer(truth, 2);
    const glm::dvec3 wanted = truth.xyz_of({0.7, 0.5, 0.3});
    glm::dvec3 sum(0.0), squares(0.0);
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 off = photometer.measure_xyz({0.7, 0.5, 0.3}) / wanted - 1.0;
        sum += off / 4000.0;
        squares += off * off / 4000.0;
    }
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(sum[axis]) < 4.0 * 0.01 / std::sqrt(4000.0));
        CHECK(std::sqrt(squares[axis]) == Approx(0.01).epsilon(0.05));
    }
}
