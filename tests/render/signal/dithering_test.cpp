#include <algorithm>
#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/random.h"
#include "render/gl/headless_context.h"
#include "render/presenter/page_presenter.h"
#include "render/signal/dither_tile.h"
#include "render/signal/signal_check.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

/// One page for each of some levels, plain all over.
class PlainLight final : public FrameSource {
  public:
    PlainLight(glm::ivec2 size, std::vector<double> light) : size_(size), light_(std::move(light)) {}
    std::vector<int> page_of_frame(const Stimulus&) const override {
        std::vector<int> pages(light_.size());
        std::iota(pages.begin(), pages.end(), 0);
        return pages;
    }
    LinearImage page(const Stimulus&, int page) const override {
        LinearImage image(size_);
        const auto light = static_cast<float>(light_[static_cast<std::size_t>(page)]);
        std::fill(image.pixels.begin(), image.pixels.end(),
                  glm::vec4(light, 0.5f * light, 1.0f - light, 1.0f));
        return image;
    }

  private:
    glm::ivec2 size_;
    std::vector<double> light_;
};

} // namespace

TEST_CASE("dithering keeps the mean of every 64 x 64 patch to half a code of 16 bits, in every refresh",
          "[gl]") {
    std::vector<double> light{0.0, 1.0, 1e-5, 0.999999};
    RandomStream random(3, "greys");
    for (int i = 0; i < 12; ++i)
        light.push_back(random.uniform());
    const glm::ivec2 screen{128, 128};
    PlainLight pages(screen, light);
    for (const ContextKind kind : test::headless_kinds) {
        const auto context = make_headless_context(kind);
        for (const OutputModeRow& row : output_modes) {
            if (row.is_packed)
                continue;
            for (const Dithering dither : {Dithering::ordered, Dithering::blue_noise}) {
                DisplaySettings settings;
                settings.output = row.mode;
                settings.dither = dither;
                settings.width_px = screen.x;
                settings.height_px = screen.y;
                ScreenGeometry geometry;
                geometry.screen_px = geometry.image_px = screen;
                geometry.image_origin_px = {0, 0};
                VirtualClock clock;
                VirtualDisplay display(*context, clock, 120.0, row.framebuffer_bits);
                PagePresenter presenter(*context, display, pages, geometry, settings, {});
                presenter.load_frames({0, 0});
                double worst = 0.0;
                for (int page = 0; page < presenter.pages(); ++page) {
                    for (int refresh = 0; refresh < 3; ++refresh) {
                        presenter.flip({page});
                        const auto bytes = presenter.read_canvas();
                        const LinearImage picture = pages.page({0, 0}, page);
                        const SignalFindings found =
                            check_signal({screen, bytes}, settings, {&picture, {0, 0}});
                        CHECK(found.different == 0);
                        worst = std::max(worst, found.largest_mean_error);
                    }
                }
                CAPTURE(row.name, static_cast<int>(dither));
                CHECK(worst <= 0.5);
                CHECK(worst > 0.0);
            }
        }
    }
}

TEST_CASE("over 4096 refreshes dithering keeps each pixel's own mean to half a code of 16 bits", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const glm::ivec2 screen{16, 16};
    DisplaySettings settings;
    settings.output = OutputMode::native_8bit;
    settings.dither = Dithering::blue_noise;
    const SignalPass pass(*context, settings);
    Texture2D codes(*context, screen, PixelFormat::rgba16);
    std::vector<std::uint16_t> content(4 * 256);
    RandomStream random(4, "codes");
    for (std::uint16_t& code : content)
        code = static_cast<std::uint16_t>(random.below(65536));
    codes.upload(std::as_bytes(std::span(content)));
    const Framebuffer target(*context, screen, PixelFormat::rgba8);
    std::vector<double> sums(content.size(), 0.0), short_sums;
    std::vector<std::byte> bytes(content.size());
    for (int refresh = 0; refresh < 4096; ++refresh) {
        pass.draw(codes, target, refresh);
        target.read(PixelFormat::rgba8, bytes);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += std::to_integer<int>(bytes[i]);
        if (refresh == 63)
            short_sums = sums;
    }
    double worst = 0.0, worst_short = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (i % 4 == 3)
            continue;
        worst = std::max(worst, std::abs(257.0 * sums[i] / 4096.0 - content[i]));
        worst_short = std::max(worst_short, std::abs(257.0 * short_sums[i] / 64.0 - content[i]));
    }
    CHECK(worst <= 0.5);
    // Half a second at 120 Hz already comes within a few hundredths of a level of 8 bits.
    CHECK(worst_short <= 0.05 * 257.0);
}

TEST_CASE("each tile holds every rank once, and blue noise has little of the coarse noise that is seen",
          "[unit]") {
    const auto coarse_power = [](const std::vector<std::uint32_t>& ranks) {
        // Variance of the mean of 8 x 8 blocks, of the pattern that a tenth of full light makes.
        double variance = 0.0;
        for (int by = 0; by < 64; by += 8) {
            for (int bx = 0; bx < 64; bx += 8) {
                int lit = 0;
                for (int i = 0; i < 64; ++i)
                    lit += ranks[static_cast<std::size_t>((by + i / 8) * 64 + bx + i % 8)] < 410;
                variance += (lit - 6.4) * (lit - 6.4) / 64.0;
            }
        }
        return variance;
    };
    RandomStream random(8, "white");
    std::vector<std::uint32_t> white(4096);
    std::iota(white.begin(), white.end(), 0u);
    random.shuffle(std::span(white));
    for (const Dithering dither : {Dithering::ordered, Dithering::blue_noise}) {
        std::vector<std::uint32_t> ranks = make_dither_tile(dither);
        CHECK(coarse_power(ranks) < 0.2 * coarse_power(white));
        std::sort(ranks.begin(), ranks.end());
        for (std::uint32_t i = 0; i < 4096; ++i)
            REQUIRE(ranks[i] == i);
    }
}

TEST_CASE("the ordered tile is Bayer's, and each tile has each rank once", "[unit]") {
    for (const Dithering kind : {Dithering::ordered, Dithering::blue_noise}) {
        std::vector<std::uint32_t> ranks = make_dither_tile(kind);
        REQUIRE(ranks.size() == dither_ranks);
        std::sort(ranks.begin(), ranks.end());
        for (std::size_t i = 0; i < ranks.size(); ++i)
            REQUIRE(ranks[i] == i);
    }
    // Bayer's pattern of 4 x 4 is the coarse part of each rank, all over the tile.
    constexpr std::uint32_t bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    const std::vector<std::uint32_t> tile = make_dither_tile(Dithering::ordered);
    for (std::size_t y = 0; y < dither_tile_px; ++y)
        for (std::size_t x = 0; x < dither_tile_px; ++x)
            REQUIRE(tile[y * dither_tile_px + x] / (dither_ranks / 16) == bayer[y % 4][x % 4]);
}
