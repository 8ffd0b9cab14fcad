/// A characterised display: light through the curves of its channels onto the video signal.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/random.h"
#include "experiment/colour/display_colour.h"
#include "experiment/spectra/spectra.h"
#include "render/gl/headless_context.h"
#include "render/presenter/page_presenter.h"
#include "render/signal/signal_check.h"
#include "tests/support/gl_contexts.h"
#include "tests/support/sample_display.h"

using namespace overt;
using namespace overt::test;

namespace {

DisplaySettings characterised(OutputMode mode, glm::ivec2 screen_px) {
    DisplaySettings display;
    display.output = mode;
    display.width_px = screen_px.x;
    display.height_px = screen_px.y;
    display.characterisation = sample_display();
    return display;
}

/// A picture of one colour as the only page of everything.
class PlainPage final : public FrameSource {
  public:
    PlainPage(glm::ivec2 size_px, glm::vec3 light) : picture_(size_px) {
        std::fill(picture_.pixels.begin(), picture_.pixels.end(), glm::vec4(light, 1.0f));
    }
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0}; }
    LinearImage page(const Stimulus&, int) const override { return picture_; }
    const LinearImage& picture() const { return picture_; }

  private:
    LinearImage picture_;
};

LinearImage random_picture(glm::ivec2 size) {
    RandomStream random(4, "characterised picture");
    LinearImage picture(size);
    for (glm::vec4& pixel : picture.pixels) {
        const double wide = random.uniform(); // dark light, too
        pixel = {static_cast<float>(std::pow(wide, 4.0)), static_cast<float>(random.uniform(-0.1, 1.1)),
                 static_cast<float>(random.uniform(0.0, 0.01)), static_cast<float>(random.uniform())};
    }
    return picture;
}

/// A screen as it is read back after a page was drawn through OpenGL.
std::vector<std::byte> drawn(ContextKind kind, const DisplaySettings& display, const FrameSource& pages,
                             glm::ivec2 image_px, glm::ivec2 origin_px) {
    const auto context = make_headless_context(kind);
    VirtualClock clock;
    VirtualDisplay surface(*context, clock, 120.0, row_of(display.output).framebuffer_bits);
    ScreenGeometry geometry;
    geometry.screen_px = {display.width_px, display.height_px};
    geometry.image_px = image_px;
    geometry.image_origin_px = origin_px;
    PagePresenter presenter(*context, surface, pages, geometry, display, {});
    presenter.load_frames({0, 0});
    presenter.flip({0});
    return presenter.read_canvas();
}

} // namespace

TEST_CASE("the table of a measured curve never falls and is right to half a code, for all 65,536 codes",
          "[unit]") {
    for (const ChannelCurve& curve : sample_display().curves) {
        const LevelTable table(65535, [&](double signal) { return curve.light_of(signal); });
        int wrong = 0, fell = 0, before = 0;
        for (int code = 0; code <= 65535; ++code) {
            // The light of a code comes back as that code; where codes have the same light, as the lowest.
            const double light = curve.light_of(code / 65535.0);
            const int level = table.level_of(light);
            wrong += level != code && curve.light_of(level / 65535.0) != light;
            // What lies anywhere around it goes to one of the two codes around it.
            const double above = curve.light_of(std::min(1.0, (code + 0.37) / 65535.0));
            wrong += above > light && table.level_of(above) != code && code < 65535;
            fell += level < before;
            before = level;
        }
        CHECK(wrong == 0);
        CHECK(fell == 0);
        CHECK(table.level_of(0.0) == 0);
        CHECK(table.level_of(1.0) == 65535);
        CHECK(table.level_of(-1.0) == 0);
        CHECK(table.level_of(2.0) == 65535);
        CHECK(table.position_of(0.0) == 0.0);
    }
}

