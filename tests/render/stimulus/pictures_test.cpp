#include <cmath>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "render/image/light_probe.h"
#include "render/image/text_layout.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

TEST_CASE("a picture comes back from EXR within 2^-16 of each value", "[unit]") {
    const test::TemporaryFolder folder;
    LinearImage image({33, 17});
    RandomStream random(5, "pixels");
    for (glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 4; ++channel)
            pixel[channel] = static_cast<float>(std::exp(random.uniform(-12.0, 3.0)));
    }
    write_linear_exr(folder.path() / "a.exr", image, {{"overt:angle_deg", "25"}});
    const LinearImage back = read_linear_image(folder.path() / "a.exr");
    REQUIRE(back.size_px == image.size_px);
    double worst = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int channel = 0; channel < 4; ++channel) {
            worst = std::max(
                worst, std::abs(double{back.pixels[i][channel]} / double{image.pixels[i][channel]} - 1.0));
        }
    }
    CHECK(worst <= 0x1p-16);
    CHECK(image_size_px(folder.path() / "a.exr") == image.size_px);
}

TEST_CASE("an 8-bit sRGB picture read as sRGB gives back the light it was written from", "[unit]") {
    const test::TemporaryFolder folder;
    LinearImage image({256, 1});
    for (int x = 0; x < 256; ++x) {
        const double encoded = x / 255.0;
        const double light = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        image.at(x, 0) = glm::vec4(glm::vec3(static_cast<float>(light)), 1.0f);
    }
    write_srgb_png(folder.path() / "a.png", image);
    const LinearImage back = read_linear_image(folder.path() / "a.png", FrameEncoding::srgb);
    for (int x = 0; x < 256; ++x)
        CHECK(back.at(x, 0).y == Approx(image.at(x, 0).y).margin(1e-6));
}

TEST_CASE("a picture with a value that is no number, a text and a missing file are refused by name",
          "[unit]") {
    const test::TemporaryFolder folder;
    LinearImage image({4, 4});
    image.at(2, 1).y = std::nanf("");
    write_linear_exr(folder.path() / "nan.exr", image, {});
    CHECK_THROWS_WITH(read_linear_image(folder.path() / "nan.exr"),
                      Catch::Contains("nan.exr") && Catch::Contains("(2, 1)"));
    std::ofstream(folder.path() / "text.png") << "no picture";
    CHECK_THROWS_AS(read_linear_image(folder.path() / "text.png"), InputError);
    CHECK_THROWS_WITH(read_linear_image(folder.path() / "none.png"), Catch::Contains("none.png"));
}

TEST_CASE("blurring a probe that is the same everywhere leaves it so, and so does taking its irradiance",
          "[unit]") {
    LightProbe probe{LinearImage({64, 32})};
    for (glm::vec4& pixel : probe.radiance.pixels)
        pixel = {0.5f, 1.0f, 2.0f, 1.0f};
    for (const LightProbe& changed :
         {blurred_by_ggx(probe, 0.13, {32, 16}), irradiance_over_pi(probe, {16, 8})}) {
        for (const glm::vec4& pixel : changed.radiance.pixels) {
            CHECK(pixel.x == Approx(0.5));
            CHECK(pixel.z == Approx(2.0));
        }
    }
}

TEST_CASE("a direction of the probe finds the texel that stands for it", "[unit]") {
    LightProbe probe{LinearImage({64, 32})};
    probe.radiance.at(40, 10) = {7.0f, 7.0f, 7.0f, 1.0f};
    const float azimuth = 2.0f * std::numbers::pi_v<float> * (40.5f / 64.0f - 0.5f),
                polar = std::numbers::pi_v<float> * 10.5f / 32.0f;
    const glm::vec3 direction(std::sin(polar) * std::sin(azimuth), std::sin(polar) * std::cos(azimuth),
                              std::cos(polar));
    CHECK(probe.towards(direction).x == Approx(7.0).epsilon(1e-4));
    CHECK(probe.towards(-direction).x == Approx(0.0).margin(1e-6));
}

TEST_CASE("a probe that is not twice as wide as high is refused", "[unit]") {
    const test::TemporaryFolder folder;
    write_linear_exr(folder.path() / "square.exr", LinearImage({16, 16}), {});
    LightSettings light;
    light.probe = folder.path() / "square.exr";
    CHECK_THROWS_WITH(load_light_probe(light), Catch::Contains("square.exr") && Catch::Contains("16 x 16"));
}

TEST_CASE("text is as bright as asked where letters are, background elsewhere, and wraps at its width",
          "[unit]") {
    TextStyle style;
    style.grey = 0.8f;
    style.background = 0.1f;
    style.line_height_px = 30;
    const LinearImage line = draw_text("Wie alt ist diese Person? Πόσο χρονών;", style);
    float darkest = 1.0f, brightest = 0.0f;
    for (const glm::vec4& pixel : line.pixels) {
        darkest = std::min(darkest, pixel.x);
        brightest = std::max(brightest, pixel.x);
    }
    CHECK(darkest == Approx(0.1f));
    CHECK(brightest == Approx(0.8f));
    style.wrap_width_px = line.size_px.x / 2;
    const LinearImage wrapped = draw_text("Wie alt ist diese Person? Πόσο χρονών;", style);
    CHECK(wrapped.size_px.x <= style.wrap_width_px + 6);
    CHECK(wrapped.size_px.y > line.size_px.y * 3 / 2);
    CHECK(wrapped.size_px.x % 2 == 0);
    CHECK_THROWS_AS(draw_text("\xff\xfe", style), InputError);
}

TEST_CASE("the fixation target is the same from left and right, above and below, with a dot in its middle",
          "[unit]") {
    const LinearImage target = draw_fixation_target(60.0, 1.0f, 0.0f);
    const glm::ivec2 size = target.size_px;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            CHECK(std::abs(target.at(x, y).x - target.at(size.x - 1 - x, y).x) < 0.1f);
            CHECK(std::abs(target.at(x, y).x - target.at(x, size.y - 1 - y).x) < 0.1f);
        }
    }
    CHECK(target.at(size.x / 2, size.y / 2).x == Approx(1.0f));
    CHECK(target.at(size.x / 2, size.y / 2 + 20).x == Approx(0.0f).margin(0.01)); // the cross is cut out
}
