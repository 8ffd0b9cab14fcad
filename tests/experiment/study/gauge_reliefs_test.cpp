/// Planted gain and shear come back from settings in the camera's perspective.
#include "experiment/study/gauge_reliefs.h"

#include <cmath>

#include <catch2/catch.hpp>
#include <glm/glm.hpp>

#include "experiment/base/random.h"

using namespace overt;

namespace {

/// Settings on a ball of radius 100 whose middle is 800 before the camera: the depth's rise by `gain`, with
/// `shear` to the right and noise.
std::vector<GaugeSettingRow> on_a_ball(const std::string& observer, double gain, double shear, double noise,
                                       int times = 1, std::uint64_t seed = 5) {
    RandomStream random(seed, "settings");
    std::vector<GaugeSettingRow> rows;
    for (int i = 0; i < 80; ++i) {
        // Evenly over the cap that is seen at up to 50 degrees.
        const double z = random.uniform(std::cos(0.87), 1.0), turn = random.uniform(0.0, 6.2831853);
        const double flat = std::sqrt(1.0 - z * z);
        const glm::dvec3 normal(flat * std::cos(turn), flat * std::sin(turn), z);
        const glm::dvec3 place = glm::dvec3(0.0, 0.0, -800.0) + 100.0 * normal;
        const Attitude truth = attitude_of(glm::transpose(frame_of_sight(place)) * normal);
        for (int k = 0; k < times; ++k) {
            const double slant = to_radians(truth.slant).value, tilt = to_radians(truth.tilt).value;
            const double right = gain * std::tan(slant) * std::cos(tilt) + shear + noise * random.normal(),
                         up = gain * std::tan(slant) * std::sin(tilt) + noise * random.normal();
            GaugeSettingRow& row = rows.emplace_back();
            row.of.observer = observer;
            row.of.object = "ball";
            row.point = "p." + std::to_string(i + 1);
            row.x = place.x;
            row.y = place.y;
            row.z = place.z;
            row.truth = truth;
            row.set = attitude_of({right, up, 1.0});
        }
    }
    return rows;
}

StudyReliefs reckoned(std::vector<GaugeSettingRow> rows) {
    StudyReliefs reliefs;
    reliefs.settings = std::move(rows);
    reckon_reliefs(reliefs, {200, 0.95, 1});
    return reliefs;
}

} // namespace

TEST_CASE("true settings give the surface that was seen", "[unit]") {
    const StudyReliefs reliefs = reckoned(on_a_ball("P1", 1.0, 0.0, 0.0));
    REQUIRE(reliefs.reliefs.size() == 1);
    const ReliefRow& relief = reliefs.reliefs.front();
    CHECK(relief.points == 80);
    CHECK(*relief.deviation_deg == Approx(0.0).margin(1e-6));
    CHECK_FALSE(relief.repeat_sd_deg);
    CHECK(*relief.gain == Approx(1.0).margin(0.05));
    CHECK(*relief.r > 0.999);
    for (const ReliefPointRow& point : reliefs.points)
        CHECK(std::abs(*point.z - point.true_z) < 1.0); // mm, of 40
}

TEST_CASE("a gain and a shear are found by the affine fit, and turn the plain one away", "[unit]") {
    const ReliefRow relief = reckoned(on_a_ball("P1", 0.7, 0.3, 0.0)).reliefs.front();
    CHECK(*relief.affine_gain == Approx(0.7).margin(0.02));
    // Depth that grows to the right is z that falls there.
    CHECK(*relief.x_shear == Approx(-0.3).margin(0.02));
    CHECK(*relief.y_shear == Approx(0.0).margin(0.02));
    CHECK(*relief.affine_r > 0.995);
    CHECK(*relief.r < 0.9);
    CHECK(*relief.deviation_deg > 8.0);
}

