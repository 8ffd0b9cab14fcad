/// Sixteen bits from the path tracer's film to what the display decodes.
#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "app/inputs/protocol_inputs.h"
#include "devices/host/clocks.h"
#include "render/bake/light_colour.h"
#include "render/gl/headless_context.h"
#include "render/presenter/page_presenter.h"
#include "render/signal/signal_decoder.h"
#include "render/stimulus/stimulus_library.h"
#include "tests/app/stimuli/traced_experiment.h"
#include "tests/support/gl_contexts.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr glm::ivec2 image_px{400, 328}; ///< at least twice 65,536 pixels: Color++ takes two for a level
constexpr Stimulus matt_bust{0, 1};

std::string ramp_protocol() {
    std::string text =
        with(traced_protocol(), "width_px = 40\nheight_px = 48\n", "width_px = 400\nheight_px = 328\n");
    return with(text, "width_px = 544\nheight_px = 192\n", "width_px = 544\nheight_px = 400\n");
}

/// What the tracer gives of a pixel that lies wholly on the object.
std::vector<float> traced_light(const SpectralFrame& frame) {
    for (std::size_t i = 0; i < frame.alpha.size(); ++i) {
        const auto bins = std::span(frame.radiance).subspan(i * spectral_bins, spectral_bins);
        if (frame.alpha[i] == 1.0f && std::ranges::all_of(bins, [](float value) { return value > 0.0f; }))
            return {bins.begin(), bins.end()};
    }
    throw std::runtime_error("the frame shows nothing");
}

/// In double precision: CIE 1931 XYZ, Rec. 709, the display's light.
glm::dvec3 predicted(std::span<const float> light, double share, const glm::dmat3& display_from_rec709) {
    glm::dvec3 xyz(0.0);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        for (int axis = 0; axis < 3; ++axis)
            xyz[axis] += share * double{light[bin]} * cie1931_xyz()[static_cast<std::size_t>(axis)][bin];
    }
    return display_from_rec709 * rec709_of_xyz(xyz);
}

} // namespace

TEST_CASE("every level of a ramp comes through film, cache, frame store and encoder within one code",
          "[gl]") {
    const SmallExperiment files(ramp_protocol(), Cache::own);
    Diagnostics diagnostics;
    const auto experiment =
        read_experiment(files.protocol(), files.cache(), InputDepth::objects, diagnostics);
    REQUIRE(experiment);
    const Protocol& protocol = experiment->protocol;
    const auto context = make_headless_context(ContextKind::osmesa);
    StimulusLibrary library(*context, protocol, experiment->objects, files.cache());
    const StimulusCache& cache = library.cache();
    library.maps().prepare_maps({0}, {});

    // Light of the material under the protocol's light, as the tracer gives it ...
    const FrameQuality quality = quality_of(BakeQuality::draft, protocol.bake);
    SpectralFrame frame =
        library.frames().trace(matt_bust, cache.pictures_of(matt_bust)[0], {BakeQuality::draft, 1, {}}, {});
    const std::vector<float> light = traced_light(frame);

    // ... at every level from black to where its brightest channel is the display's white.
    const glm::dmat3 to_display = cache.display_from_frame(matt_bust, quality);
    const glm::dvec3 full = predicted(light, 1.0, to_display);
    const int brightest = full.x >= std::max(full.y, full.z) ? 0 : full.y >= full.z ? 1 : 2;
    const auto share_of = [&](int level) { return level / 65535.0 / full[brightest]; };
    const auto level_at = [](int pixel) { return pixel / 2 % 65536; };
    for (std::size_t i = 0; i < frame.alpha.size(); ++i) {
        const double share = share_of(level_at(static_cast<int>(i)));
        for (std::size_t bin = 0; bin < spectral_bins; ++bin)
            frame.radiance[i * spectral_bins + bin] = static_cast<float>(share * double{light[bin]});
        frame.alpha[i] = 1.0f;
    }
    const std::vector<Pose> missing = cache.missing_frames(matt_bust, quality);
    REQUIRE(missing.size() == poses);
    for (const Pose& pose : missing)
        cache.store(matt_bust, pose, quality, frame);
    library.take_frames(quality);

    VirtualClock clock;
    VirtualDisplay surface(*context, clock, 120.0, row_of(protocol.display.output).framebuffer_bits);
    ScreenGeometry geometry;
    geometry.screen_px = {protocol.display.width_px, protocol.display.height_px};
    geometry.image_px = image_px;
    geometry.image_origin_px = {72, 40};
    PagePresenter presenter(*context, surface, library, geometry, protocol.display, {});
    presenter.load_frames(matt_bust);
    presenter.flip({0});
    const std::vector<std::byte> canvas = presenter.read_canvas();
    const ReceivedLight received = receive_light({geometry.screen_px, canvas}, OutputMode::color_plus_plus);

    int largest = 0;
    std::set<int> levels;
    for (int pixel = 0; pixel < 2 * 65536; pixel += 2) {
        const glm::ivec2 at = geometry.image_origin_px + glm::ivec2(pixel % image_px.x, pixel / image_px.x);
        const auto& shown = received.at(at.x / 2, at.y);
        const glm::dvec3 expected = predicted(light, share_of(level_at(pixel)), to_display);
        for (int channel = 0; channel < 3; ++channel) {
            const auto code = std::lround(65535.0 * std::clamp(expected[channel], 0.0, 1.0));
            largest = std::max(largest,
                               std::abs(static_cast<int>(code) - shown[static_cast<std::size_t>(channel)]));
        }
        levels.insert(shown[static_cast<std::size_t>(brightest)]);
    }
    CHECK(largest <= 1);
    // Half floats anywhere on the way would leave 7,169.
    CHECK(levels.size() > 65000);
}
