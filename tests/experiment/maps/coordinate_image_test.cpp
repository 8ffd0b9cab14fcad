#include "experiment/maps/coordinate_image.h"

#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/maps/coordinate_codec.h"
#include "experiment/maps/coordinate_image_file.h"
#include "experiment/pictures/picture_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

const Bounds whole_box{{-31.25, 4.0, 1000.1}, {17.3, 4.5, 1900.7}};

glm::dvec3 place_in(const Bounds& bounds, RandomStream& random) {
    return bounds.min +
           glm::dvec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)) * bounds.extent();
}

/// A map with a covered disc in the middle and random places on it.
CoordinateImage disc(glm::ivec2 size) {
    CoordinateImage image(size);
    RandomStream random(5, "disc");
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            if (glm::length(glm::dvec2(x, y) - 0.5 * glm::dvec2(size)) < 0.4 * size.y)
                image.at(x, y) = glm::vec4(place_in(whole_box, random), 1.0f);
        }
    }
    return image;
}

MapDescription full_description() {
    MapDescription description;
    description.object = "bust";
    description.unit = "mm";
    description.bounds = whole_box;
    description.scale = 65535;
    description.camera = Camera{{0.1, -1234.5678901234567, 3.0}, {1.0 / 3.0, 0.0, 3.0}, {11.987654321}};
    description.angle = Degrees{-24.863013698630137};
    description.frame = 17;
    description.mesh_sha256 = std::string(64, 'a');
    return description;
}

void check_same(const MapDescription& read, const MapDescription& given) {
    CHECK(read.object == given.object);
    CHECK(read.unit == given.unit);
    CHECK(read.mesh_sha256 == given.mesh_sha256);
    CHECK(read.frame == given.frame);
    REQUIRE(read.bounds);
    CHECK(read.bounds->min == given.bounds->min);
    CHECK(read.bounds->max == given.bounds->max);
    REQUIRE(read.camera);
    CHECK(read.camera->position == given.camera->position);
    CHECK(read.camera->target == given.camera->target);
    CHECK(read.camera->vertical_fov.value == given.camera->vertical_fov.value);
    REQUIRE(read.angle);
    CHECK(read.angle->value == given.angle->value);
}

/// Writes a picture as other programs would, without a word on what it means.
template <class Value>
std::filesystem::path foreign(const std::filesystem::path& file, PixelType type,
                              const std::vector<std::string>& channels, const std::vector<Value>& values) {
    const int count = static_cast<int>(channels.size());
    write_picture(file,
                  {{static_cast<int>(values.size()) / count, 1},
                   channels,
                   type,
                   count == 4 ? 3 : -1,
                   {{"oiio:UnassociatedAlpha", 1}}},
                  type, values.data());
    return file;
}

} // namespace

TEST_CASE("a decoded place is within half a code of the place that was coded", "[unit]") {
    RandomStream random(1, "places");
    const CoordinateCodec codec(whole_box);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 place = place_in(whole_box, random);
        const glm::dvec3 error = glm::abs(codec.decode(codec.encode(place)) - place);
        for (int axis = 0; axis < 3; ++axis)
            REQUIRE(error[axis] <= 0.5 * codec.step()[axis] * (1.0 + 1e-9));
    }
}

TEST_CASE("every code stands for itself, in both scales", "[unit]") {
    for (const int scale : {CoordinateCodec::usual_scale, CoordinateCodec::paper_scale}) {
        const CoordinateCodec codec(whole_box, scale);
        for (int i = 0; i <= 65535; ++i) {
            const CoordinateCode code(static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(65535 - i),
                                      static_cast<std::uint16_t>(i * 7919 % 65536));
            REQUIRE(codec.encode(codec.decode(code)) == code);
        }
    }
}

TEST_CASE("the ends of the box are coded exactly, and what lies outside is taken to them", "[unit]") {
    const CoordinateCodec codec(whole_box);
    CHECK(codec.decode(CoordinateCode(0)) == whole_box.min);
    CHECK(codec.decode(CoordinateCode(65535)) == whole_box.max);
    CHECK(codec.encode(whole_box.min) == CoordinateCode(0));
    CHECK(codec.encode(whole_box.max) == CoordinateCode(65535));
    CHECK(codec.encode(whole_box.min - 5.0) == CoordinateCode(0));
    CHECK(codec.encode(whole_box.max + 5.0) == CoordinateCode(65535));
}

