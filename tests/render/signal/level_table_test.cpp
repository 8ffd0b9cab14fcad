/// The levels that light is packed as, against the plain formula and a search through all borders.
#include "render/signal/level_table.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/stimulus/frame_memory.h"
#include "render/signal/display_encoder.h"
#include "tests/support/sample_display.h"

using namespace overt;

namespace {

using Curve = std::function<double(double)>;

/// The definition: how many borders are below the light, each being the curve half-way between two levels.
class PlainLevels {
  public:
    PlainLevels(int levels, const Curve& curve) {
        for (int level = 1; level <= levels; ++level) {
            const double border = curve((level - LevelTable::half) / levels);
            borders.push_back(borders.empty() ? border : std::max(borders.back(), border));
        }
    }
    int of(double light) const {
        const double inside = light > 0.0 ? std::min(light, 1.0) : 0.0;
        return static_cast<int>(std::lower_bound(borders.begin(), borders.end(), inside) - borders.begin());
    }
    std::vector<double> borders;
};

struct NamedCurve {
    const char* name;
    Curve curve;
};

/// As displays have them, and steep, flat at both ends, in steps, and with kinks.
std::vector<NamedCurve> all_curves() {
    const auto power = [](double exponent) { return [exponent](double s) { return std::pow(s, exponent); }; };
    std::vector<NamedCurve> curves{
        {"power", power(2.2)},
        {"steep", power(7.0)},
        {"steepest", power(10.0)},
        {"root", power(0.5)},
        {"dead ends", [](double s) { return s < 0.1   ? 0.0
                                            : s > 0.9 ? 1.0
                                                      : (s - 0.1) / 0.8; }},
        {"steps", [](double s) { return std::floor(s * 9.0) / 9.0; }},
        {"kinks", [](double s) {
             return s < 0.3    ? 1e-7 * s
                    : s < 0.31 ? 3e-8 + 60.0 * (s - 0.3)
                               : std::min(1.0, 0.61 + (s - 0.31) * 0.39 / 0.69);
         }}};
    for (const ChannelCurve& curve : test::sample_display().curves)
        curves.push_back({"measured", [curve](double s) { return curve.light_of(s); }});
    for (NamedCurve& one : curves)
        one.curve = [shape = one.curve](double s) { return s >= 1.0 ? 1.0 : std::min(1.0, shape(s)); };
    return curves;
}

/// Light at which a mistake would show: a border, the doubles beside it, and the floats around it with the
/// doubles half-way between them, at which rounding to a float turns over.
void add_light_around(double border, std::vector<double>& lights) {
    lights.insert(lights.end(), {border, std::nextafter(border, 2.0), std::nextafter(border, -1.0)});
    auto near = static_cast<float>(border);
    for (int i = 0; i < 3; ++i)
        near = std::nextafter(near, -1.0f);
    for (int i = 0; i < 6; ++i) {
        const float next = std::nextafter(near, 2.0f);
        const double half_way = 0.5 * (double{near} + double{next});
        lights.insert(lights.end(), {double{near}, half_way, std::nextafter(half_way, 2.0)});
        near = next;
    }
}

} // namespace

TEST_CASE("around each border of each curve a table gives the level that a search through all borders gives",
          "[unit]") {
    RandomStream random(9, "light");
    for (const auto& [name, curve] : all_curves()) {
        for (const int levels : {1, 255, 1023, 65535}) {
            CAPTURE(name, levels);
            const LevelTable table(levels, curve);
            const PlainLevels plain(levels, curve);
            std::vector<double> lights{0.0,   5e-324, 1e-300, 1e-45, 7e-46,
                                       1e-39, 1.0,    -1.0,   2.0,   std::nan("")};
            for (const double border : plain.borders)
                add_light_around(border, lights);
            for (int i = 0; i < 20000; ++i) {
                const double wide = random.uniform();
                lights.insert(lights.end(), {wide, std::pow(wide, 8.0), std::exp(-700.0 * wide)});
            }
            std::vector<int> found(lights.size());
            table.levels_of(lights, found.data());
            int wrong = 0, alone_otherwise = 0;
            for (std::size_t i = 0; i < lights.size(); ++i) {
                wrong += found[i] != plain.of(lights[i]);
                if (i % 37 == 0)
                    alone_otherwise += table.level_of(lights[i]) != found[i];
            }
            CHECK(wrong == 0);
            CHECK(alone_otherwise == 0);
        }
    }
}

