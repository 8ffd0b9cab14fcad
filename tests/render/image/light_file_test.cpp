/// Files of light as others write them: turned, exposed, in parts, in windows, in other colours.
#include <cmath>
#include <limits>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/colour/rgb_primaries.h"
#include "experiment/pictures/picture_file.h"
#include "render/image/light_probe.h"
#include "render/image/linear_image.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

std::filesystem::path light_case(const char* name) {
    return std::filesystem::path(OVERT_SOURCE_DIR) / "tests/data/light" / name;
}

LinearImage read_probe(const std::filesystem::path& file) {
    LightSettings light;
    light.probe = file.string();
    return load_light_probe(light).radiance;
}

std::string refusal_of(const std::filesystem::path& file) {
    try {
        read_probe(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

/// The largest difference of any channel, as a share of the largest value.
double largest_difference(const LinearImage& a, const LinearImage& b, double factor = 1.0) {
    if (a.size_px != b.size_px)
        return HUGE_VAL;
    double most = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            most = std::max(most,
                            std::abs(double{a.pixels[i][channel]} - factor * double{b.pixels[i][channel]}));
            largest = std::max(largest, std::abs(double{a.pixels[i][channel]}));
        }
    }
    return most / largest;
}

// A picture of 5 x 3 pixels, all different: red tells the column, green the row.
constexpr glm::ivec2 picture_px(5, 3);
glm::ivec3 mantissas(int x, int y) { return {128 + 10 * x, 100 + 20 * y, 7}; }

/// The scene's light behind those mantissas, exponent 128 (times 2^-8).
glm::dvec3 stored_light_of(int x, int y) { return glm::dvec3(mantissas(x, y)) / 256.0; }

/// As a flat Radiance file whose resolution line is this.
std::string radiance_file(const std::string& lines, char slow_sign, char slow, char fast_sign, char fast) {
    const bool rows = slow == 'Y';
    const int outer = rows ? picture_px.y : picture_px.x, inner = rows ? picture_px.x : picture_px.y;
    std::string bytes = fmt::format("#?RADIANCE\n{}\n{}{} {} {}{} {}\n", lines, slow_sign, slow, outer,
                                    fast_sign, fast, inner);
    for (int i = 0; i < outer; ++i) {
        for (int k = 0; k < inner; ++k) {
            // Y grows upwards, and a picture's rows are counted downwards.
            const int along_x = rows ? k : i, along_y = rows ? i : k;
            const char x_sign = rows ? fast_sign : slow_sign, y_sign = rows ? slow_sign : fast_sign;
            const int x = x_sign == '+' ? along_x : picture_px.x - 1 - along_x;
            const int y = y_sign == '-' ? along_y : picture_px.y - 1 - along_y;
            const glm::ivec3 m = mantissas(x, y);
            for (const int byte : {m.x, m.y, m.z, 128})
                bytes += static_cast<char>(byte);
        }
    }
    return bytes;
}

const std::string rgbe = "FORMAT=32-bit_rle_rgbe\n";

void check_light(const std::filesystem::path& file, glm::dvec3 divided_by) {
    const LinearImage image = read_linear_image(file);
    REQUIRE(image.size_px == picture_px);
    for (int y = 0; y < picture_px.y; ++y) {
        for (int x = 0; x < picture_px.x; ++x) {
            for (int channel = 0; channel < 3; ++channel)
                CHECK(double{image.at(x, y)[channel]} ==
                      Approx(stored_light_of(x, y)[channel] / divided_by[channel]).epsilon(1e-6));
        }
    }
}

/// One part of an OpenEXR file: channels of equal type with a value for each pixel of the data window.
struct ExrPart {
    std::vector<std::string> channels;
    Imf::PixelType type = Imf::FLOAT;
    glm::ivec2 data_min{0}, data_max{picture_px - 1}, display_min{0}, display_max{picture_px - 1};
};

/// Value of a channel at a place of the display window.
float value_at(std::size_t channel, int x, int y) {
    return static_cast<float>(100 * (channel + 1) + 10 * y + x);
}

void write_parts(const std::filesystem::path& file, const std::vector<ExrPart>& parts,
                 const Imf::Chromaticities* colours = nullptr) {
    std::vector<Imf::Header> headers;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const ExrPart& part = parts[i];
        const auto box = [](glm::ivec2 low, glm::ivec2 high) {
            return Imath::Box2i(Imath::V2i(low.x, low.y), Imath::V2i(high.x, high.y));
        };
        Imf::Header header(box(part.display_min, part.display_max), box(part.data_min, part.data_max));
        for (const std::string& channel : part.channels)
            header.channels().insert(channel, Imf::Channel(part.type));
        header.setName(fmt::format("part {}", i));
        header.setType(Imf::SCANLINEIMAGE);
        if (colours)
            Imf::addChromaticities(header, *colours);
        headers.push_back(header);
    }
    Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const ExrPart& part = parts[i];
        const glm::ivec2 data = part.data_max - part.data_min + 1;
        const auto pixels = static_cast<std::size_t>(data.x * data.y);
        std::vector<float> floats(pixels * part.channels.size());
        std::vector<std::uint32_t> whole(floats.size());
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < part.channels.size(); ++c) {
            for (int y = 0; y < data.y; ++y) {
                for (int x = 0; x < data.x; ++x) {
                    const std::size_t at = c * pixels + static_cast<std::size_t>(y * data.x + x);
                    const glm::ivec2 place = part.data_min - part.display_min + glm::ivec2(x, y);
                    floats[at] = value_at(c, place.x, place.y);
                    whole[at] = static_cast<std::uint32_t>(floats[at]);
                }
            }
            void* const first =
                part.type == Imf::UINT ? static_cast<void*>(&whole[c * pixels]) : &floats[c * pixels];
            buffer.insert(part.channels[c], Imf::Slice::Make(part.type, first, headers[i].dataWindow(), 4,
                                                             4 * static_cast<std::size_t>(data.x)));
        }
        Imf::OutputPart out(output, static_cast<int>(i));
        out.setFrameBuffer(buffer);
        out.writePixels(data.y);
    }
}

