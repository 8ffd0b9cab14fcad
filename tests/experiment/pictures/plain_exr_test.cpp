#include "experiment/pictures/plain_exr.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/base/whole_file.h"
#include "experiment/pictures/picture_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr glm::ivec2 size(37, 29);

/// A picture of noise with these channels, and what makes it overt's own.
std::filesystem::path noise(const TemporaryFolder& folder, const std::vector<std::string>& channels,
                            PixelType type, const std::string& compression) {
    std::filesystem::path file = folder.path() / "noise.exr";
    PictureHeader header{size, channels, type, -1, {{"compression", compression}}};
    header.alpha_channel = header.channel("A");
    header.attributes.emplace_back("overt:light", std::string("overcast"));
    header.attributes.emplace_back("overt:frame", 7);
    header.attributes.emplace_back("overt:angle_deg", -23.75);
    header.attributes.emplace_back("overt:low", glm::dvec3(1.0, -2.0, 3.5));
    RandomStream random(3, "noise");
    const std::size_t values = channels.size() * static_cast<std::size_t>(size.x * size.y);
    if (type == PixelType::bits32) {
        std::vector<std::uint32_t> codes(values);
        for (std::uint32_t& code : codes)
            code = static_cast<std::uint32_t>(random.below(1 << 30));
        write_picture(file, header, type, codes.data());
    } else {
        std::vector<float> light(values);
        for (float& value : light)
            value = static_cast<float>(40.0 * random.uniform() - 1.0);
        write_picture(file, header, PixelType::float32, light.data());
    }
    return file;
}

std::vector<std::uint32_t> bits_of(PictureDecoder& decoder, int begin, int end, int channels, PixelType as) {
    std::vector<std::uint32_t> bits(static_cast<std::size_t>((end - begin) * size.x * channels));
    CHECK(decoder.read(begin, end, channels, as, bits.data()) == "");
    return bits;
}

} // namespace

TEST_CASE("overt's own frames, light and maps are read without OpenImageIO, to the same bits", "[unit]") {
    const TemporaryFolder folder;
    struct StoredAs {
        std::vector<std::string> channels;
        PixelType type;
        const char* compression;
    };
    for (const StoredAs& kind : {StoredAs{{"R", "G", "B", "A"}, PixelType::float32, "pxr24"},
                                 {{"R", "G", "B", "A"}, PixelType::float16, "zip"},
                                 {{"R", "G", "B"}, PixelType::float16, "zip"},
                                 {{"Y", "A"}, PixelType::float16, "zip"},
                                 {{"triangle"}, PixelType::bits32, "zip"}}) {
        CAPTURE(kind.channels, kind.compression);
        const std::string file = noise(folder, kind.channels, kind.type, kind.compression).string();
        const auto plain = open_plain_exr(file);
        REQUIRE(plain);
        std::string fault;
        const auto other = picture_library().open(file, false, fault);
        REQUIRE(other);
        const PictureHeader &ours = plain->header(), &theirs = other->header();
        CHECK(ours.size_px == theirs.size_px);
        CHECK(ours.channels == theirs.channels);
        CHECK(ours.type == theirs.type);
        CHECK(ours.type_name == theirs.type_name);
        CHECK(ours.alpha_channel == theirs.alpha_channel);
        for (const char* const name : {"compression", "overt:light"})
            CHECK(ours.text(name) == theirs.text(name));
        CHECK(*ours.attribute<int>("overt:frame") == *theirs.attribute<int>("overt:frame"));
        CHECK(*ours.attribute<double>("overt:angle_deg") == *theirs.attribute<double>("overt:angle_deg"));
        CHECK(*ours.attribute<glm::dvec3>("overt:low") == *theirs.attribute<glm::dvec3>("overt:low"));
        const PixelType as = kind.type == PixelType::bits32 ? PixelType::bits32 : PixelType::float32;
        const int channels = ours.channel_count();
        CHECK(bits_of(*plain, 0, size.y, channels, as) == bits_of(*other, 0, size.y, channels, as));
        CHECK(bits_of(*plain, 17, 23, channels, as) == bits_of(*other, 17, 23, channels, as));
        CHECK(bits_of(*plain, 3, 4, 1, as) == bits_of(*other, 3, 4, 1, as));
    }
    // Numbers of triangles as light are what OpenImageIO makes of them.
    const std::string map = noise(folder, {"triangle"}, PixelType::bits32, "zip").string();
    std::string fault;
    CHECK(bits_of(*open_plain_exr(map), 0, size.y, 1, PixelType::float32) ==
          bits_of(*picture_library().open(map, false, fault), 0, size.y, 1, PixelType::float32));
}