TEST_CASE("the paper's scale keeps its formula, and the far side of the box within its largest code",
          "[unit]") {
    const CoordinateCodec codec({{0, 0, 0}, {65536, 65536, 65536}}, CoordinateCodec::paper_scale);
    CHECK(codec.decode({1, 2, 65535}) == glm::dvec3(1, 2, 65535));
    CHECK(codec.encode({65536, 65535.6, 65535.4}) == CoordinateCode(65535));
}

TEST_CASE("an axis without extent is coded by 0 and comes back exactly", "[unit]") {
    const CoordinateCodec codec({{-1, 0.3, 0}, {1, 0.3, 2}});
    const CoordinateCode code = codec.encode({0.5, 0.3, 1.0});
    CHECK(code.y == 0);
    CHECK(codec.decode(code).y == 0.3);
}

TEST_CASE("a box of no size at all, a reversed one and a scale of neither kind are refused", "[unit]") {
    CHECK_NOTHROW(CoordinateCodec({{1, 1, 1}, {1, 1, 1}}));
    CHECK_THROWS_AS(CoordinateCodec({{1, 0, 0}, {0, 1, 1}}), InputError);
    CHECK_THROWS_AS(CoordinateCodec({{0, 0, 0}, {1, NAN, 1}}), InputError);
    CHECK_THROWS_WITH(CoordinateCodec(whole_box, 255), Catch::Contains("65535 or 65536, not 255"));
}

TEST_CASE("a map comes back from EXR bit for bit, with all that is known of it", "[unit]") {
    const test::TemporaryFolder folder;
    const CoordinateImage image = disc({61, 40});
    MapDescription description = full_description();
    description.scale.reset(); // floats have none
    write_coordinate_exr(folder.path() / "map.exr", image, description);
    const CoordinateImageFile read = read_coordinate_image(folder.path() / "map.exr");
    CHECK(read.image.pixels == image.pixels);
    CHECK(read.image.size_px == image.size_px);
    CHECK(read.mixed_px == 0);
    check_same(read.description, description);
}

TEST_CASE("another reader finds the coordinates in the channels X, Y, Z and A of the EXR", "[unit]") {
    const test::TemporaryFolder folder;
    const CoordinateImage image = disc({20, 30});
    write_coordinate_exr(folder.path() / "map.exr", image, full_description());
    PictureFile picture(folder.path() / "map.exr", "picture");
    const PictureHeader& header = picture.header();
    REQUIRE(header.channels.size() == 4);
    CHECK(header.type == PixelType::float32);
    std::vector<float> values(4 * image.pixels.size());
    picture.read(4, PixelType::float32, values.data());
    const std::string names = "XYZA";
    for (int component = 0; component < 4; ++component) {
        const int channel = header.channel(names.substr(static_cast<std::size_t>(component), 1));
        REQUIRE(channel >= 0);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            REQUIRE(values[4 * i + static_cast<std::size_t>(channel)] == image.pixels[i][component]);
    }
}

TEST_CASE("a map comes back from PNG within half a code, with all that is known of it", "[unit]") {
    const test::TemporaryFolder folder;
    const CoordinateImage image = disc({61, 40});
    for (const int scale : {65535, 65536}) {
        MapDescription description = full_description();
        description.scale = scale;
        write_coordinate_png(folder.path() / "map.png", image, description);
        const CoordinateImageFile read = read_coordinate_image(folder.path() / "map.png");
        check_same(read.description, description);
        CHECK(read.description.scale == scale);
        const glm::dvec3 half = 0.5 * CoordinateCodec(whole_box, scale).step();
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            REQUIRE(read.image.pixels[i].w == image.pixels[i].w);
            const glm::dvec3 error = glm::abs(glm::dvec3(read.image.pixels[i] - image.pixels[i]));
            // Coordinates near 1900 are floats of steps of 1.2e-4.
            REQUIRE(glm::all(glm::lessThanEqual(error, half + 1.3e-4)));
        }
    }
}

