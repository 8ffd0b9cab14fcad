/// Frames of another renderer, from 16-bit files to the bytes of the display's signal.
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "app/inputs/protocol_inputs.h"
#include "devices/host/clocks.h"
#include "experiment/base/random.h"
#include "experiment/pictures/picture_file.h"
#include "render/gl/headless_context.h"
#include "render/presenter/page_presenter.h"
#include "render/stimulus/stimulus_library.h"
#include "tests/app/small_experiment.h"
#include "tests/support/gl_contexts.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr int width = 32, height = 24, frame_count = 5, first_number = 7;

constexpr std::string_view protocol_text = R"([protocol]
name = "ready-made"
[display]
width_px = 544
height_px = 96
width_mm = 272
height_mm = 48
viewing_distance_mm = 573
output = "color++"
[view]
width_px = 32
height_px = 24
[animation]
frame_count = 5
frame_rate_hz = 30
duration_s = 1
[screens]
text_height_deg = 0.45
[[object]]
id = "a"
[[material]]
id = "png"
kind = "diffuse"
[[material]]
id = "tiff"
kind = "diffuse"
[[material]]
id = "exr"
kind = "diffuse"
[[task]]
id = "free"
question = "Look."
[[frames]]
object = "a"
material = "png"
files = "frames/####.png"
first_number = 7
[[frames]]
object = "a"
material = "tiff"
files = "frames/####.tif"
first_number = 7
[[frames]]
object = "a"
material = "exr"
files = "frames/####.exr"
first_number = 7
)";

/// 16-bit values of one frame, red, green and blue of each pixel. The sum of each pair of pixels is even, so
/// that its mean is a 16-bit value, too. Every file format gets another picture.
std::vector<std::uint16_t> values_of(int frame, int format) {
    RandomStream random(static_cast<std::uint64_t>(100 * format + frame), "ready-made frame");
    std::vector<std::uint16_t> values(3 * width * height);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<std::uint16_t>(random.uniform(0.0, 65535.9));
        const bool is_right = (i / 3) % 2 == 1;
        if (is_right && (values[i] + values[i - 3]) % 2 == 1)
            values[i] = static_cast<std::uint16_t>(values[i] ^ 1u);
    }
    return values;
}

void write(const std::filesystem::path& file, PixelType type, const void* values) {
    write_picture(file, {{width, height}, {"R", "G", "B"}, type}, type, values);
}

void write_frames(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (int frame = 0; frame < frame_count; ++frame) {
        const std::string name = fmt::format("{:04}", first_number + frame);
        write(folder / (name + ".png"), PixelType::bits16, values_of(frame, 0).data());
        write(folder / (name + ".tif"), PixelType::bits16, values_of(frame, 1).data());
        std::vector<float> light;
        for (const std::uint16_t value : values_of(frame, 2))
            light.push_back(static_cast<float>(value / 65535.0));
        write(folder / (name + ".exr"), PixelType::float32, light.data());
    }
}

/// What a Display++ makes of two neighbouring pixels in Color++ mode: the left one's bytes are the high ones.
int decoded(const std::vector<std::byte>& canvas, int screen_width, int x, int y, std::size_t channel) {
    const std::size_t left = static_cast<std::size_t>(y * screen_width + (x & ~1)) * 4;
    return 256 * std::to_integer<int>(canvas[left + channel]) +
           std::to_integer<int>(canvas[left + 4 + channel]);
}

} // namespace

TEST_CASE("the 16 bits of PNG, TIFF and EXR frames arrive in the signal, bit for bit", "[gl]") {
    const TemporaryFolder folder;
    write_frames(folder.path() / "frames");
    Diagnostics diagnostics;
    const std::optional<Experiment> experiment = read_experiment(
        folder.file("p.toml", protocol_text), folder.path() / "cache", InputDepth::everything, diagnostics);
    INFO(diagnostics.print());
    REQUIRE(experiment);
    const Protocol& protocol = experiment->protocol;
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    for (const ContextKind kind : headless_kinds) {
        const auto context = make_headless_context(kind);
        StimulusLibrary library(*context, protocol, experiment->objects, folder.path() / "cache");
        library.prepare_frames({}, BakeQuality::preview);
        VirtualClock clock;
        VirtualDisplay display(*context, clock, protocol.display.refresh_hz);
        PagePresenter presenter(*context, display, library, geometry, protocol.display, protocol.screens);
        for (int format = 0; format < 3; ++format) {
            presenter.load_frames({0, format});
            for (int frame = 0; frame < frame_count; ++frame) {
                presenter.flip({frame});
                const std::vector<std::byte> canvas = presenter.read_canvas();
                const std::vector<std::uint16_t> values = values_of(frame, format);
                int wrong = 0;
                for (int i = 0; i < width * height; i += 2) {
                    for (std::size_t channel = 0; channel < 3; ++channel) {
                        const std::size_t left = 3 * static_cast<std::size_t>(i) + channel;
                        const int expected = (values[left] + values[left + 3]) / 2;
                        const glm::ivec2 place = geometry.image_origin_px + glm::ivec2(i % width, i / width);
                        wrong += decoded(canvas, geometry.screen_px.x, place.x, place.y, channel) != expected;
                    }
                }
                CAPTURE(name_of(kind), format, frame);
                CHECK(wrong == 0);
            }
        }
    }
}

TEST_CASE("an object that is frames only runs through a whole session", "[session]") {
    const TemporaryFolder folder;
    write_frames(folder.path() / "frames");
    const std::string protocol = folder.file("p.toml", protocol_text).string();
    const std::filesystem::path sessions = folder.path() / "sessions";
    const ProgramRun run =
        run_overt({"run", protocol, "--observer", "1", "--simulate-observer", "1", "--virtual-time",
                   "--context", "osmesa", "--sessions", sessions.string()},
                  {"OVERT_CACHE=" + (folder.path() / "cache").string()});
    INFO(run.err);
    CHECK(run.exit_code == 0);
    CHECK(run.out.find("3 of 3 trials completed, 0 refreshes missed") != std::string::npos);
    const std::filesystem::path session = sessions / "ready-made/sub-1_ses-01";
    const ProgramRun exported = run_overt({"export", session.string()});
    INFO(exported.err);
    CHECK(exported.exit_code == 0);
    CHECK(exported.out.find("0.0 % on the object") != std::string::npos);
    // There is no surface to show.
    CHECK(run_overt({"show", session.string(), "--picture", (folder.path() / "p.png").string()}).exit_code ==
          2);
}
