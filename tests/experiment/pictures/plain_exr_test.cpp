#include "experiment/pictures/plain_exr.h"

#include <cstring>

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
    struct Kind {
        std::vector<std::string> channels;
        PixelType type;
        const char* compression;
    };
    for (const Kind& kind : {Kind{{"R", "G", "B", "A"}, PixelType::float32, "pxr24"},
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