/// That the picture has the values of three channels, numbered in the part, black outside the data window.
void check_values(const LinearImage& image, const ExrPart& part, std::array<std::size_t, 3> channels) {
    REQUIRE(image.size_px == part.display_max - part.display_min + 1);
    for (int y = 0; y < image.size_px.y; ++y) {
        for (int x = 0; x < image.size_px.x; ++x) {
            const glm::ivec2 place = part.display_min + glm::ivec2(x, y);
            const bool is_inside = glm::all(glm::greaterThanEqual(place, part.data_min)) &&
                                   glm::all(glm::lessThanEqual(place, part.data_max));
            for (int channel = 0; channel < 3; ++channel)
                CHECK(image.at(x, y)[channel] ==
                      (is_inside ? value_at(channels[static_cast<std::size_t>(channel)], x, y) : 0.0f));
        }
    }
}

} // namespace

TEST_CASE("Radiance pictures are turned as their resolution line says, all eight ways", "[unit]") {
    const TemporaryFolder folder;
    for (const char slow_sign : {'-', '+'}) {
        for (const char fast_sign : {'-', '+'}) {
            for (const bool rows : {true, false}) {
                CAPTURE(slow_sign, fast_sign, rows);
                check_light(folder.file("turned.hdr", radiance_file(rgbe, slow_sign, rows ? 'Y' : 'X',
                                                                    fast_sign, rows ? 'X' : 'Y')),
                            glm::dvec3(1.0));
            }
        }
    }
    CHECK(largest_difference(read_probe(light_case("base.hdr")), read_probe(light_case("o_+Y+X.hdr"))) ==
          0.0);
    for (const char* line : {"-Y 3 -Y 5", "-Z 3 +X 5", "Y 3 X 5", "-Y 3", "-Y 0 +X 5", "-Y 3 +X 5 7", ""})
        CHECK_THAT(refusal_of(folder.file("no.hdr", fmt::format("#?RADIANCE\n{}\n{}\n", rgbe, line))),
                   Catch::Contains("no.hdr") && Catch::Contains("resolution"));
}

