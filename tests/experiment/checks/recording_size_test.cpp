#include "experiment/checks/recording_size.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

/// An object of 1000 vertices and 2000 triangles.
std::vector<Object> one_object() {
    Mesh mesh;
    mesh.positions.resize(1000);
    mesh.triangles.resize(2000);
    Object object;
    object.mesh = std::move(mesh);
    return {object};
}

} // namespace

TEST_CASE("a record's rows are those of its samples and flips, whatever is answered", "[unit]") {
    Protocol protocol = paper_protocol();
    protocol.answers.record = AnswerUse::none;
    protocol.screens.recording_lead_s = 0.0;
    const RecordingSize ten = recording_size(protocol, one_object(), 10, 5.0),
                        twenty = recording_size(protocol, one_object(), 20, 50.0);
    // 8 s at 2000 Hz and 120 Hz.
    CHECK(twenty.rows - ten.rows == Approx(10 * (16000 * 42.0 + 960 * 52.0)));
    CHECK(twenty.maps == ten.maps);
    CHECK(ten.maps == Approx(31 * 1024.0 * 1024.0 / 2.0));
    // Of three materials: a picture, and its light in 128 x 128 squares in each pose.
    CHECK(ten.pictures == Approx(3 * (1024.0 * 1024.0 + 31 * 128 * 128) / 2.0));
    CHECK(ten.meshes == Approx(1000 * 12 + 2000 * 14));
    CHECK(ten.answers == 0.0);
    CHECK(ten.total() == Approx(ten.rows + ten.maps + ten.meshes + ten.pictures));
    protocol.screens.recording_lead_s = 0.5;
    CHECK(recording_size(protocol, one_object(), 10, 5.0).rows - ten.rows ==
          Approx(11 * 2000 * 42.0)); // ten trials, and one in the log
}

TEST_CASE("without a tracker there are flips alone, and spoken answers take their limits", "[unit]") {
    Protocol protocol = paper_protocol();
    protocol.tracker.kind = tracker_kind_called("none");
    const RecordingSize without = recording_size(protocol, one_object(), 9, 5.0);
    CHECK(without.rows == Approx(300e3 + 10 * 960 * 52.0));
    protocol.answers.record = AnswerUse::required;
    protocol.answers.sample_rate_hz = 44100;
    protocol.answers.bits = 24;
    protocol.screens.response_min_s = 2.0;
    protocol.screens.response_max_s = 20.0;
    CHECK(recording_size(protocol, one_object(), 9, 5.0).answers == Approx(9 * 5 * 44100 * 3.0));
    CHECK(recording_size(protocol, one_object(), 9, 1.0).answers == Approx(9 * 2 * 44100 * 3.0));
    CHECK(recording_size(protocol, one_object(), 9, 500.0).answers == Approx(9 * 20 * 44100 * 3.0));
}

TEST_CASE("an object that is frames only has pictures, and maps where the protocol gives them", "[unit]") {
    Protocol protocol = paper_protocol();
    const std::vector<Object> without_mesh(1);
    const RecordingSize frames = recording_size(protocol, without_mesh, 10, 5.0);
    CHECK(frames.maps == 0.0);
    CHECK(frames.meshes == 0.0);
    CHECK(frames.pictures > 0.0);
    protocol.objects[0].lut = "maps/##.exr";
    CHECK(recording_size(protocol, without_mesh, 10, 5.0).maps ==
          recording_size(protocol, one_object(), 10, 5.0).maps);
}

TEST_CASE("a record's size is told in words and in JSON", "[unit]") {
    RecordingSize size;
    size.rows = 22e6;
    size.maps = 1.25e6;
    CHECK(to_text(size) == "23 MB: gaze and flips 22 MB, maps 1.2 MB");
    CHECK(to_json(size)["total_bytes"] == 23.25e6);
    CHECK(to_json(size)["gaze_and_flips_bytes"] == 22e6);
}