TEST_CASE("the codes in the PNG are those of the codec, and nothing asks for another gamma", "[unit]") {
    const test::TemporaryFolder folder;
    const CoordinateImage image = disc({32, 32});
    write_coordinate_png(folder.path() / "map.png", image, full_description());
    PictureFile picture(folder.path() / "map.png", "picture", StraightColours::as_they_stand);
    CHECK(picture.header().type == PixelType::bits16);
    std::vector<std::uint16_t> codes(image.pixels.size() * 4);
    picture.read(4, PixelType::bits16, codes.data());
    const CoordinateCodec codec(whole_box);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const bool covered = image.pixels[i].w != 0.0f;
        const CoordinateCode wanted = covered ? codec.encode(glm::dvec3(image.pixels[i])) : CoordinateCode(0);
        REQUIRE(CoordinateCode(codes[4 * i], codes[4 * i + 1], codes[4 * i + 2]) == wanted);
        REQUIRE(codes[4 * i + 3] == (covered ? 65535 : 0));
    }
    std::ifstream stream(folder.path() / "map.png", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    for (const char* chunk : {"gAMA", "sRGB", "iCCP", "cHRM"})
        CHECK(bytes.find(chunk) == std::string::npos);
    const auto json = nlohmann::json::parse(std::ifstream(folder.path() / "map.json"));
    CHECK(json["scale"] == 65535);
    CHECK(json["size_px"] == nlohmann::json({32, 32}));
    CHECK(json["camera"]["vertical_fov_deg"] == full_description().camera->vertical_fov.value);
}