TEST_CASE("a curve that is a power gives the very levels of that power", "[unit]") {
    for (const double gamma : {1.0, 1.8, 2.2}) {
        const ChannelCurve curve = ChannelCurve::power(gamma);
        const LevelTable by_curve(65535, [&](double signal) { return curve.light_of(signal); });
        const LevelTable by_power(65535, gamma);
        RandomStream random(1, "light");
        int wrong = 0;
        for (int i = 0; i < 50000; ++i) {
            const double light = std::pow(random.uniform(), 3.0);
            wrong += by_curve.level_of(light) != by_power.level_of(light);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("light between levels keeps its mean where a curve begins flat", "[unit]") {
    const ChannelCurve curve = ChannelCurve::power(2.2, -0.1);
    const LevelTable table(255, [&](double signal) { return curve.light_of(signal); });
    for (int i = 0; i <= 2000; ++i) {
        const double light = std::pow(i / 2000.0, 3.0), position = table.position_of(light);
        const double low = std::floor(position);
        const double below = curve.light_of(low / 255.0), above = curve.light_of((low + 1.0) / 255.0);
        CHECK(below + (position - low) * (above - below) == Approx(light).margin(1e-12));
    }
}

TEST_CASE("in every mode a characterised display receives what is predicted", "[gl]") {
    for (const OutputModeRow& row : output_modes) {
        DisplaySettings display = characterised(row.mode, {600, 200});
        display.background = 0.2;
        class Pages final : public FrameSource {
          public:
            std::vector<int> page_of_frame(const Stimulus&) const override { return {0}; }
            LinearImage page(const Stimulus&, int) const override { return random_picture({301, 160}); }
        } pages;
        const glm::ivec2 origin{101, 7};
        const auto bytes = drawn(ContextKind::osmesa, display, pages, {301, 160}, origin);
        const LinearImage picture = random_picture({301, 160});
        const SignalScreen screen{{600, 200}, bytes};
        const SignalFindings found = check_signal(screen, display, {&picture, origin});
        CAPTURE(row.name, found.first);
        CHECK(found.different == 0);
        CHECK(found.compared >= 59100);
        // And not what another display would receive.
        display.characterisation->curves[1] = ChannelCurve::power(2.0);
        CHECK(check_signal(screen, display, {&picture, origin}).different > 1000);
    }
}

TEST_CASE("dithered light of a characterised display keeps its mean", "[gl]") {
    DisplaySettings display = characterised(OutputMode::native_8bit, {256, 128});
    display.dither = Dithering::blue_noise;
    const PlainPage pages({256, 128}, {0.013f, 0.31f, 0.002f});
    const auto bytes = drawn(ContextKind::osmesa, display, pages, {256, 128}, {0, 0});
    const SignalFindings found = check_signal({{256, 128}, bytes}, display, {&pages.picture(), {0, 0}});
    CHECK(found.different == 0);
    CHECK(found.largest_mean_error < 0.5);
}

TEST_CASE("gold under equal energy goes from its spectrum to the codes that were reckoned by hand", "[gl]") {
    // A perfect reflector would have 60 cd/m2 under this light.
    const SampledSpectrum reflectance = [] {
        const Spectrum gold = normal_reflectance(metal_index("Au"), 1.0);
        return sampled(first_bin_centre_nm, bin_width_nm, {gold.begin(), gold.end()});
    }();
    const SampledSpectrum equal_energy = sampled(380.0, 400.0, {1.0, 1.0});
    const double full = tristimulus_of(equal_energy, ColourSpace::cie1931_xyz).y;
    SampledSpectrum light = reflectance; // under a radiance of 1 at all wavelengths
    for (double& radiance : light.values)
        radiance *= 60.0 / full;
    const DisplayCharacterisation measured = sample_display();
    const glm::dvec3 rgb = DisplayColour(measured, ColourSpace::cie1931_xyz).rgb_of(light);
    const glm::vec3 pixel(rgb); // frames are floats
    GamutCount gamut;
    CHECK(gamut.add(rgb));

    // By hand: the integral as a sum, Cramer's rule, each curve inverted by halving.
    const auto& functions = colour_matching(ColourSpace::cie1931_xyz);
    double sums[3] = {}, white = 0.0;
    for (int nm = 380; nm <= 780; ++nm) {
        const double weight = nm == 400 || nm == 700 ? 0.5 : 1.0, end = nm == 380 || nm == 780 ? 0.5 : 1.0;
        white += end * functions[1].at(nm);
        for (std::size_t axis = 0; axis < 3 && nm >= 400 && nm <= 700; ++axis)
            sums[axis] += weight * functions[axis].at(nm) * reflectance.at(nm);
    }
    double target[3];
    for (int axis = 0; axis < 3; ++axis)
        target[axis] = 60.0 * sums[axis] / white - measured.black_xyz[axis];
    const auto determinant = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return a.x * (b.y * c.z - c.y * b.z) - b.x * (a.y * c.z - c.y * a.z) + c.x * (a.y * b.z - b.y * a.z);
    };
    const glm::dvec3 goal(target[0], target[1], target[2]);
    const auto& p = measured.primaries_xyz;
    const double all = determinant(p[0], p[1], p[2]);
    const double expected_rgb[3] = {determinant(goal, p[1], p[2]) / all, determinant(p[0], goal, p[2]) / all,
                                    determinant(p[0], p[1], goal) / all};
    for (const auto& [mode, highest] :
         {std::pair(OutputMode::color_plus_plus, 65535), std::pair(OutputMode::native_8bit, 255)}) {
        int expected[3];
        for (int channel = 0; channel < 3; ++channel) {
            CHECK(expected_rgb[channel] == Approx(rgb[channel]).epsilon(1e-9));
            double low = 0.0, high = 1.0;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                const bool is_below =
                    measured.curves[static_cast<std::size_t>(channel)].light_of(middle) < pixel[channel];
                (is_below ? low : high) = middle;
            }
            expected[channel] = static_cast<int>(std::floor(high * highest + 0.5));
        }
        for (const ContextKind kind : headless_kinds) {
            const DisplaySettings display = characterised(mode, {600, 64});
            const PlainPage pages({64, 32}, pixel);
            const auto bytes = drawn(kind, display, pages, {64, 32}, {100, 10});
            const ReceivedLight received = receive_light({{600, 64}, bytes}, mode);
            const int pairs = joins_pixels_in_pairs(mode) ? 2 : 1;
            for (int x = 100 / pairs; x < 164 / pairs; ++x) {
                const auto& levels = received.at(x, 20);
                CAPTURE(static_cast<int>(mode), x);
                for (std::size_t channel = 0; channel < 3; ++channel)
                    REQUIRE(levels[channel] == expected[channel]);
            }
        }
    }
}
