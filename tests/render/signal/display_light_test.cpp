#include "render/signal/display_light.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/colour/colour_matching.h"
#include "render/bake/light_colour.h"
#include "render/stimulus/observed_colours.h"
#include "tests/support/sample_display.h"

using namespace overt;
using namespace overt::test;

namespace {

DisplaySettings measured(const DisplayCharacterisation& display) {
    DisplaySettings settings;
    settings.characterisation = display;
    return settings;
}

double largest_difference(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
    }
    return largest;
}

SampledSpectrum bump(double centre_nm, double width_nm) {
    std::vector<double> values;
    for (int nm = 380; nm <= 780; ++nm)
        values.push_back(0.01 * std::exp(-std::pow((nm - centre_nm) / width_nm, 2.0)));
    return sampled(380.0, 1.0, values);
}

DisplayCharacterisation display_with_spectra() {
    DisplayCharacterisation display = sample_display();
    display.spectra.emplace();
    display.spectra->channels = {bump(610.0, 22.0), bump(535.0, 30.0), bump(455.0, 15.0)};
    display.spectra->black = bump(500.0, 80.0);
    for (double& value : display.spectra->black.values)
        value *= 0.002;
    for (std::size_t i = 0; i < 3; ++i)
        display.primaries_xyz[i] = tristimulus_of(display.spectra->channels[i], ColourSpace::cie1931_xyz);
    display.black_xyz = tristimulus_of(display.spectra->black, ColourSpace::cie1931_xyz);
    return display;
}

/// A frame of one pixel, wholly on the object.
SpectralFrame frame_of(const Spectrum& light) {
    SpectralFrame frame;
    frame.size_px = {1, 1};
    for (const double value : light)
        frame.radiance.push_back(static_cast<float>(value));
    frame.alpha = {1.0f};
    frame.is_complete = true;
    return frame;
}

/// The light of 31 bins, each even over its 10 nm.
SampledSpectrum spectrum_of(const Spectrum& light) {
    std::vector<double> wavelengths, values;
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        for (int step = 0; step < 10; ++step) {
            wavelengths.push_back(first_bin_centre_nm +
                                  bin_width_nm * (static_cast<double>(bin) + (step + 0.5) / 10.0 - 0.5));
            values.push_back(light[bin]);
        }
    }
    return {wavelengths, values};
}

} // namespace

TEST_CASE("XYZ given are XYZ shown, Y = 1 as bright as the display's white", "[unit]") {
    const DisplayCharacterisation display = sample_display();
    const glm::dmat3 from_xyz = display_from(PictureColours::cie1931_xyz, measured(display));
    RandomStream random(4, "colours");
    const double white = display.luminance_of(1.0) - display.luminance_of(0.0);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 xyz(random.uniform(0.0, 1.2), random.uniform(0.0, 1.2), random.uniform(0.0, 1.2));
        const glm::dvec3 shown = primary_matrix(display.primaries_xyz) * (from_xyz * xyz);
        CHECK(glm::distance(shown, white * xyz) < 1e-9 * white);
    }
    // The way by Rec. 709 is the same.
    CHECK(largest_difference(from_xyz * xyz_from(PictureColours::rec709),
                             display_from(PictureColours::rec709, measured(display))) < 1e-12);
}

TEST_CASE("the display's own light stays, and one that nobody measured is taken for Rec. 709", "[unit]") {
    const glm::dmat3 same(1.0);
    CHECK(display_from(PictureColours::display, measured(sample_display())) == same);
    CHECK(display_from(PictureColours::rec709, {}) == same);
    // D65 with Y = 1 is white.
    const glm::dvec3 white = display_from(PictureColours::cie1931_xyz, {}) *
                             glm::dvec3(0.3127 / 0.3290, 1.0, (1.0 - 0.3127 - 0.3290) / 0.3290);
    CHECK(glm::distance(white, glm::dvec3(1.0)) < 1e-12);
    LinearImage picture({1, 1});
    picture.pixels = {{0.25f, 0.5f, 0.75f, 0.5f}};
    transform(picture, glm::dmat3(2.0));
    CHECK(picture.pixels[0] == glm::vec4(0.5f, 1.0f, 1.5f, 0.5f));
}

TEST_CASE("light rendered for CIE 2006 has on the display the colour that this observer saw", "[unit]") {
    const DisplayCharacterisation display = display_with_spectra();
    const glm::dmat3 to_display = display_from(PictureColours::cie2006_xyz, measured(display));
    const auto shown_xyz_f = [&](const glm::dvec3& rgb) {
        glm::dvec3 xyz(0.0);
        for (int channel = 0; channel < 3; ++channel)
            xyz += rgb[channel] * tristimulus_of(display.spectra->channels[static_cast<std::size_t>(channel)],
                                                 ColourSpace::cie2006_xyz);
        return xyz;
    };
    Spectrum white{};
    for (const Spectrum& channel : light_basis()) {
        for (std::size_t bin = 0; bin < spectral_bins; ++bin)
            white[bin] += channel[bin];
    }
    const auto rgb_of = [&](const Spectrum& light) {
        const LinearImage seen = seen_by(StandardObserver::cie2006, frame_of(light));
        return to_display * glm::dvec3(seen.pixels[0]);
    };
    const double white_y = shown_xyz_f(glm::dvec3(1.0)).y;
    CHECK(shown_xyz_f(rgb_of(white)).y == Approx(white_y).epsilon(1e-5));
    const double scale = white_y / tristimulus_of(spectrum_of(white), ColourSpace::cie2006_xyz).y;
    RandomStream random(5, "spectra");
    for (int i = 0; i < 20; ++i) {
        Spectrum light = white;
        for (double& value : light)
            value *= random.uniform(0.0, 1.0);
        const glm::dvec3 wanted = scale * tristimulus_of(spectrum_of(light), ColourSpace::cie2006_xyz);
        // 31 bins, their ends left out by trapezoids.
        CHECK(glm::distance(shown_xyz_f(rgb_of(light)), wanted) < 2e-3 * white_y);
    }
    // The two observers do not agree, or there would be nothing to choose.
    const LinearImage other = seen_by(StandardObserver::cie1931, frame_of(white));
    const glm::dvec3 rgb_1931 =
        display_from(PictureColours::rec709, measured(display)) * glm::dvec3(other.pixels[0]);
    CHECK(glm::distance(rgb_1931, rgb_of(white)) > 0.01);
    CHECK_THROWS_AS(display_from(PictureColours::cie2006_xyz, measured(sample_display())), InputError);
}
