#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/colour/display_colour.h"
#include "experiment/spectra/spectra.h"
#include "tests/support/sample_display.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr ColourSpace spaces[] = {ColourSpace::cie1931_xyz, ColourSpace::cie2006_xyz,
                                  ColourSpace::cie2006_cones};

SampledSpectrum gaussian(double peak_nm, double width_nm, double height) {
    std::vector<double> values;
    for (int nm = 380; nm <= 780; nm += 4)
        values.push_back(height * std::exp(-0.5 * std::pow((nm - peak_nm) / width_nm, 2.0)));
    return sampled(380.0, 4.0, values);
}

DisplayCharacterisation spectral_display() {
    DisplayCharacterisation display = sample_display();
    display.spectra =
        PrimarySpectra{{gaussian(620, 15, 0.004), gaussian(540, 25, 0.004), gaussian(455, 12, 0.006)},
                       gaussian(500, 80, 4e-6)};
    for (std::size_t i = 0; i < 3; ++i)
        display.primaries_xyz[i] = tristimulus_of(display.spectra->channels[i], ColourSpace::cie1931_xyz);
    display.black_xyz = tristimulus_of(display.spectra->black, ColourSpace::cie1931_xyz);
    return display;
}

double distance(const glm::dvec3& a, const glm::dvec3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

} // namespace

TEST_CASE("the tables of colour have the CIE's sums, peaks and known values", "[unit]") {
    const auto& xyz = colour_matching(ColourSpace::cie1931_xyz);
    // CIE 015:2018, table 1, and 106.857 for the sum of each function.
    for (const SampledSpectrum& function : xyz) {
        double sum = 0.0;
        for (const double value : function.values)
            sum += value;
        CHECK(sum == Approx(106.857).epsilon(2e-4));
    }
    CHECK(xyz[1].at(555.0) == 1.0);
    CHECK(xyz[0].at(600.0) == Approx(1.0622));
    CHECK(xyz[2].at(445.0) == Approx(1.7826).epsilon(1e-4));
    // The fundamentals peak at 1, at 570.2, 542.8 and 442.1 nm (Stockman & Sharpe 2000).
    const double peaks[] = {570.2, 542.8, 442.1};
    for (std::size_t i = 0; i < 3; ++i) {
        const SampledSpectrum& cone = colour_matching(ColourSpace::cie2006_cones)[i];
        const auto highest = std::max_element(cone.values.begin(), cone.values.end());
        CHECK(*highest == Approx(1.0).margin(1e-4));
        CHECK(cone.wavelengths_nm[static_cast<std::size_t>(highest - cone.values.begin())] ==
              Approx(peaks[i]).margin(1.0));
    }
}

TEST_CASE("XYZ_F is a matrix times the cone fundamentals, as CIE 170-2 defines it", "[unit]") {
    // CIE 170-2:2015, eq. for 2 degrees.
    const double matrix[3][3] = {
        {1.94735469, -1.41445123, 0.36476327}, {0.68990272, 0.34832189, 0.0}, {0.0, 0.0, 1.93485343}};
    const auto& cones = colour_matching(ColourSpace::cie2006_cones);
    const auto& xyz = colour_matching(ColourSpace::cie2006_xyz);
    for (double nm = 390.0; nm <= 780.0; ++nm) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double sum = 0.0;
            for (std::size_t cone = 0; cone < 3; ++cone)
                sum += matrix[axis][cone] * cones[cone].at(nm);
            CAPTURE(nm, axis);
            CHECK(xyz[axis].at(nm) == Approx(sum).epsilon(1e-4).margin(2e-5));
        }
    }
}

TEST_CASE("a watt of light at 555 nm has 683 lumens, and D65 its chromaticity", "[unit]") {
    const SampledSpectrum line{{554.999, 555.0, 555.001}, {0.0, 1000.0, 0.0}}; // a watt in all
    CHECK(tristimulus_of(line, ColourSpace::cie1931_xyz).y == Approx(683.0).epsilon(1e-3));
    const SampledSpectrum d65 =
        sampled(first_bin_centre_nm, bin_width_nm,
                std::vector<double>(illuminant_d65().begin(), illuminant_d65().end()));
    const glm::dvec2 xy = chromaticity_of(tristimulus_of(d65, ColourSpace::cie1931_xyz));
    CHECK(xy.x == Approx(0.3127).margin(5e-4));
    CHECK(xy.y == Approx(0.3290).margin(1e-3));
}

