#include "devices/pupil/pupil_samples.h"

#include <catch2/catch.hpp>

#include "tests/support/kept_items.h"

using namespace overt;
using namespace overt::test;

namespace {

PupilDatum pupil_of(Eye eye, double time_s, double diameter_mm, double confidence = 0.95) {
    PupilDatum pupil;
    pupil.eye = eye;
    pupil.time_s = time_s;
    pupil.confidence = confidence;
    pupil.diameter_mm = diameter_mm;
    return pupil;
}

SurfaceGaze gaze_at(double time_s) {
    SurfaceGaze gaze;
    gaze.place = {0.5, 0.5};
    gaze.time_s = time_s;
    gaze.confidence = 0.95;
    gaze.from_left = gaze.from_right = true;
    return gaze;
}

PupilSamples both_eyes() {
    TrackerWish wish;
    wish.both_eyes = true;
    return {wish, {{0.0, 0.0}, 1920.0, 1080.0}, 0.6};
}

} // namespace

TEST_CASE("gaze that comes 53 ms after its pupils has their diameters, each time its own", "[unit]") {
    PupilSamples samples = both_eyes();
    KeptItems items;
    // As after a blink: pupils of 200 Hz go on while the matching of both eyes hands gaze out late.
    constexpr double interval_s = 0.005, late_s = 0.053;
    double told_s = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double now_s = interval_s * i;
        samples.take(pupil_of(Eye::left, now_s, 3.0 + 0.001 * i));
        samples.take(pupil_of(Eye::right, now_s + 0.002, 4.0 + 0.001 * i));
        for (; told_s <= now_s - late_s; told_s += interval_s)
            samples.take(gaze_at(told_s), items);
    }
    const auto found = items.all<GazeSample>();
    REQUIRE(found.size() > 350);
    for (std::size_t i = 0; i + 1 < found.size(); i += 2) {
        CHECK(found[i].pupil_area == Approx(3.0 + 0.001 * static_cast<double>(i / 2)));
        CHECK(found[i + 1].pupil_area == Approx(4.0 + 0.001 * static_cast<double>(i / 2)));
    }
}

TEST_CASE("a pupil belongs to gaze of its own time, and one of little confidence to none", "[unit]") {
    PupilSamples samples = both_eyes();
    KeptItems items;
    samples.take(pupil_of(Eye::left, 1.000, 3.0));
    samples.take(pupil_of(Eye::left, 1.010, 3.1, 0.3));
    samples.take(pupil_of(Eye::left, 1.020, 3.2));
    const auto diameter = [&](double time_s) {
        items.items.clear();
        samples.take(gaze_at(time_s), items);
        return items.all<GazeSample>().front().pupil_area;
    };
    CHECK(diameter(1.001) == 3.0f);
    CHECK(diameter(1.011) == 0.0f);
    CHECK(diameter(1.053) == 3.2f);
    CHECK(diameter(1.060) == 0.0f); // nothing was measured near it
    CHECK(items.all<GazeSample>().back().pupil_area == 0.0f);
}

TEST_CASE("what a picture tells in 2D and in 3D is one pupil, also when the next has come between",
          "[unit]") {
    PupilHistory history;
    history.take(pupil_of(Eye::right, 1.0, 3.5));
    history.take(pupil_of(Eye::right, 1.005, 3.6));
    PupilDatum flat;
    flat.time_s = 1.0;
    flat.confidence = 0.9;
    history.take(flat);
    REQUIRE(history.nearest(1.0));
    CHECK(history.nearest(1.0)->diameter_mm == 3.5);
    CHECK(history.nearest(1.0)->confidence == 0.9);
    CHECK(history.nearest(1.005)->diameter_mm == 3.6);
    for (int i = 0; i < 1000; ++i)
        history.take(pupil_of(Eye::right, 2.0 + 0.005 * i, 4.0));
    CHECK_FALSE(history.nearest(1.0));
    CHECK(history.nearest(2.0 + 0.005 * 999)->diameter_mm == 4.0);
}

