/// Lights, motions and views of a bake: which frames and maps they make, and which they share.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/app/stimuli/traced_experiment.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr std::string_view animation = "[animation]\nframe_count = 7\nframe_rate_hz = 6\namplitude_deg = 25\n"
                                       "duration_s = 1\n";

std::string with_motions(std::string_view more) {
    return with(traced_protocol(), animation,
                "[[motion]]\nid = \"turn\"\nframe_count = 7\nframe_rate_hz = 6\namplitude_deg = 25\n"
                "duration_s = 1\n" +
                    std::string(more));
}

constexpr std::string_view lamp = R"(
[[motion]]
id = "lamp"
kind = "still"
light_amplitude_deg = 60
frame_count = 5
frame_rate_hz = 6
duration_s = 1
)";

std::size_t maps_of(const std::filesystem::path& cache) { return files_below(cache / "maps").size(); }
std::size_t frames_of(const std::filesystem::path& cache) { return files_below(cache / "frames").size(); }

} // namespace

TEST_CASE("a light that turns makes frames and no maps", "[session]") {
    const SmallExperiment still(traced_protocol(), Cache::own);
    REQUIRE(bake(still, {"--quality", "draft"}).exit_code == 0);
    const std::size_t maps = maps_of(still.cache()), frames = frames_of(still.cache());
    CHECK(maps == 2 * poses);
    CHECK(frames == 4 * poses);
    // In the same cache: the light goes to either side of where it stands, where frames are already.
    const SmallExperiment moving(with_motions(lamp), still.cache());
    const ProgramRun run = bake(moving, {"--quality", "draft"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(maps_of(still.cache()) == maps);
    CHECK(frames_of(still.cache()) == frames + 4 * 2);
    CHECK_THAT(run.out, Catch::Contains("20 of 20 frames are there, 8 rendered now"));
}

TEST_CASE("a frame under a turned light is that under the light standing there", "[session]") {
    // A camera that is fitted stands farther off where one of the motions sweeps more room.
    const auto with_camera = [](const std::string& text) {
        return with(text, "height_px = 48\n",
                    "height_px = 48\ncamera_position = [0, -900, 150]\ncamera_target = [0, 0, 150]\n");
    };
    const SmallExperiment moving(with_camera(with_motions(lamp)), Cache::own);
    const std::filesystem::path out = moving.folder().path() / "out";
    REQUIRE(bake(moving, {"--quality", "draft", "--stimulus", "bust/smooth/lamp", "--out", out.string()})
                .exit_code == 0);
    const SmallExperiment standing(
        with_camera(with(with(traced_protocol(), animation,
                              "[animation]\nkind = \"still\"\nframe_rate_hz = 6\nduration_s = 1\n"),
                         "[schedule]", "[light]\nrotation_deg = 60\n\n[schedule]")),
        Cache::own);
    const std::filesystem::path other = standing.folder().path() / "out";
    const ProgramRun run =
        bake(standing, {"--quality", "draft", "--stimulus", "bust/smooth", "--out", other.string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(files_below(other / "bust_smooth").size() == 1);
    // Frame 1 of five is a quarter of the period on.
    CHECK(values_in(out / "bust_smooth_lamp/frame_0001.exr") ==
          values_in(other / "bust_smooth/frame_0000.exr"));
    CHECK(values_in(out / "bust_smooth_lamp/frame_0001.exr") !=
          values_in(out / "bust_smooth_lamp/frame_0003.exr"));
}

TEST_CASE("motions share the frames and maps of poses that they have in common, views have their own",
          "[session]") {
    const SmallExperiment experiment(
        with(
            with_motions("\n[[motion]]\nid = \"right\"\nkind = \"still\"\nangle_deg = 25\nframe_rate_hz = 6\n"
                         "duration_s = 1\n"),
            "[view]\nwidth_px = 40\nheight_px = 48\n",
            "[[view]]\nid = \"front\"\nwidth_px = 40\nheight_px = 48\n\n[[view]]\nid = \"above\"\nwidth_px = "
            "40\n"
            "height_px = 48\ncamera_position = [0, -1500, 900]\n"),
        Cache::own);
    const ProgramRun run = bake(experiment, {"--quality", "draft"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    // Seven frames have three angles: in front, and about 22 degrees to each side; the other stands at 25.
    CHECK(maps_of(experiment.cache()) == 2 * 2 * (poses + 1));
    CHECK(frames_of(experiment.cache()) == 2 * 4 * (poses + 1));
    const SmallExperiment same(
        with_motions("\n[[motion]]\nid = \"longer\"\nframe_count = 7\nframe_rate_hz = 6\n"
                     "amplitude_deg = 25\nduration_s = 2\n"),
        Cache::own);
    const ProgramRun shared = bake(same, {"--quality", "draft"});
    INFO(shared.err);
    REQUIRE(shared.exit_code == 0);
    CHECK(maps_of(same.cache()) == 2 * poses);
    CHECK(frames_of(same.cache()) == 4 * poses);
}

TEST_CASE("a name leaves open what is the first of its list, and an unknown one is answered", "[session]") {
    const SmallExperiment experiment(with_motions(lamp));
    const std::filesystem::path picture = experiment.folder().path() / "picture.png";
    const auto play = [&](const std::string& stimulus, const std::string& frame) {
        return experiment.overt({"play", experiment.protocol().string(), "--live", "--stimulus", stimulus,
                                 "--frame", frame, "--picture", picture.string(), "--context", "osmesa"});
    };
    const ProgramRun first = play("bust/smooth", "6");
    INFO(first.err);
    CHECK(first.exit_code == 0);
    const ProgramRun beyond = play("bust/smooth/lamp", "6");
    CHECK(beyond.exit_code == 2);
    CHECK_THAT(beyond.err, Catch::Contains("has frames 0 to 4"));
    const ProgramRun unknown = play("bust/smooth/lamps", "0");
    CHECK(unknown.exit_code == 2);
    CHECK_THAT(unknown.err, Catch::Contains("bust/smooth/lamp"));
}