TEST_CASE("colour matching is linear: lights add, and exposure scales", "[unit]") {
    const SampledSpectrum a = gaussian(480, 30, 0.01), b = gaussian(610, 20, 0.02);
    SampledSpectrum both = a, thrice = a;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        both.values[i] += b.values[i];
        thrice.values[i] *= 3.0;
    }
    for (const ColourSpace space : spaces) {
        const glm::dvec3 one = tristimulus_of(a, space), other = tristimulus_of(b, space);
        CHECK(distance(tristimulus_of(both, space), one + other) < 1e-12 * (one.x + other.x + 1.0));
        CHECK(distance(tristimulus_of(thrice, space), 3.0 * one) < 1e-12 * (one.x + 1.0));
    }
}

TEST_CASE("a finer grid of the same spectrum has the same colour", "[unit]") {
    const SampledSpectrum coarse = gaussian(560, 40, 1.0);
    std::vector<double> values;
    for (int i = 0; i <= 800; ++i)
        values.push_back(coarse.at(380.0 + 0.5 * i));
    for (const ColourSpace space : spaces) {
        const glm::dvec3 a = tristimulus_of(coarse, space),
                         b = tristimulus_of(sampled(380.0, 0.5, values), space);
        CHECK(distance(a, b) < 1e-9 * a.x);
    }
}

TEST_CASE("linear light goes to a colour and back, in every space", "[unit]") {
    const DisplayCharacterisation display = spectral_display();
    RandomStream random(3, "colours");
    for (const ColourSpace space : spaces) {
        const DisplayColour colour(display, space);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 rgb(random.uniform(-0.2, 1.2), random.uniform(), random.uniform());
            CHECK(distance(colour.rgb_of(colour.tristimulus_of_rgb(rgb)), rgb) < 1e-12);
        }
        CHECK(distance(colour.tristimulus_of_rgb({0, 0, 0}), colour.black()) == 0.0);
    }
    // The spectrum of a mixture is found to be that mixture, whoever looks.
    SampledSpectrum mixed = display.spectra->black;
    const double shares[] = {0.25, 0.5, 0.125};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < mixed.values.size(); ++k)
            mixed.values[k] += shares[i] * display.spectra->channels[i].values[k];
    }
    for (const ColourSpace space : spaces)
        CHECK(distance(DisplayColour(display, space).rgb_of(mixed), {0.25, 0.5, 0.125}) < 1e-12);
}

TEST_CASE("greys go to cd/m2 and back, and the model adds up", "[unit]") {
    const DisplayCharacterisation display = sample_display();
    CHECK(display.white_xyz().y == Approx(108.62));
    CHECK(display.luminance_of(0.0) == Approx(0.12));
    CHECK(display.luminance_of(1.0) == Approx(108.62));
    CHECK(display.linear_of(display.luminance_of(0.37)) == Approx(0.37));
    CHECK(display.contrast() == Approx(108.62 / 0.12));
    const glm::dvec3 shares = display.luminance_shares();
    CHECK(shares.x + shares.y + shares.z == Approx(1.0));
    // Channels add up: what two do together is what each does alone.
    const glm::dvec3 black = display.xyz_of_signal({0, 0, 0});
    const glm::dvec3 sum = display.xyz_of_signal({0.4, 0, 0}) + display.xyz_of_signal({0, 0.7, 0}) - black;
    CHECK(distance(display.xyz_of_signal({0.4, 0.7, 0}), sum) < 1e-12);
    CHECK(distance(display.xyz_of_signal({1, 1, 1}), display.white_xyz()) < 1e-12);
}

TEST_CASE("what the display cannot show is counted, by channel", "[unit]") {
    GamutCount count;
    CHECK(count.add({0.0, 1.0, 0.5}));
    CHECK_FALSE(count.add({1.06, 0.757, 0.382}));
    CHECK_FALSE(count.add({-0.1, 1.2, std::nan("")}));
    CHECK(count.colours == 3);
    CHECK(count.outside == 2);
    CHECK(count.above == std::array<std::int64_t, 3>{1, 1, 0});
    CHECK(count.below == std::array<std::int64_t, 3>{1, 0, 1});
}

TEST_CASE("cone excitations without spectra, and primaries in one plane, are refused", "[unit]") {
    CHECK_THROWS_AS(DisplayColour(sample_display(), ColourSpace::cie2006_cones), InputError);
    DisplayCharacterisation flat = sample_display();
    flat.primaries_xyz[2] = 0.4 * flat.primaries_xyz[0] + 0.6 * flat.primaries_xyz[1];
    CHECK(independence_of(flat.primaries_xyz) < least_independence);
    CHECK(independence_of(sample_display().primaries_xyz) > 0.05);
    CHECK_THROWS_AS(DisplayColour(flat, ColourSpace::cie1931_xyz), InputError);
}