TEST_CASE("attitudes tell a planted gain and shear where places lie too far apart for a relief", "[unit]") {
    // Folds: neighbours lean at random, so that no surface goes through them.
    RandomStream random(9, "folds");
    std::vector<GaugeSettingRow> rows;
    for (const char* observer : {"P1", "P2", "P3"})
        for (int i = 0; i < 60; ++i) {
            GaugeSettingRow& row = rows.emplace_back();
            row.of.observer = observer;
            row.of.object = "folds";
            row.point = "p." + std::to_string(i + 1);
            row.x = 20.0 * (i % 8);
            row.y = 20.0 * (i / 8);
            row.z = -800.0;
            const double right = random.uniform(-1.5, 1.5), up = random.uniform(-1.5, 1.5);
            row.truth = attitude_of({right, up, 1.0});
            row.set = attitude_of(
                {0.75 * right + 0.2 + 0.1 * random.normal(), 0.75 * up - 0.1 + 0.1 * random.normal(), 1.0});
        }
    // Seen so steeply that it would decide alone.
    rows[5].truth = attitude_of({12.0, 0.0, 1.0});
    rows[5].set = attitude_of({-1.0, 0.0, 1.0});
    // A setting that is on edge is no infinite one.
    rows[6].set.slant.value = 90.0;
    rows[6].truth->slant.value = 74.0;
    rows[6].set.tilt = rows[6].truth->tilt;
    const StudyReliefs reliefs = reckoned(rows);
    REQUIRE(reliefs.reliefs.size() == 4);
    for (const ReliefRow& row : reliefs.reliefs) {
        if (row.of.observer == "P1")
            continue;
        CAPTURE(row.of.observer);
        const double margin = row.of.observer.empty() ? 0.06 : 0.03;
        CHECK(*row.attitude_gain.value == Approx(0.75).margin(margin));
        CHECK(*row.attitude_x_shear == Approx(0.2).margin(0.06));
        CHECK(*row.attitude_y_shear == Approx(-0.1).margin(0.06));
        REQUIRE(row.attitude_gain.interval);
        CHECK(row.attitude_gain.interval->contains(*row.attitude_gain.value));
        CHECK(row.attitude_gain.interval->high - row.attitude_gain.interval->low < 0.5);
        CHECK(*row.attitude_r > 0.8);
        CHECK(*row.gain < 0.5);
    }
    rows.resize(2);
    const ReliefRow few = reckoned(rows).reliefs.front();
    CHECK_FALSE(few.attitude_gain.value);
    CHECK(few.attitude_gain.absent == "it needs three settings at places that lean differently");
}

TEST_CASE("repeated settings tell their spread, and all observers are put together", "[unit]") {
    std::vector<GaugeSettingRow> settings = on_a_ball("P1", 0.8, 0.0, 0.1, 4, 5);
    for (const GaugeSettingRow& row : on_a_ball("P2", 0.8, 0.0, 0.1, 4, 5))
        settings.push_back(row);
    const StudyReliefs reliefs = reckoned(settings);
    REQUIRE(reliefs.reliefs.size() == 3);
    CHECK(reliefs.reliefs.front().of.observer.empty());
    CHECK(reliefs.reliefs.front().settings == 640);
    for (const ReliefRow& relief : reliefs.reliefs) {
        CHECK(*relief.affine_gain == Approx(0.8).margin(0.06));
        // Noise of 0.1 in both components of the gradient, seen from the front, is 0.1 sqrt(2) rad.
        CHECK(*relief.repeat_sd_deg > 4.0);
        CHECK(*relief.repeat_sd_deg < 8.5);
    }
    CHECK(reliefs.points.size() == 240);
    CHECK(reliefs.points.front().point == "p.1");
    CHECK(reliefs.points[9].point == "p.10"); // by their numbers
}

TEST_CASE("steep settings are cut off, and too few places give no relief", "[unit]") {
    std::vector<GaugeSettingRow> settings = on_a_ball("P1", 1.0, 0.0, 0.0);
    settings.front().set.slant = {88.0};
    CHECK(reckoned(settings).reliefs.front().clipped == 1);
    settings.resize(2);
    const ReliefRow few = reckoned(settings).reliefs.front();
    CHECK_FALSE(few.gain);
    CHECK(few.note == "a relief needs three places at least");
    settings = on_a_ball("P1", 1.0, 0.0, 0.0);
    settings.resize(4);
    CHECK(reckoned(settings).reliefs.front().note ==
          "a comparison with the surface needs five places at least");
}