TEST_CASE("the light of a Radiance picture is divided by all of its exposures and corrections", "[unit]") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& lines, glm::dvec3 divided_by) {
        CAPTURE(lines);
        check_light(folder.file("exposed.hdr", radiance_file(lines, '-', 'Y', '+', 'X')), divided_by);
    };
    check(rgbe + "EXPOSURE=4.0\n", glm::dvec3(4.0));
    check("EXPOSURE= 2\nVIEW= -vtv\n" + rgbe + "EXPOSURE=+2.5e0\r\n", glm::dvec3(5.0));
    check(rgbe + "COLORCORR= 1 2 4\nEXPOSURE=0.5\nCOLORCORR=2 1 1\n", {1.0, 1.0, 2.0});
    // Lines of pictures that this one was made from are indented; a gamma of 1 is linear.
    check(rgbe + "pfilt -e 2\n\tEXPOSURE=16\nSOFTWARE=x EXPOSURE=3\nGAMMA=1\nPRIMARIES=0 0 0 0 0 0 0 0\n",
          glm::dvec3(1.0));
    check("", glm::dvec3(1.0));
    CHECK(largest_difference(read_probe(light_case("base.hdr")), read_probe(light_case("exposure.hdr"))) <
          1e-6);
    for (const char* line : {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=bright", "EXPOSURE=", "COLORCORR=1 2",
                             "GAMMA=2.2", "FORMAT=32-bit_rle_abcd", "PRIMARIES=0.64 0.33"})
        CHECK_THAT(
            refusal_of(folder.file("no.hdr", radiance_file(fmt::format("{}\n", line), '-', 'Y', '+', 'X'))),
            Catch::Contains("no.hdr") && Catch::Contains(std::string(line).substr(0, 8)));
}

TEST_CASE("old run lengths of Radiance are read, and what is cut off is refused", "[unit]") {
    const TemporaryFolder folder;
    const LinearImage base = read_probe(light_case("base.hdr"));
    CHECK(largest_difference(base, read_probe(light_case("old_rle.hdr"))) == 0.0);
    const std::string head = "#?RGBE\n" + rgbe + "\n-Y 1 +X 600\n";
    // One pixel, 1 more, and then 2 * 256 + 83 in two steps.
    const std::string runs("\x80\x40\x20\x81\x01\x01\x01\x01\x90\x40\x20\x81\x01\x01\x01\x55\x01\x01\x01\x02",
                           20);
    const LinearImage image = read_linear_image(folder.file("runs.hdr", head + runs));
    CHECK(image.at(1, 0).x == image.at(0, 0).x);
    CHECK(image.at(2, 0).x == 2.0f * 144.0f / 256.0f);
    CHECK(image.at(599, 0).x == image.at(2, 0).x);
    CHECK_THAT(refusal_of(folder.file("cut.hdr", head + runs.substr(0, 16))),
               Catch::Contains("scanline 1 of 1"));
    CHECK_THAT(refusal_of(folder.file("begin.hdr", head + "\x01\x01\x01\x05")),
               Catch::Contains("scanline 1 of 1"));
    CHECK_THAT(refusal_of(folder.file("head.hdr", std::string("#?RADIANCE\n") + rgbe)),
               Catch::Contains("header"));
    CHECK_THAT(refusal_of(folder.file("huge.hdr", "#?RADIANCE\n\n-Y 30000 +X 32000\n")),
               Catch::Contains("MiB"));
}