TEST_CASE("a curve goes through its points, never falls, and a power's points make that power", "[unit]") {
    RandomStream random(11, "curve");
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<double> signals{0.0}, lights{0.0};
        const int points = 2 + static_cast<int>(random.below(20));
        for (int i = 1; i < points; ++i) {
            signals.push_back(signals.back() + random.uniform(0.05, 1.0));
            // Flat pieces, too.
            lights.push_back(lights.back() +
                             (random.below(4) == 0 && i > 1 ? 0.0 : random.uniform(0.01, 1.0)));
        }
        const double last_signal = signals.back();
        for (double& signal : signals)
            signal /= last_signal;
        const double full = lights.back();
        for (double& light : lights)
            light /= full;
        signals.back() = lights.back() = 1.0;
        const ChannelCurve curve = ChannelCurve::table(signals, lights, random.uniform(0.5, 3.0));
        for (std::size_t i = 0; i < signals.size(); ++i)
            CHECK(curve.light_of(signals[i]) == Approx(lights[i]).margin(1e-12));
        double before = 0.0;
        for (int i = 0; i <= 5000; ++i) {
            const double light = curve.light_of(i / 5000.0);
            CHECK(light >= before - 1e-14);
            before = light;
        }
    }
    for (const double exponent : {1.0, 1.8, 2.2, 2.6}) {
        const ChannelCurve power = ChannelCurve::power(exponent);
        const ChannelCurve curve = shouldered_curve(17, exponent, 0.0);
        for (int i = 0; i <= 1000; ++i)
            CHECK(curve.light_of(i / 1000.0) == Approx(power.light_of(i / 1000.0)).margin(1e-12));
        CHECK(nearest_exponent(curve.signals(), curve.lights()) == Approx(exponent));
    }
}

TEST_CASE("a curve through points of a parabola keeps its slope at both ends, however unequal the steps",
          "[unit]") {
    // Heights s + a s (1 - s) at uneven signals: the parabola through the three points of an end is this one,
    // so the curve leaves 0 with the slope 1 + a and reaches 1 with 1 - a.
    for (const double a : {0.3, -0.3}) {
        const std::vector<double> signals{0.0, 0.1, 0.4, 0.55, 0.95, 1.0};
        std::vector<double> lights;
        for (const double s : signals)
            lights.push_back(s + a * s * (1.0 - s));
        const ChannelCurve curve = ChannelCurve::table(signals, lights, 1.0);
        constexpr double step = 1e-6;
        CHECK(curve.light_of(step) / step == Approx(1.0 + a).epsilon(1e-4));
        CHECK((1.0 - curve.light_of(1.0 - step)) / step == Approx(1.0 - a).epsilon(1e-4));
    }
}

TEST_CASE("a power with an offset begins at 0, ends at 1, and stays dark as long as it says", "[unit]") {
    for (const double offset : {-0.2, 0.0, 0.15}) {
        const ChannelCurve curve = ChannelCurve::power(2.2, offset);
        CHECK(curve.light_of(0.0) == 0.0);
        CHECK(curve.light_of(1.0) == 1.0);
        CHECK(curve.light_of(-3.0) == 0.0);
        CHECK(curve.light_of(7.0) == 1.0);
    }
    CHECK(ChannelCurve::power(2.2, -0.25).light_of(0.19) == 0.0);
    CHECK(ChannelCurve::power(2.2, -0.25).light_of(0.21) > 0.0);
}

TEST_CASE("a colour of Rec. 709 is the same colour on the display, white as bright as its white", "[unit]") {
    const DisplayCharacterisation display = spectral_display();
    const glm::dmat3 to_display = display_from_rec709(display);
    const auto shown = [&](const glm::dvec3& rgb) {
        return primary_matrix(display.primaries_xyz) * (to_display * rgb);
    };
    // ITU-R BT.709-6, table 1.
    const glm::dvec3 white = shown(glm::dvec3(1.0));
    CHECK(distance({chromaticity_of(white), 0.0}, {0.3127, 0.3290, 0.0}) < 1e-12);
    CHECK(white.y == Approx(display.luminance_of(1.0) - display.luminance_of(0.0)));
    const glm::dvec2 chromaticities[] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
    const double luminances[] = {0.2126, 0.7152, 0.0722};
    for (int channel = 0; channel < 3; ++channel) {
        glm::dvec3 rgb(0.0);
        rgb[channel] = 1.0;
        CHECK(distance({chromaticity_of(shown(rgb)), 0.0}, {chromaticities[channel], 0.0}) < 1e-12);
        CHECK(shown(rgb).y / white.y == Approx(luminances[channel]).margin(1e-4));
    }
    // A display with those primaries and that white takes the light as it is.
    DisplayCharacterisation rec709;
    for (int channel = 0; channel < 3; ++channel) {
        glm::dvec3 rgb(0.0);
        rgb[channel] = 1.0;
        rec709.primaries_xyz[static_cast<std::size_t>(channel)] = shown(rgb);
    }
    const glm::dmat3 same = display_from_rec709(rec709);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            CHECK(same[column][row] == Approx(column == row ? 1.0 : 0.0).margin(1e-9));
    }
}