TEST_CASE("a map that cannot be written leaves nothing behind", "[unit]") {
    const test::TemporaryFolder folder;
    CHECK_THROWS_AS(write_coordinate_exr(folder.path() / "none" / "map.exr", disc({8, 8}), {}), RecordError);
    CHECK_THROWS_AS(
        write_coordinate_png(folder.path() / "none" / "map.png", disc({8, 8}), full_description()),
        RecordError);
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("maps made elsewhere are read with the box and the scale that are given", "[unit]") {
    const test::TemporaryFolder folder;
    MapDescription known;
    known.bounds = Bounds{{-1, -2, -3}, {1, 2, 3}};
    const std::uint16_t full = 65535;

    SECTION("codes with alpha: what is partly covered mixes surfaces and is left out") {
        const auto file =
            foreign<std::uint16_t>(folder.path() / "a.png", PixelType::bits16, {"R", "G", "B", "A"},
                                   {0, 0, 0, full, full, full, full, full, 9, 9, 9, 30000, 0, 0, 0, 0});
        known.scale = 65535;
        const CoordinateImageFile map = read_coordinate_image(file, known);
        CHECK(map.image.at(0, 0) == glm::vec4(-1, -2, -3, 1));
        CHECK(map.image.at(1, 0) == glm::vec4(1, 2, 3, 1));
        CHECK(map.image.covered_pixels() == 2);
        CHECK(map.mixed_px == 1);
    }
    SECTION("codes without alpha: black is off the object") {
        const auto file = foreign<std::uint16_t>(folder.path() / "b.png", PixelType::bits16, {"R", "G", "B"},
                                                 {0, 0, 0, 32768, 32768, 32768});
        known.scale = 65536;
        const CoordinateImageFile map = read_coordinate_image(file, known);
        CHECK_FALSE(map.image.covers(0, 0));
        CHECK(map.image.at(1, 0) == glm::vec4(0, 0, 0, 1));
    }
    SECTION("shares of the box as floats") {
        const auto file = foreign<float>(folder.path() / "c.exr", PixelType::float32, {"R", "G", "B", "A"},
                                         {0.25f, 0.5f, 1.0f, 1.0f, 0, 0, 0, 0});
        const CoordinateImageFile map = read_coordinate_image(file, known);
        CHECK(map.image.at(0, 0) == glm::vec4(-0.5f, 0.0f, 3.0f, 1.0f));
        CHECK_FALSE(map.image.covers(1, 0));
    }
    SECTION("the sidecar says what the protocol does not") {
        const auto file = foreign<std::uint16_t>(folder.path() / "d.png", PixelType::bits16, {"R", "G", "B"},
                                                 {full, 0, full});
        std::ofstream(folder.path() / "d.json")
            << R"({"scale": 65535, "bounds": {"min": [0, 0, 0], "max": [10, 10, 10]}, "by": "somebody"})";
        CHECK(read_coordinate_image(file).image.at(0, 0) == glm::vec4(10, 0, 10, 1));
        known.bounds.reset();
        known.scale = 65536;
        CHECK_THROWS_WITH(read_coordinate_image(file, known),
                          Catch::Contains("scale") && Catch::Contains("twice") && Catch::Contains("d.json"));
    }
}

TEST_CASE("a map without its box or scale is refused with the remedy", "[unit]") {
    const test::TemporaryFolder folder;
    const auto png =
        foreign<std::uint16_t>(folder.path() / "a.png", PixelType::bits16, {"R", "G", "B"}, {1, 2, 3});
    CHECK_THROWS_WITH(read_coordinate_image(png), Catch::Contains("a.png") && Catch::Contains("a.json") &&
                                                      Catch::Contains("lut_scale") &&
                                                      Catch::Contains("bounding box"));
    MapDescription no_scale;
    no_scale.bounds = whole_box;
    CHECK_THROWS_WITH(read_coordinate_image(png, no_scale), Catch::Contains("scale"));
    MapDescription odd = no_scale;
    odd.scale = 256;
    CHECK_THROWS_WITH(read_coordinate_image(png, odd), Catch::Contains("a.png") && Catch::Contains("256"));
    const auto exr =
        foreign<float>(folder.path() / "b.exr", PixelType::float32, {"R", "G", "B"}, {0.1f, 0.2f, 0.3f});
    CHECK_THROWS_WITH(read_coordinate_image(exr), Catch::Contains("bounding box"));
    CHECK_NOTHROW(read_coordinate_image(exr, no_scale));
}

TEST_CASE("pictures that are no maps are refused by name and reason", "[unit]") {
    const test::TemporaryFolder folder;
    MapDescription known;
    known.bounds = whole_box;
    known.scale = 65535;
    const auto refusal = [&](const std::filesystem::path& file) {
        try {
            read_coordinate_image(file, known);
        } catch (const InputError& error) {
            std::string message = error.what();
            CHECK(message.find(file.filename().string()) != std::string::npos);
            return message;
        }
        return std::string("it was read");
    };
    using Catch::Contains;
    CHECK_THAT(
        refusal(foreign<std::uint8_t>(folder.path() / "8.png", PixelType::bits8, {"R", "G", "B"}, {1, 2, 3})),
        Contains("16 bits"));
    CHECK_THAT(refusal(foreign<std::uint16_t>(folder.path() / "half.exr", PixelType::float16, {"X", "Y", "Z"},
                                              {1, 2, 3})),
               Contains("32-bit floats") && Contains("half"));
    CHECK_THAT(refusal(foreign<float>(folder.path() / "nan.exr", PixelType::float32, {"X", "Y", "Z"},
                                      {1, 2, 3, 4, NAN, 6})),
               Contains("pixel (1, 0)") && Contains("finite"));
    CHECK_THAT(refusal(foreign<float>(folder.path() / "share.exr", PixelType::float32, {"R", "G", "B"},
                                      {0.5f, 1.5f, 0.5f})),
               Contains("0 … 1"));
    CHECK_THAT(refusal(foreign<std::uint16_t>(folder.path() / "empty.png", PixelType::bits16,
                                              {"R", "G", "B", "A"}, {1, 2, 3, 0})),
               Contains("no pixel is covered"));
    std::ofstream(folder.path() / "noise.png") << "this is no picture";
    CHECK_THAT(refusal(folder.path() / "noise.png"), Contains("cannot be read"));
    CHECK_THAT(refusal(folder.path() / "none.png"), Contains("cannot be read"));
}

TEST_CASE("a sidecar that is damaged is refused by file and key", "[unit]") {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a.json";
    using Catch::Contains;
    CHECK_FALSE(read_sidecar(file));
    const auto refusal = [&](const char* text) {
        std::ofstream(file) << text;
        try {
            read_sidecar(file);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("it was read");
    };
    CHECK_THAT(refusal("{"), Contains("a.json") && Contains("no JSON"));
    CHECK_THAT(refusal("[]"), Contains("an object"));
    CHECK_THAT(refusal(R"({"scale": "65535"})"), Contains("scale must be a whole number"));
    CHECK_THAT(refusal(R"({"bounds": {"min": [0, 0, 0]}})"), Contains("bounds.max must be given"));
    CHECK_THAT(refusal(R"({"bounds": {"min": [0, 0], "max": [1, 1, 1]}})"),
               Contains("bounds.min must be a list of three numbers"));
    CHECK_THAT(refusal(R"({"bounds": 5})"), Contains("bounds must be an object"));
    CHECK_THAT(refusal(R"({"camera": {"position": [0, 0, 0], "target": [0, 1, 0]}})"),
               Contains("camera.vertical_fov_deg"));
}