TEST_CASE("overt's own frames, light and maps are written to the bytes that OpenImageIO writes", "[unit]") {
    const auto check = [](const PictureHeader& header, PixelType type, const void* pixels) {
        std::vector<unsigned char> theirs;
        CHECK(picture_library().encode("picture.exr", header, type, pixels, theirs) == "");
        const auto ours = encode_plain_exr(header, type, pixels);
        REQUIRE(ours);
        CHECK(*ours == theirs);
    };
    // More rows than the format compresses at once, and their number is no multiple of that.
    PictureHeader header{size, {"R", "G", "B", "A"}, PixelType::float32, 3};
    std::vector<float> light(4 * static_cast<std::size_t>(size.x * size.y));
    RandomStream random(5, "light");
    for (float& value : light)
        value = static_cast<float>(std::exp(30.0 * random.uniform() - 20.0) - 1e-4);
    // What half floats do not have, or have with fewer digits.
    const float special[] = {0.0f,     -0.0f,   65504.0f, 65519.0f,
                             65520.0f, 1e30f,   5.9e-8f,  2.9e-8f,
                             -6.1e-5f, 2049.0f, 2051.0f,  std::numeric_limits<float>::infinity()};
    std::ranges::copy(special, light.begin());
    check(header, PixelType::float32, light.data());
    header.attributes = {{"compression", "pxr24"},
                         {"overt:a name that is longer than the first version of the format allows", 7},
                         {"overt:angle_deg", -23.75},
                         {"overt:low", glm::dvec3(1.0, -2.0, 3.5)},
                         {"overt:light", std::string("overcast")},
                         {"overt:light", std::string("gallery")},
                         {"overt:empty", std::string()}};
    check(header, PixelType::float32, light.data());
    header.type = PixelType::float16;
    check(header, PixelType::float32, light.data());
    header.attributes.front().second = "zip";
    check(header, PixelType::float32, light.data());
    std::vector<std::uint16_t> halves(light.size());
    for (std::uint16_t& value : halves)
        value = static_cast<std::uint16_t>(random.below(0x7c00));
    check(header, PixelType::float16, halves.data());
    header.channels = {"Y", "A"};
    check(header, PixelType::float32, light.data());

    std::vector<std::uint32_t> codes(static_cast<std::size_t>(size.x * size.y));
    for (std::uint32_t& code : codes)
        code = random.below(1 << 30);
    header.channels = {"triangle"};
    header.type = PixelType::bits32;
    check(header, PixelType::bits32, codes.data());

    const auto is_left_to_it = [&](PixelType stored, PixelType type, const char* name, const char* value) {
        const PictureHeader other{size, {"R"}, stored, -1, {{name, std::string(value)}}};
        return !encode_plain_exr(other, type, light.data());
    };
    CHECK_FALSE(is_left_to_it(PixelType::float32, PixelType::float32, "compression", "zip"));
    CHECK(is_left_to_it(PixelType::float32, PixelType::float32, "compression", "piz"));
    CHECK(is_left_to_it(PixelType::float32, PixelType::float32, "Software", "overt"));
    CHECK(is_left_to_it(PixelType::float32, PixelType::float16, "compression", "zip"));
    CHECK(is_left_to_it(PixelType::bits32, PixelType::float32, "compression", "zip"));
    CHECK(is_left_to_it(PixelType::bits8, PixelType::bits8, "compression", "zip"));
}

TEST_CASE("other pictures are left to OpenImageIO, and damaged ones to what it says of them", "[unit]") {
    const TemporaryFolder folder;
    CHECK_FALSE(open_plain_exr((folder.path() / "none.exr").string()));
    CHECK_FALSE(open_plain_exr(folder.file("text.exr", "no picture").string()));
    CHECK_FALSE(open_plain_exr(noise(folder, {"X", "Y", "Z"}, PixelType::float32, "zip").string()));
    CHECK_FALSE(open_plain_exr(noise(folder, {"Y"}, PixelType::float32, "zip").string()));
    CHECK_FALSE(open_plain_exr(noise(folder, {"R", "G"}, PixelType::float32, "zip").string()));
    CHECK_FALSE(open_plain_exr(noise(folder, {"R", "G", "B"}, PixelType::float32, "piz").string()));

    const std::filesystem::path file = noise(folder, {"R", "G", "B", "A"}, PixelType::float32, "pxr24");
    const std::string whole = read_whole_file(file);
    const auto said_of = [&](const std::string& bytes) -> std::string {
        folder.file("damaged.exr", bytes);
        try {
            PictureFile picture(folder.path() / "damaged.exr", "frame");
            std::vector<float> values(4 * static_cast<std::size_t>(size.x * size.y));
            picture.read(4, PixelType::float32, values.data());
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing";
    };
    CHECK(said_of(whole) == "nothing");
    for (const std::size_t kept : {whole.size() - 1, whole.size() / 2, std::size_t{200}, std::size_t{6}})
        CHECK_THAT(said_of(whole.substr(0, kept)),
                   Catch::Contains("damaged.exr: ") && Catch::Contains("frame"));
    // A header of few bytes that asks for a picture of gigabytes.
    const std::size_t window =
        whole.find("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
    std::string huge = whole;
    huge.replace(window + 8, 8, std::string("\xff\xff\xff\x0f\xff\xff\xff\x0f", 8));
    huge.replace(whole.find("displayWindow") + std::strlen("displayWindow") + 1 + std::strlen("box2i") + 1 +
                     4 + 8,
                 8, std::string("\xff\xff\xff\x0f\xff\xff\xff\x0f", 8));
    CHECK_THAT(said_of(huge), Catch::Contains("damaged.exr"));
}
