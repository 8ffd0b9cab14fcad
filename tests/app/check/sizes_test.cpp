/// What `overt check` says of sizes, parts and surfaces of meshes, as a whole command.
#include <catch2/catch.hpp>

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/pictures/picture_file.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;

namespace {

const std::string bust_lines = "mesh = \"meshes/bust.ply\"";

nlohmann::json surfaces_of(const SmallExperiment& experiment) {
    const ProgramRun run = experiment.overt({"check", experiment.protocol().string(), "--json"});
    INFO(run.err);
    CHECK(run.exit_code == 0);
    return nlohmann::json::parse(run.out)["design"]["surfaces"];
}

std::string findings_on(std::string_view protocol) {
    const SmallExperiment experiment(protocol);
    return experiment.overt({"check", experiment.protocol().string()}).err;
}

/// Width of the covered part of a row, and number of pixels, of a map made by the program.
struct Silhouette {
    int pixels = 0;
    glm::ivec2 low{1 << 20}, high{-1};
};

Silhouette silhouette_of(const SmallExperiment& experiment, const std::string& object, int frame) {
    const std::filesystem::path out = experiment.folder().path() / "luts";
    const ProgramRun run =
        experiment.overt({"lut", experiment.protocol().string(), "--stimulus", object, "--frame",
                          std::to_string(frame), "--out", out.string(), "--format", "exr", "--overwrite"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    for (const auto& entry : std::filesystem::directory_iterator(out)) {
        if (entry.path().extension() != ".exr")
            continue;
        PictureFile picture(entry.path(), "map");
        const PictureHeader& header = picture.header();
        std::vector<float> values(static_cast<std::size_t>(header.size_px.x * header.size_px.y) *
                                  header.channels.size());
        picture.read(header.channel_count(), PixelType::float32, values.data());
        const auto alpha = static_cast<std::size_t>(header.channel("A"));
        Silhouette found;
        for (int i = 0; i < header.size_px.x * header.size_px.y; ++i) {
            if (values[static_cast<std::size_t>(i) * header.channels.size() + alpha] == 0.0f)
                continue;
            const glm::ivec2 place(i % header.size_px.x, i / header.size_px.x);
            ++found.pixels;
            found.low = glm::min(found.low, place);
            found.high = glm::max(found.high, place);
        }
        std::filesystem::remove(entry.path());
        return found;
    }
    FAIL("no map was written");
    return {};
}

} // namespace

TEST_CASE("check says how large each object is, and how large it is seen: as its maps have it", "[session]") {
    const SmallExperiment experiment;
    const nlohmann::json surfaces = surfaces_of(experiment);
    REQUIRE(surfaces.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const Bounds box = (i == 0 ? bust() : tall_bust()).bounds();
        for (int axis = 0; axis < 3; ++axis)
            CHECK(surfaces[i]["size"][static_cast<std::size_t>(axis)].get<double>() ==
                  Approx(box.extent()[axis]).epsilon(1e-6));
        CHECK(surfaces[i]["unit"] == "mm");
        // Frame 0 faces the observer. A pixel is half a millimetre, seen from 573.
        const Silhouette seen = silhouette_of(experiment, i == 0 ? "bust" : "tall", 0);
        const glm::dvec2 mm = 0.5 * glm::dvec2(seen.high - seen.low + 1);
        for (int axis = 0; axis < 2; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            CHECK(surfaces[i]["shown_mm"][at].get<double>() == Approx(mm[axis]).margin(1.01));
            const double deg = 2.0 * std::atan(0.5 * mm[axis] / 573.0) * 180.0 / M_PI;
            CHECK(surfaces[i]["shown_deg"][at].get<double>() == Approx(deg).margin(0.11));
        }
    }
    const ProgramRun run = experiment.overt({"check", experiment.protocol().string()});
    CHECK_THAT(run.out, Catch::Contains("mm high and") && Catch::Contains("deg) high and"));
    CHECK_THAT(run.err, !Catch::Contains("few objects") && !Catch::Contains("is that in"));
}

TEST_CASE("check doubts sizes that nobody means, and names the unit that would fit", "[session]") {
    const auto with_bust = [](const std::string& lines) {
        return findings_on(with(small_protocol, bust_lines, bust_lines + "\n" + lines));
    };
    // The bust as a file in metres or centimetres would have it.
    CHECK_THAT(with_bust("scale = 0.001"), Catch::Contains("\"bust\"") &&
                                               Catch::Contains("less than 50 mm") &&
                                               Catch::Contains("unit = \"m\" would make it"));
    CHECK_THAT(with_bust("scale = 0.1"),
               Catch::Contains("less than 50 mm") && Catch::Contains("unit = \"cm\" would make it"));
    CHECK_THAT(with_bust("scale = 1000"),
               Catch::Contains("more than 3000 mm") && Catch::Contains("scale = 0.001"));
    // What is written is meant, if it can be.
    CHECK_THAT(with_bust("scale = 0.1\nunit = \"mm\""), !Catch::Contains("few objects"));
    CHECK_THAT(with_bust("scale = 0.001\nunit = \"mm\""), Catch::Contains("less than 2 mm"));
    CHECK_THAT(with_bust("scale = 0.001\nunit = \"own\""), !Catch::Contains("few objects"));

    const auto at = [](const char* key, const char* line) {
        return findings_on(with(small_protocol, key, line));
    };
    CHECK_THAT(at("viewing_distance_mm = 573", "viewing_distance_mm = 60"),
               Catch::Contains("a viewing distance of 60 mm") &&
                   Catch::Contains("is that in cm? Then viewing_distance_mm = 600"));
    CHECK_THAT(at("viewing_distance_mm = 573", "viewing_distance_mm = 17500"),
               Catch::Contains("tenths of a millimetre? Then viewing_distance_mm = 1750"));
    CHECK_THAT(at("width_mm = 272", "width_mm = 12"),
               Catch::Contains("pixels of 0.022 mm") && Catch::Contains("is that in cm?"));
}

TEST_CASE("a concave face of many corners is its own polygon in the map that gaze meets", "[session]") {
    const std::filesystem::path cases = std::filesystem::path(OVERT_SOURCE_DIR) / "tests/data/meshes";
    std::vector<Silhouette> found;
    for (const char* file : {"C_tri.ply", "C_ngon.ply", "C_ngon.obj"}) {
        const SmallExperiment experiment(
            with(with(small_protocol, "width_px = 128\nheight_px = 128", "width_px = 180\nheight_px = 180"),
                 bust_lines, fmt::format("mesh = \"{}\"", (cases / file).string())));
        found.push_back(silhouette_of(experiment, "bust", 0));
    }
    REQUIRE(found[0].pixels > 5000);
    // Its mouth is open: it covers much less than the disc about it.
    CHECK(found[0].pixels < 0.62 * (found[0].high.x - found[0].low.x) * (found[0].high.y - found[0].low.y));
    for (const Silhouette& other : found) {
        CHECK(std::abs(other.pixels - found[0].pixels) <= found[0].pixels / 500);
        CHECK(other.low == found[0].low);
        CHECK(other.high == found[0].high);
    }
}

TEST_CASE("labels and a head are both areas of the object, and a head that is labelled in part counts whole",
          "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, bust_lines,
             bust_lines + "\nlabels = \"labels.txt\"\nhead = { planes = [[[0, 0, 200], [0, 0, 1]]], spheres "
                          "= [[0, 0, 300, 200]] }"));
    const Mesh mesh = bust();
    std::string labels = "# part 1 low\n# part 2 crown\n";
    double top = mesh.bounds().max.z;
    int crown = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const float z = (mesh.positions[t.x].z + mesh.positions[t.y].z + mesh.positions[t.z].z) / 3.0f;
        crown += double{z} > top - 30.0;
        labels += double{z} > top - 30.0 ? "2\n" : "1\n";
    }
    REQUIRE(crown > 0);
    experiment.folder().file("labels.txt", labels);
    const nlohmann::json parts = surfaces_of(experiment)[0]["part_shares"];
    INFO(parts.dump());
    for (const char* part : {"low", "low/head", "head/crown"})
        CHECK(parts.value(part, 0.0) > 0.0);
    CHECK(parts.size() == 3);
}