TEST_CASE("colours of another space become Rec. 709, in which white stays white", "[unit]") {
    // ACEScg; the matrix that ACES publishes for its primaries to Rec. 709, adapted by Bradford.
    const glm::dvec3 sun = glm::dvec3(1.70505, -0.13026, -0.02400) * 30.0 +
                           glm::dvec3(-0.62179, 1.14080, -0.12897) * 20.0 +
                           glm::dvec3(-0.08326, -0.01055, 1.15297) * 10.0;
    const LinearImage image = read_probe(light_case("acescg.exr"));
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(double{image.at(0, 0)[channel]} == Approx(0.2).epsilon(1e-4));
        CHECK(double{image.at(40, 3)[channel]} == Approx(sun[channel]).epsilon(1e-3));
    }
    CHECK(has_other_primaries(light_case("acescg.exr")));
    CHECK_FALSE(has_other_primaries(light_case("base.hdr")));
    CHECK(read_linear_image(light_case("acescg.exr")).at(40, 3) == glm::vec4(30.0f, 20.0f, 10.0f, 1.0f));
    // Said to be what they are, they stay.
    const glm::dmat3 same = rec709_from(rec709_primaries);
    for (int i = 0; i < 9; ++i)
        CHECK(same[i / 3][i % 3] == Approx(i % 4 == 0 ? 1.0 : 0.0).margin(1e-12));
    // ITU-R BT.709-6, item 3.2, to the digits it has.
    CHECK(xyz_from_rgb(rec709_primaries)[1].y == Approx(0.7152).margin(5e-5));

    const TemporaryFolder folder;
    const auto of_radiance = [&](const std::string& lines) {
        return read_linear_image(folder.file("p.hdr", radiance_file(lines, '-', 'Y', '+', 'X')),
                                 FrameEncoding::linear, FileColours::as_rec709);
    };
    const glm::dmat3 from_ap1 =
        rec709_from({{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}});
    const LinearImage ap1 =
        of_radiance(rgbe + "PRIMARIES= 0.713 0.293 0.165 0.830 0.128 0.044 0.32168 0.33767\n");
    // XYZ of Radiance: equal energy is white, and luminance is 179 times radiance.
    const LinearImage xyz = of_radiance("FORMAT=32-bit_rle_xyze\nEXPOSURE=0.5\n");
    const glm::dmat3 from_xyz = rec709_from({{1, 0}, {0, 1}, {0, 0}, {1.0 / 3.0, 1.0 / 3.0}});
    CHECK(glm::length(from_xyz * glm::dvec3(1.0) - glm::dvec3(1.0)) < 1e-9);
    for (int x = 0; x < picture_px.x; ++x) {
        const glm::dvec3 a = from_ap1 * stored_light_of(x, 1),
                         b = from_xyz * stored_light_of(x, 1) / (0.5 * 179.0);
        for (int channel = 0; channel < 3; ++channel) {
            CHECK(double{ap1.at(x, 1)[channel]} == Approx(a[channel]).epsilon(1e-5).margin(1e-6));
            CHECK(double{xyz.at(x, 1)[channel]} == Approx(b[channel]).epsilon(1e-5).margin(1e-8));
        }
    }
    // A space that is none is refused by what it says.
    const Imf::Chromaticities line({0.1f, 0.1f}, {0.2f, 0.2f}, {0.3f, 0.3f}, {0.3f, 0.3f});
    write_parts(folder.path() / "line.exr", {{{"B", "G", "R"}, Imf::FLOAT, {0, 0}, {3, 1}, {0, 0}, {3, 1}}},
                &line);
    CHECK_THAT(refusal_of(folder.path() / "line.exr"),
               Catch::Contains("line.exr") && Catch::Contains("no space of colours"));
}