TEST_CASE("of two messages on one pupil the later one counts, with what the earlier one alone knew",
          "[unit]") {
    PupilSamples samples = both_eyes();
    KeptItems items;
    PupilDatum flat = pupil_of(Eye::left, 1.0, 3.0);
    PupilDatum solid;
    solid.eye = Eye::left;
    solid.time_s = 1.0;
    solid.confidence = 0.9;
    solid.eye_mm = glm::vec3(1.0f, 2.0f, 600.0f);
    samples.take(flat);
    samples.take(solid);
    samples.take(gaze_at(1.0), items);
    CHECK(items.all<GazeSample>()[0].pupil_area == 3.0f);
    CHECK(items.all<SampleDetail>()[0].eye_mm == glm::vec3(1.0f, 2.0f, 600.0f));
    // The other way round, and with a diameter of its own.
    PupilSamples again = both_eyes();
    KeptItems others;
    again.take(solid);
    flat.diameter_mm = 3.5;
    again.take(flat);
    again.take(gaze_at(1.0), others);
    CHECK(others.all<GazeSample>()[0].pupil_area == 3.5f);
    CHECK(others.all<SampleDetail>()[0].eye_mm == glm::vec3(1.0f, 2.0f, 600.0f));
    CHECK(others.all<GazeSample>()[1].pupil_area == 0.0f); // the other eye's is not known
}

TEST_CASE(
    "gaze is on the screen by the surface's place, from the eyes that it comes from, and never goes back",
    "[unit]") {
    TrackerWish wish;
    wish.eye = Eye::right;
    PupilSamples samples(wish, {{100.0, 50.0}, 1000.0, 500.0}, 0.6);
    KeptItems items;
    SurfaceGaze gaze = gaze_at(2.0);
    gaze.place = {0.25, 0.75};
    samples.take(gaze, items);
    gaze.time_s = 1.9; // late
    samples.take(gaze, items);
    gaze.time_s = 2.0; // twice
    samples.take(gaze, items);
    gaze.time_s = 2.1;
    gaze.confidence = 0.6;
    samples.take(gaze, items);
    gaze.time_s = 2.2;
    gaze.confidence = 0.59;
    samples.take(gaze, items);
    gaze.time_s = 2.3;
    gaze.confidence = 0.95;
    gaze.from_right = false;
    samples.take(gaze, items);
    const auto found = items.all<GazeSample>();
    const auto details = items.all<SampleDetail>();
    REQUIRE(found.size() == 4);
    REQUIRE(details.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(found[i].eye == Eye::right);
        CHECK(found[i].sampled_at == tracker_time(2'000'000 + 100'000 * static_cast<std::int64_t>(i)));
        CHECK(details[i].sampled_at == found[i].sampled_at);
        CHECK(found[i].gaze.has_value() == (i < 2));
    }
    // The surface is counted from below.
    CHECK(found[0].gaze->x_px == Approx(100.0 + 250.0));
    CHECK(found[0].gaze->y_px == Approx(50.0 + 125.0));
    CHECK(details[1].confidence == 0.6f);
    CHECK(details[3].confidence == 0.0f);
}

TEST_CASE("a message of Pupil Capture that cannot be read is a gap after the last gaze, of no known length",
          "[unit]") {
    PupilSamples samples = both_eyes();
    KeptItems items;
    samples.take(gaze_at(12.5), items);
    samples.take_noise(items);
    const auto gaps = items.all<TrackerGap>();
    REQUIRE(gaps.size() == 1);
    CHECK(gaps[0].reason == TrackerGap::Reason::unreadable);
    CHECK(gaps[0].after == items.all<GazeSample>().back().sampled_at);
    CHECK(gaps[0].lost_samples == 0);
}

TEST_CASE("a pupil of up to 34 ms before or after a gaze is of it, the nearest of several", "[unit]") {
    PupilSamples samples = both_eyes();
    KeptItems items;
    const auto diameter = [&](double time_s) {
        items.items.clear();
        samples.take(gaze_at(time_s), items);
        return items.all<GazeSample>().front().pupil_area;
    };
    samples.take(pupil_of(Eye::left, 1.0, 3.0));
    CHECK(diameter(0.9655) == 0.0f);
    CHECK(diameter(0.967) == 3.0f);
    CHECK(diameter(1.0335) == 3.0f);
    CHECK(diameter(1.0345) == 0.0f);
    samples.take(pupil_of(Eye::left, 2.0, 3.5));
    samples.take(pupil_of(Eye::left, 2.020, 4.0));
    CHECK(diameter(2.009) == 3.5f);
    CHECK(diameter(2.011) == 4.0f);
}