TEST_CASE("a picture of a stimulus has the display's background, and so has the one that a session keeps",
          "[session]") {
    const SmallExperiment experiment(with(small_protocol, "background = 0.1", "background = 0.4"));
    const auto corner_of = [](const std::filesystem::path& file) {
        PictureFile picture(file, "picture");
        std::vector<std::uint8_t> values(
            static_cast<std::size_t>(3 * picture.header().size_px.x * picture.header().size_px.y));
        picture.read(3, PixelType::bits8, values.data());
        return std::vector<int>(values.begin(), values.begin() + 3);
    };
    // 0.4 in sRGB.
    const int grey = static_cast<int>(std::lround(255.0 * (1.055 * std::pow(0.4, 1.0 / 2.4) - 0.055)));
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, std::vector<std::string>{"--live"}}) {
        const std::filesystem::path file = experiment.folder().path() / "frame.png";
        std::vector<std::string> arguments{"play",       experiment.protocol().string(),
                                           "--stimulus", "bust/matt",
                                           "--picture",  file.string(),
                                           "--context",  "osmesa"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun run = experiment.overt(arguments);
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        for (const int value : corner_of(file))
            CHECK(std::abs(value - grey) <= 1);
    }
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    int previews = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(experiment.session())) {
        if (entry.path().extension() != ".png")
            continue;
        ++previews;
        for (const int value : corner_of(entry.path()))
            CHECK(std::abs(value - grey) <= 1);
    }
    CHECK(previews > 0);
}
