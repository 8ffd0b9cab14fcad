#include "experiment/pictures/plain_png.h"

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/pictures/picture_library.h"

using namespace overt;

TEST_CASE("pictures for people are written to the bytes that OpenImageIO writes", "[unit]") {
    RandomStream random(7, "pictures");
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(37, 29), glm::ivec2(301, 200)}) {
        CAPTURE(size.x, size.y);
        // Half of it is smooth and half is noise: what a filter of rows suits and does not.
        std::vector<unsigned char> rgb;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                for (int channel = 0; channel < 3; ++channel)
                    rgb.push_back(static_cast<unsigned char>(2 * y < size.y
                                                                 ? (x + 2 * y + 40 * channel) % 256
                                                                 : static_cast<int>(random.below(256))));
        const PictureHeader header{
            size, {"R", "G", "B"}, PixelType::bits8, -1, {{"oiio:ColorSpace", std::string("sRGB")}}};
        std::vector<unsigned char> theirs;
        CHECK(picture_library().encode("picture.png", header, PixelType::bits8, rgb.data(), theirs) == "");
        const auto ours = encode_srgb_png(header, PixelType::bits8, rgb.data());
        REQUIRE(ours);
        CHECK(*ours == theirs);
    }
}

TEST_CASE("other PNG files are left to OpenImageIO", "[unit]") {
    const std::vector<unsigned short> values(4 * 4 * 4, 77);
    const auto is_left_to_it = [&](const PictureHeader& header, PixelType type) {
        return !encode_srgb_png(header, type, values.data());
    };
    const PictureHeader plain{
        {4, 4}, {"R", "G", "B"}, PixelType::bits8, -1, {{"oiio:ColorSpace", std::string("sRGB")}}};
    CHECK_FALSE(is_left_to_it(plain, PixelType::bits8));
    CHECK(is_left_to_it(plain, PixelType::bits16));
    PictureHeader other = plain;
    other.type = PixelType::bits16;
    CHECK(is_left_to_it(other, PixelType::bits16));
    other = plain;
    other.channels = {"R", "G", "B", "A"};
    other.alpha_channel = 3;
    CHECK(is_left_to_it(other, PixelType::bits8));
    other = plain;
    other.attributes.front().second = std::string("Linear");
    CHECK(is_left_to_it(other, PixelType::bits8));
    other = plain;
    other.attributes.emplace_back("Software", std::string("overt"));
    CHECK(is_left_to_it(other, PixelType::bits8));
    other.attributes.clear();
    CHECK(is_left_to_it(other, PixelType::bits8));
}
