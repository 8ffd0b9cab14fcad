#include "devices/pupil/pupil_message.h"

#include <limits>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "devices/pupil/pupil_samples.h"
#include "tests/support/kept_items.h"

using namespace overt;
using nlohmann::json;

namespace {

std::string message_of(const json& map) {
    std::string bytes;
    json::to_msgpack(map, bytes);
    return bytes;
}

json pupil_map() {
    return {{"id", 1},           {"timestamp", 1234.5678},
            {"confidence", 0.9}, {"norm_pos", {0.4, 0.6}},
            {"diameter", 42.25}, {"diameter_3d", 3.125},
            {"theta", 1.0},      {"sphere", {{"radius", 10.4}, {"center", {1.0, 2.0, 30.5}}}}};
}

json gaze_map(double time_s, const json& base, double confidence = 0.9) {
    return {{"norm_pos", {0.25, 0.75}},
            {"timestamp", time_s},
            {"confidence", confidence},
            {"on_surf", true},
            {"base_data", base}};
}

std::vector<SurfaceGaze> gazes_of(const json& list) {
    std::vector<SurfaceGaze> found;
    const std::string bytes =
        message_of({{"name", "screen"}, {"gaze_on_surfaces", list}, {"timestamp", 1.0}});
    CHECK(read_surface(bytes, [&](const SurfaceGaze& gaze) { found.push_back(gaze); }));
    return found;
}

} // namespace

TEST_CASE("a pupil of Pupil Capture gives its eye, time, confidence, diameters and the eye's place",
          "[unit]") {
    const auto datum = read_pupil_datum(message_of(pupil_map()));
    REQUIRE(datum);
    CHECK(datum->eye == Eye::left);
    CHECK(datum->time_s == 1234.5678);
    CHECK(datum->confidence == 0.9);
    CHECK(datum->diameter_mm == 3.125);
    CHECK(datum->diameter_px == 42.25);
    CHECK(datum->eye_mm == glm::vec3(1.0f, 2.0f, 30.5f));
    json flat = pupil_map(); // as the detector in 2D has it
    flat.erase("diameter_3d");
    flat.erase("sphere");
    flat["id"] = 0;
    CHECK(read_pupil_datum(message_of(flat))->eye == Eye::right);
    CHECK_FALSE(read_pupil_datum(message_of(flat))->diameter_mm);
    for (const char* key : {"id", "timestamp", "confidence"}) {
        json without = pupil_map();
        without.erase(key);
        CHECK_FALSE(read_pupil_datum(message_of(without)));
        without[key] = "text";
        CHECK_FALSE(read_pupil_datum(message_of(without)));
    }
    CHECK_FALSE(read_pupil_datum(message_of(json::array({1, 2}))));
}

TEST_CASE("gaze on a surface tells which eyes it was reckoned from", "[unit]") {
    const auto gazes = gazes_of({gaze_map(1.0, {"gaze.3d.01.", 1.0}),
                                 gaze_map(2.0, {"gaze.2d.0.", 2.0}),
                                 gaze_map(3.0, {"gaze.3d.1.", 3.0}),
                                 gaze_map(4.0, nullptr),
                                 {{"norm_pos", {0.1, 0.2}}},
                                 json("no map"),
                                 gaze_map(5.0, {"gaze"})});
    REQUIRE(gazes.size() == 5);
    CHECK((gazes[0].from_left && gazes[0].from_right));
    CHECK((!gazes[1].from_left && gazes[1].from_right));
    CHECK((gazes[2].from_left && !gazes[2].from_right));
    CHECK((!gazes[3].from_left && !gazes[3].from_right));
    CHECK(gazes[0].place == glm::dvec2(0.25, 0.75));
    CHECK(gazes[1].time_s == 2.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(gazes_of({gaze_map(nan, nullptr)}).empty());
}

TEST_CASE("gaze on a surface becomes samples in px, y downward, with each eye's own pupil", "[unit]") {
    TrackerWish wish;
    wish.both_eyes = true;
    test::KeptItems items;
    PupilSamples samples(wish, {{100.0, 50.0}, 1000.0, 800.0}, 0.6);
    PupilDatum pupil;
    pupil.eye = Eye::left;
    pupil.time_s = 10.0;
    pupil.confidence = 0.9;
    pupil.diameter_mm = 4.5;
    samples.take(pupil);
    pupil.eye = Eye::right;
    pupil.diameter_mm = 3.5;
    samples.take(pupil);
    SurfaceGaze gaze{{0.25, 0.75}, 10.01, 0.9, true, true};
    samples.take(gaze, items);
    gaze.time_s = 10.02;
    gaze.from_left = false;
    samples.take(gaze, items);
    gaze.time_s = 10.015; // told late
    samples.take(gaze, items);
    gaze.time_s = 10.5; // long after the last pupils
    gaze.confidence = 0.59;
    samples.take(gaze, items);
    const auto told = items.all<GazeSample>();
    REQUIRE(told.size() == 6);
    CHECK(told[0].sampled_at == tracker_time(10'010'000));
    CHECK(told[0].eye == Eye::left);
    REQUIRE(told[0].gaze);
    CHECK(told[0].gaze->x_px == Approx(350.0)); // 100 + 0.25 * 1000
    CHECK(told[0].gaze->y_px == Approx(250.0)); // 50 + (1 - 0.75) * 800
    CHECK(told[0].pupil_area == 4.5f);
    CHECK(told[1].pupil_area == 3.5f);
    CHECK_FALSE(told[2].gaze);
    CHECK(told[3].gaze);
    CHECK_FALSE(told[5].gaze);
    CHECK(told[5].pupil_area == 0.0f);
    const auto details = items.all<SampleDetail>();
    REQUIRE(details.size() == 6);
    CHECK(details[0].confidence == 0.9f);
    CHECK(details[2].confidence == 0.0f);
}

TEST_CASE("a place of Pupil Capture has all its numbers, or is none", "[unit]") {
    const auto eye_of = [](const json& centre) {
        json map = pupil_map();
        map["sphere"]["center"] = centre;
        return read_pupil_datum(message_of(map)).value().eye_mm;
    };
    CHECK(eye_of({1.0, 2.0, 3.0}) == glm::vec3(1.0f, 2.0f, 3.0f));
    CHECK(eye_of({1.0, 2.0, 3.0, "more"}) == glm::vec3(1.0f, 2.0f, 3.0f));
    CHECK_FALSE(eye_of({1.0, 2.0}));
    CHECK_FALSE(eye_of({1.0, "x", 3.0}));
    CHECK_FALSE(eye_of({1.0, 2.0, std::numeric_limits<double>::infinity()}));
    CHECK_FALSE(eye_of("nowhere"));
    json gaze = gaze_map(2.0, json::array());
    gaze["norm_pos"] = {0.25, "x"};
    CHECK(gazes_of(json::array({gaze, gaze_map(3.0, json::array())})).size() == 1);
}