TEST_CASE("an OpenEXR picture is its display window, black outside the data window", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "window.exr";
    for (const ExrPart& part :
         {ExrPart{{"B", "G", "R"}, Imf::FLOAT, {1, 1}, {3, 1}, {0, 0}, {4, 2}},         // smaller
          ExrPart{{"B", "G", "R"}, Imf::HALF, {-2, -1}, {6, 4}, {0, 0}, {4, 2}},        // larger
          ExrPart{{"B", "G", "R"}, Imf::FLOAT, {12, 22}, {17, 22}, {10, 20}, {14, 22}}, // beside
          ExrPart{{"B", "G", "R"}, Imf::FLOAT, {-5, -5}, {-3, -4}, {0, 0}, {4, 2}}}) {  // nothing of it
        ExrPart stored = part;
        stored.type = Imf::FLOAT;
        write_parts(file, {stored});
        check_values(read_linear_image(file), stored, {2, 1, 0});
        CHECK(image_size_px(file) == picture_px);
    }
    const LinearImage crop = read_probe(light_case("dw_crop.exr"));
    CHECK(crop.size_px == glm::ivec2(64, 32));
    CHECK(crop.at(0, 0) == glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    CHECK(crop.at(40, 3).x == 30.0f);
}

TEST_CASE(
    "of an OpenEXR picture the colours are taken, wherever they stand, and none are made of anything else",
    "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "parts.exr";
    // Behind a part of depth; beside other channels; in a layer; as whole numbers.
    const ExrPart depth{{"Z"}}, light{{"B", "G", "R"}};
    write_parts(file, {depth, light});
    check_values(read_linear_image(file), light, {2, 1, 0});
    const ExrPart mixed{{"A", "B", "G", "N.X", "N.Y", "N.Z", "R", "Z"}};
    write_parts(file, {mixed});
    check_values(read_linear_image(file), mixed, {6, 2, 1});
    CHECK(read_linear_image(file).at(1, 1).w == value_at(0, 1, 1));
    CHECK(has_alpha(file));
    const ExrPart layer{{"Depth.V", "beauty.B", "beauty.G", "beauty.R"}};
    write_parts(file, {layer});
    check_values(read_linear_image(file), layer, {3, 2, 1});
    CHECK_FALSE(has_alpha(file));
    const ExrPart whole{{"B", "G", "R"}, Imf::UINT};
    write_parts(file, {whole});
    check_values(read_linear_image(file), whole, {2, 1, 0});
    const ExrPart grey{{"Y"}};
    write_parts(file, {grey});
    check_values(read_linear_image(file), grey, {0, 0, 0});
    // Tristimulus values, as frames are exported, and not a grey of their Y.
    const ExrPart tristimulus{{"A", "X", "Y", "Z"}};
    write_parts(file, {tristimulus});
    check_values(read_linear_image(file), tristimulus, {1, 2, 3});
    CHECK(has_other_primaries(file));
    const glm::dvec3 xyz(value_at(1, 1, 1), value_at(2, 1, 1), value_at(3, 1, 1));
    const glm::dvec3 rec709 = glm::inverse(xyz_from_rgb(rec709_primaries)) * xyz;
    const LinearImage converted = read_linear_image(file, FrameEncoding::linear, FileColours::as_rec709);
    for (int channel = 0; channel < 3; ++channel)
        CHECK(double{converted.at(1, 1)[channel]} == Approx(rec709[channel]).epsilon(1e-5));

    CHECK_THAT(refusal_of(light_case("Z_only.exr")),
               Catch::Contains("Z_only.exr") && Catch::Contains("depth and no colours"));
    write_parts(file, {{{"id"}, Imf::UINT}});
    CHECK_THAT(refusal_of(file), Catch::Contains("no colours") && Catch::Contains("id"));
    write_parts(file, {{{"N.X", "N.Y", "N.Z"}}, {{"Z"}}});
    CHECK_THAT(refusal_of(file), Catch::Contains("no colours"));
    write_parts(file, {{{"diffuse.B", "diffuse.G", "diffuse.R", "gloss.B", "gloss.G", "gloss.R"}}});
    CHECK_THAT(refusal_of(file), Catch::Contains("several layers") && Catch::Contains("gloss.R"));
}

TEST_CASE("a sun that did not fit is refused with its place and a remedy", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "sun.exr";
    LinearImage image(glm::ivec2(8, 4));
    for (const bool is_infinite : {true, false}) {
        image.at(5, 2).y = is_infinite ? HUGE_VALF : std::numeric_limits<float>::quiet_NaN();
        write_picture(file, {image.size_px, {"R", "G", "B", "A"}, PixelType::float16, 3, {}},
                      PixelType::float32, image.pixels.data());
        CHECK_THAT(refusal_of(file), Catch::Contains("sun.exr: pixel (5, 2)") &&
                                         Catch::Contains(is_infinite ? "65504" : "fixnan"));
    }
}

TEST_CASE("a picture of a camera that was turned stands upright", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "turned.tif";
    // EXIF 2.3, tag 0x0112: where row 0 and column 0 of the file are in the scene.
    for (int orientation = 1; orientation <= 8; ++orientation) {
        CAPTURE(orientation);
        const bool swapped = orientation >= 5;
        const glm::ivec2 stored = swapped ? glm::ivec2(picture_px.y, picture_px.x) : picture_px;
        std::vector<float> values;
        for (int row = 0; row < stored.y; ++row) {
            for (int column = 0; column < stored.x; ++column) {
                const bool row_from_end =
                               orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7,
                           column_from_end =
                               orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
                // In 5 to 8 the file's rows are the scene's columns.
                const int along_row = swapped ? column : row, along_column = swapped ? row : column;
                const bool flip_y = swapped ? orientation == 7 || orientation == 8 : row_from_end,
                           flip_x = swapped ? orientation == 6 || orientation == 7 : column_from_end;
                const int y = flip_y ? picture_px.y - 1 - along_row : along_row,
                          x = flip_x ? picture_px.x - 1 - along_column : along_column;
                for (std::size_t channel = 0; channel < 3; ++channel)
                    values.push_back(value_at(channel, x, y));
            }
        }
        write_picture(file, {stored, {"R", "G", "B"}, PixelType::float32, -1, {{"Orientation", orientation}}},
                      PixelType::float32, values.data());
        check_values(read_linear_image(file), ExrPart{}, {0, 1, 2});
    }
}

TEST_CASE("what a matt surface gathers is smooth, and right for lights that can be reckoned", "[unit]") {
    LightProbe sky{LinearImage(glm::ivec2(256, 128)), 0};
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 256; ++x)
            sky.radiance.at(x, y) = glm::vec4(y < 64 ? 1.0f : 0.0f);
    }
    // An even sky gives a surface (1 + n.z) / 2 of its light.
    const LightProbe of_sky = irradiance_over_pi(sky, {64, 32});
    for (int y = 0; y < 32; ++y) {
        const double up = std::cos(M_PI * (y + 0.5) / 32);
        for (int x = 0; x < 64; x += 7)
            CHECK(double{of_sky.radiance.at(x, y).x} == Approx(0.5 * (1.0 + up)).margin(0.01));
    }
    // A small lamp gives the cosine, and so no step from one direction to the next is larger than the
    // cosine's.
    LightProbe lamp{LinearImage(glm::ivec2(256, 128)), 0};
    lamp.radiance.at(128, 64) = glm::vec4(1000.0f);
    const LightProbe of_lamp = irradiance_over_pi(lamp, {64, 32});
    float brightest = 0.0f;
    for (const glm::vec4& pixel : of_lamp.radiance.pixels)
        brightest = std::max(brightest, pixel.x);
    REQUIRE(brightest > 0.0f);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x + 1 < 64; ++x)
            CHECK(std::abs(of_lamp.radiance.at(x + 1, y).x - of_lamp.radiance.at(x, y).x) <
                  0.11f * brightest);
    }
}
