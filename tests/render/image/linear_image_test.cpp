#include "render/image/linear_image.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/pictures/picture_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("straight colours are decoded before they are multiplied by alpha", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "straight.png";
    const std::uint16_t values[] = {40000, 20000, 60000, 30000, 40000, 20000, 60000, 0};
    write_picture(file, {{2, 1}, {"R", "G", "B", "A"}, PixelType::bits16, 3, {{"oiio:UnassociatedAlpha", 1}}},
                  PixelType::bits16, values);
    CHECK(has_alpha(file));

    const float alpha = 30000.0f / 65535.0f;
    const auto encoded = [](int value) { return static_cast<double>(value) / 65535.0; };
    const LinearImage linear = read_linear_image(file), srgb = read_linear_image(file, FrameEncoding::srgb);
    for (int channel = 0; channel < 3; ++channel) {
        const double value = encoded(values[channel]);
        CHECK(linear.pixels[0][channel] == Approx(value * double{alpha}).epsilon(1e-6));
        // IEC 61966-2-1.
        CHECK(srgb.pixels[0][channel] ==
              Approx(std::pow((value + 0.055) / 1.055, 2.4) * double{alpha}).epsilon(1e-5));
        CHECK(linear.pixels[1][channel] == 0.0f);
    }
    CHECK(linear.pixels[0].w == Approx(alpha));
}