TEST_CASE("a table of levels agrees with the power function for every float that was tried", "[unit]") {
    RandomStream random(5, "light");
    for (const int levels : {255, 1023, 65535}) {
        for (const double gamma : {0.5, 1.0, 1.8, 2.2, 3.0}) {
            const LevelTable table(levels, gamma);
            int wrong = 0, misplaced = 0;
            for (int i = 0; i < 20000; ++i) {
                const double wide = random.uniform();
                const double light = static_cast<float>(i % 3 == 0 ? std::pow(wide, 6.0) : wide);
                const double exact = levels * std::pow(light, 1.0 / gamma);
                wrong += table.level_of(light) != static_cast<int>(std::floor(exact + 0.5));
                // Between the same two levels, and as far from the lower as its light is.
                const double position = table.position_of(light), low = std::floor(position);
                const auto light_of = [&](double level) { return std::pow(level / levels, gamma); };
                const double back = light_of(low) + (position - low) * (light_of(low + 1) - light_of(low));
                misplaced += std::abs(back - light) > 1e-12;
            }
            CAPTURE(levels, gamma);
            CHECK(wrong == 0);
            CHECK(misplaced == 0);
            for (int level = 0; level <= levels; ++level)
                wrong += table.level_of(std::pow(static_cast<double>(level) / levels, gamma)) != level;
            CHECK(wrong == 0);
            CHECK(table.level_of(std::nan("")) == 0);
            CHECK(table.position_of(7.0) == levels);
        }
    }
}

TEST_CASE("pages are what the plain formula makes of them, byte for byte, whatever the curves", "[unit]") {
    // Light of all 65,536 levels of each channel, and random light, some of it beyond the display's.
    const glm::ivec2 size(512, 256);
    RandomStream random(6, "pages");
    LinearImage picture(size);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const auto any = [&] {
            return static_cast<float>(random.uniform(-0.05, 1.05) * std::pow(random.uniform(), 3.0));
        };
        const float level = static_cast<float>(i % 65536) / 65535.0f;
        picture.pixels[i] = i < 65536 ? glm::vec4(level, 1.0f - level, level * level, 1.0f)
                                      : glm::vec4(any(), any(), any(), i % 7 == 0 ? 0.3f : 1.0f);
    }
    for (const OutputMode mode : {OutputMode::native_8bit, OutputMode::color_plus_plus, OutputMode::vpixx_c48,
                                  OutputMode::mono_plus_plus, OutputMode::vpixx_m16}) {
        for (const char* curves : {"gamma 1", "gamma 2.2", "measured"}) {
            CAPTURE(row_of(mode).name, curves);
            DisplaySettings display;
            display.output = mode;
            display.width_px = size.x;
            display.height_px = size.y;
            display.background = 0.3;
            std::array<Curve, 3> channels;
            for (Curve& curve : channels)
                curve = [](double s) { return s; };
            if (curves == std::string("gamma 2.2")) {
                display.gamma = 2.2;
                for (Curve& curve : channels)
                    curve = [](double s) { return std::pow(s, 2.2); };
            }
            glm::dvec3 shares(0.2126, 0.7152, 0.0722);
            if (curves == std::string("measured")) {
                display.characterisation = test::sample_display();
                shares = display.characterisation->luminance_shares();
                for (std::size_t i = 0; i < 3; ++i)
                    channels[i] = [curve = display.characterisation->curves[i]](double s) {
                        return curve.light_of(s);
                    };
            }
            const bool is_grey = row_of(mode).shows == ShownLight::greys;
            if (is_grey && display.characterisation) {
                const auto mixed = [shares, all = channels](double s) {
                    return shares.r * all[0](s) + shares.g * all[1](s) + shares.b * all[2](s);
                };
                channels[0] = [mixed, full = mixed(1.0)](double s) { return mixed(s) / full; };
            }
            std::vector<PlainLevels> plain;
            for (const Curve& curve : channels)
                plain.emplace_back(row_of(mode).levels, curve);

            const DisplayEncoder encoder(display);
            std::vector<std::byte> bytes(picture.pixels.size() * 4);
            encoder.encode(picture, {0, 0}, bytes);
            const auto light_of = [&](std::size_t pixel) {
                const glm::vec4& one = picture.pixels[pixel];
                return glm::dvec3(one) + (1.0 - double{one.w}) * 0.3;
            };
            int wrong = 0;
            const auto expect = [&](std::size_t pixel, std::size_t channel, int value) {
                wrong += std::to_integer<int>(bytes[4 * pixel + channel]) != value;
            };
            for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
                const glm::dvec3 light = light_of(pixel);
                expect(pixel, 3, 255);
                if (is_grey) {
                    const int code =
                        plain[0].of(shares.r * light.r + shares.g * light.g + shares.b * light.b);
                    expect(pixel, 0, code >> 8);
                    expect(pixel, 1, code & 255);
                    expect(pixel, 2, 0);
                    continue;
                }
                const bool has_pairs = row_of(mode).joins_pixels_in_pairs;
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    const auto axis = static_cast<int>(channel);
                    if (!has_pairs) {
                        expect(pixel, channel, plain[channel].of(light[axis]));
                        continue;
                    }
                    const std::size_t left = pixel - pixel % 2;
                    const int code =
                        plain[channel].of(0.5 * (light_of(left)[axis] + light_of(left + 1)[axis]));
                    expect(pixel, channel, pixel % 2 == 0 ? code >> 8 : code & 255);
                }
            }
            CHECK(wrong == 0);
        }
    }
}
