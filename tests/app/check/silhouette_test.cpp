/// Ready-made frames that show the object where the hidden maps have it, and others that do not.
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/check/silhouette_check.h"
#include "app/inputs/protocol_inputs.h"
#include "experiment/pictures/picture_file.h"
#include "render/gl/headless_context.h"
#include "tests/app/small_experiment.h"
#include "tests/support/gl_contexts.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr std::string_view sequence = R"(
[[frames]]
object = "bust"
material = "smooth"
files = "frames/####.png"
)";

/// The small experiment with frames of one stimulus: its hidden maps, painted by somebody else.
class PaintedExperiment {
  public:
    /// `more`: keys of the sequence.
    explicit PaintedExperiment(const std::string& more)
        : files(std::string(small_protocol) + std::string(sequence) + more) {
        std::filesystem::create_directories(files.folder().path() / "frames");
    }

    /// Paints frame after frame: light where the map of the frame is, moved; with alpha, or over a grey.
    void paint(bool alpha, const std::function<glm::ivec2(int frame)>& moved) const {
        const SmallExperiment plain;
        Diagnostics diagnostics;
        const auto experiment =
            read_experiment(plain.protocol(), plain.cache(), InputDepth::objects, diagnostics);
        REQUIRE(experiment);
        const auto context = make_headless_context(ContextKind::osmesa);
        StimulusLibrary library(*context, experiment->protocol, experiment->objects, plain.cache());
        library.maps().prepare_maps({0}, {});
        for (int frame = 0; frame < experiment->protocol.motions.front().frame_count; ++frame) {
            const TriangleMap map =
                read_triangle_map(library.cache().map_file({0}, library.cache().poses().pose_of(0, {frame})));
            PictureHeader header{map.size_px, {"R", "G", "B"}, PixelType::bits8};
            if (alpha) {
                header.channels.emplace_back("A");
                header.alpha_channel = 3;
            }
            std::vector<std::uint8_t> bytes;
            for (int y = 0; y < map.size_px.y; ++y) {
                for (int x = 0; x < map.size_px.x; ++x) {
                    const glm::ivec2 from = glm::ivec2(x, y) - moved(frame);
                    const bool on = map.code_at(from.x, from.y) != 0;
                    for (int channel = 0; channel < header.channel_count(); ++channel)
                        bytes.push_back(channel == 3 ? (on ? 255 : 0)
                                        : on         ? static_cast<std::uint8_t>(150 + (x + y) % 90)
                                                     : static_cast<std::uint8_t>(51));
                }
            }
            const auto file = files.folder().path() / fmt::format("frames/{:04}.png", frame);
            write_picture(file, header, PixelType::bits8, bytes.data());
        }
    }

    nlohmann::json check() const {
        const ProgramRun run = files.overt({"check", files.protocol().string(), "--json"});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return nlohmann::json::parse(run.out);
    }

    SmallExperiment files;
};

std::string message_with(const nlohmann::json& report, const std::string& part) {
    for (const auto& finding : report.at("findings")) {
        std::string message = finding.at("message");
        if (message.find(part) != std::string::npos)
            return message;
    }
    return {};
}

} // namespace

TEST_CASE("frames that are where their maps are agree in every pixel", "[session]") {
    PaintedExperiment painted("");
    painted.paint(true, [](int) { return glm::ivec2(0); });
    const auto report = painted.check();
    REQUIRE(report.at("silhouettes").size() == 1);
    CHECK(report.at("silhouettes")[0].at("stimulus") == "bust/smooth");
    CHECK(report.at("silhouettes")[0].at("worst_iou") == 1.0);
    CHECK(message_with(report, "silhouettes") == "");
}

TEST_CASE("a camera that moves in one frame is found, and by how much", "[session]") {
    PaintedExperiment painted("");
    painted.paint(true, [](int frame) { return frame == 17 ? glm::ivec2(3, -2) : glm::ivec2(0); });
    const auto report = painted.check();
    const auto& silhouette = report.at("silhouettes")[0];
    CHECK(silhouette.at("worst_frame") == 17);
    CHECK(silhouette.at("worst_iou") < 0.95);
    CHECK(silhouette.at("iou") > 0.99);
    CHECK(silhouette.at("worst_offset_px")[0] == Approx(3.0));
    CHECK(silhouette.at("worst_offset_px")[1] == Approx(-2.0));
    CHECK(silhouette.at("worst_size_ratio") == Approx(1.0));
    CHECK(message_with(report, " shows the object elsewhere") != "");
    // It stands at the sequence's key.
    CHECK(report.at("findings").back().at("line") == 78);
}

TEST_CASE("frames without alpha are compared by the colour of their background", "[session]") {
    PaintedExperiment painted("background_colour = [0.2, 0.2, 0.2]\nencoding = \"srgb\"\n");
    painted.paint(false, [](int frame) { return glm::ivec2(frame == 5 ? 1 : 0, 0); });
    const auto report = painted.check();
    CHECK(report.at("silhouettes")[0].at("worst_frame") == 5);
    CHECK(report.at("silhouettes")[0].at("iou") > 0.998);

    PaintedExperiment opaque("");
    opaque.paint(false, [](int) { return glm::ivec2(0); });
    const auto untold = opaque.check();
    CHECK(untold.at("silhouettes").empty());
    CHECK(message_with(untold, "the frames have no alpha") != "");
}

TEST_CASE("silhouettes have what they have in common over what they have", "[unit]") {
    const std::vector<std::uint8_t> a{1, 1, 0, 0, 1, 1, 0, 0}, b{0, 1, 1, 0, 0, 1, 1, 0}, none(8);
    const SilhouetteMatch match = match_silhouettes(b, a, 4);
    CHECK(match.iou == Approx(2.0 / 6.0));
    CHECK(match.offset_px == glm::dvec2(1.0, 0.0));
    CHECK(match.size_ratio == 1.0);
    CHECK(match_silhouettes(a, a, 4).iou == 1.0);
    CHECK(match_silhouettes(a, none, 4).iou == 0.0);
    CHECK(match_silhouettes(none, none, 4).iou == 1.0);
    CHECK(match_silhouettes(none, a, 4).frame_share == 0.0);
    CHECK(match_silhouettes(a, none, 4).frame_share == 0.5);
}

TEST_CASE("a silhouette that is mirrored or upside down is known by what turning it back would give",
          "[unit]") {
    const std::vector<std::uint8_t> map{1, 1, 0, 0, //
                                        1, 0, 0, 0};
    const std::vector<std::uint8_t> mirrored{0, 0, 1, 1, //
                                             0, 0, 0, 1};
    const std::vector<std::uint8_t> turned{1, 0, 0, 0, //
                                           1, 1, 0, 0};
    CHECK(match_silhouettes(mirrored, map, 4).iou == 0.0);
    CHECK(match_silhouettes(mirrored, map, 4).mirrored_iou == 1.0);
    CHECK(match_silhouettes(mirrored, map, 4).upside_down_iou < 1.0);
    CHECK(match_silhouettes(turned, map, 4).upside_down_iou == 1.0);
    CHECK(match_silhouettes(turned, map, 4).mirrored_iou < 1.0);
}
