/// What a user gets wrong: each thing is refused with its place and a remedy, and leaves nothing behind.
#include <catch2/catch.hpp>

#include <limits>

#include <fmt/format.h>

#include "experiment/pictures/picture_file.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Line and column of a part of a text, as diagnostics count them.
std::string place_in(const std::string& text, const std::string& part) {
    const std::size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
    const std::size_t begin = text.rfind('\n', at) + 1; // npos + 1 is 0
    return fmt::format("{}:{}", line, at - begin + 1);
}

void check_says(const ProgramRun& run, int exit_code, const std::vector<std::string>& words) {
    INFO("said: " << run.err);
    CHECK(run.exit_code == exit_code);
    for (const std::string& word : words) {
        CAPTURE(word);
        CHECK(run.err.find(word) != std::string::npos);
    }
}

/// A protocol is refused by `check` and by `run` alike, at the part of its text that is wrong; nothing of a
/// session is made.
void check_refused(const SmallExperiment& experiment, const std::string& wrong_part,
                   const std::vector<std::string>& words) {
    const std::string place = place_in(text_of(experiment.protocol()), wrong_part);
    std::vector<std::string> expected{fmt::format("small.toml:{}: error: ", place)};
    expected.insert(expected.end(), words.begin(), words.end());
    check_says(experiment.overt({"check", experiment.protocol().string()}), 2, expected);
    check_says(experiment.run(), 2, expected);
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}

void write_grey(const std::filesystem::path& file, int width, int height, float value) {
    std::filesystem::create_directories(file.parent_path());
    const std::vector<float> pixels(static_cast<std::size_t>(3 * width * height), value);
    write_picture(file, {{width, height}, {"R", "G", "B"}, PixelType::float32}, PixelType::float32,
                  pixels.data());
}

const std::string with_frames = std::string(small_protocol) + R"(
[[frames]]
object = "bust"
material = "matt"
files = "frames/##.exr"
)";

void write_good_frames(const SmallExperiment& experiment) {
    for (int frame = 0; frame < 31; ++frame)
        write_grey(experiment.folder().path() / fmt::format("frames/{:02}.exr", frame), 128, 128, 0.5f);
}

} // namespace

TEST_CASE("an unknown key, a wrong type and a missing file are refused at their places", "[session]") {
    check_refused(
        SmallExperiment(with(small_protocol, "viewing_distance_mm = 573", "viewing_distnace_mm = 573")),
        "viewing_distnace_mm", {"unknown key", "did you mean \"viewing_distance_mm\"?"});
    check_refused(SmallExperiment(with(small_protocol, "width_mm = 272", "width_mm = \"272\"")), "\"272\"",
                  {"a number"});
    check_refused(SmallExperiment(with(small_protocol, "meshes/bust.ply", "meshes/best.ply")),
                  "\"meshes/best.ply\"", {"there is no file", "meshes/best.ply"});
    check_refused(SmallExperiment(with(small_protocol, "refresh_hz = 120", "refresh_hz = 100")), "100",
                  {"no whole multiple of the frame rate of 30 Hz", "90 Hz or 120 Hz would do"});
}

TEST_CASE("all that is wrong with a protocol is said at once", "[session]") {
    const SmallExperiment experiment(
        with(with(small_protocol, "height_mm = 96", "height = 96"), "rate_hz = 1000", "rate_hz = true"));
    const std::string text = text_of(experiment.protocol());
    check_says(experiment.run(), 2,
               {fmt::format("small.toml:{}: error: unknown key \"height\"", place_in(text, "height = 96")),
                fmt::format("small.toml:{}: error: ", place_in(text, "true")), "2 errors"});
}

TEST_CASE("a mesh that cannot be used is refused at the key that names it, with the place in the mesh",
          "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path mesh = experiment.folder().path() / "meshes/bust.ply";
    const std::string sound = text_of(mesh), key = "\"meshes/bust.ply\"";
    const auto put = [&](const std::string& text) { experiment.folder().file("meshes/bust.ply", text); };

    SECTION("cut off") {
        put(sound.substr(0, sound.size() / 2));
        check_refused(experiment, key, {"meshes/bust.ply: byte "});
    }
    SECTION("without area") {
        put("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n2 0 0\n3 0 1 "
            "2\n");
        check_refused(experiment, key, {"meshes/bust.ply: ", "no area"});
    }
    SECTION("with a coordinate that is no number") {
        put("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 nan 0\n0 1 0\n3 0 "
            "1 2\n");
        check_refused(experiment, key, {"meshes/bust.ply:11:"});
    }
    SECTION("of no known format") {
        put("this is a letter to my aunt\n");
        check_refused(experiment, key, {"meshes/bust.ply"});
    }
    SECTION("both of them") {
        put("");
        experiment.folder().file("meshes/tall.ply", "");
        check_refused(experiment, key, {"\"meshes/tall.ply\"", "2 errors"});
    }
}

TEST_CASE("a head that is not where the mesh is, and a camera that does not see it, are refused",
          "[session]") {
    check_refused(
        SmallExperiment(with(small_protocol, "mesh = \"meshes/bust.ply\"",
                             "mesh = \"meshes/bust.ply\"\nhead = { spheres = [[0, 0, 9000, 50]] }")),
        "{ spheres = [[0, 0, 9000", {"head"});
    check_refused(SmallExperiment(with(
                      small_protocol, "height_px = 128",
                      "height_px = 128\ncamera_position = [0, -900, 150]\ncamera_target = [900, -900, 150]")),
                  "[0, -900, 150]", {"nowhere in the picture"});
    check_refused(SmallExperiment(with(small_protocol, "height_px = 128",
                                       "height_px = 128\ncamera_position = [0, 0, 150]")),
                  "\"meshes/bust.ply\"", {"camera"});
}

TEST_CASE("ready-made frames of another size, cut off or with no numbers in them are refused", "[session]") {
    const SmallExperiment experiment(with_frames);
    write_good_frames(experiment);
    const std::filesystem::path file = experiment.folder().path() / "frames/19.exr";
    const std::string key = "\"frames/##.exr\"";

    SECTION("of another size") {
        write_grey(file, 128, 127, 0.5f);
        check_refused(experiment, key, {"frames/19.exr", "128 x 127", "128 x 128"});
    }
    SECTION("cut off") {
        std::filesystem::resize_file(file, std::filesystem::file_size(file) - 200);
        check_refused(experiment, key, {"frames/19.exr"});
    }
    SECTION("not a number") {
        write_grey(file, 128, 128, std::numeric_limits<float>::quiet_NaN());
        check_refused(experiment, key, {"frames/19.exr", "pixel (0, 0)", "not a finite number"});
    }
    SECTION("missing") {
        std::filesystem::remove(file);
        check_refused(experiment, key, {"1 of 31 frames are missing", "frames/19.exr"});
    }
}

TEST_CASE("a light probe that is none is refused", "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, "[schedule]", "[light]\nprobe = \"sky.exr\"\n[schedule]"));
    check_refused(experiment, "\"sky.exr\"", {"there is no file"});
    write_grey(experiment.folder().path() / "sky.exr", 30, 20, 1.0f);
    check_refused(experiment, "\"sky.exr\"", {"twice as wide as high"});
}

TEST_CASE("no protocol, a folder, or a mesh instead of a protocol are refused", "[session]") {
    const SmallExperiment experiment;
    const auto folder = experiment.folder().path();
    for (const std::string command : {"check", "run", "play"}) {
        CAPTURE(command);
        std::vector<std::string> more;
        if (command == "run")
            more = {"--observer", "P01",        "--simulate-observer",
                    "1",          "--sessions", experiment.sessions().string()};
        if (command == "play")
            more = {"--stimulus", "bust/matt", "--picture", (folder / "x.png").string()};
        const auto tried = [&](const std::filesystem::path& protocol) {
            std::vector<std::string> arguments{command, protocol.string()};
            arguments.insert(arguments.end(), more.begin(), more.end());
            return experiment.overt(arguments);
        };
        check_says(tried(folder / "none.toml"), 2, {"none.toml", "No such file"});
        check_says(tried(folder), 2, {folder.string(), "folder"});
        check_says(tried(folder / "meshes/bust.ply"), 2, {"bust.ply"});
        CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
    }
}

TEST_CASE("observers, sessions and folders that cannot be are refused before anything is drawn",
          "[session]") {
    const SmallExperiment experiment(Cache::own);
    check_says(experiment.run({"--observer", "anna"}), 2, {"anna", "no number at its end", "anna01"});
    check_says(experiment.run({"--observer", "../P01"}), 2, {"../P01", "letters and digits only"});
    check_says(experiment.run({"--session", "0"}), 2, {"'0' is not a number above 0"});
    check_says(experiment.run({"--context", "vulkan"}), 2, {"--context"});
    check_says(experiment.run({"--trials", "many"}), 2, {"--trials"});
    check_says(experiment.overt({"run", experiment.protocol().string(), "--observer", "P01", "--virtual-time",
                                 "--context", "osmesa", "--sessions", experiment.sessions().string()}),
               2, {"--simulate-observer"});
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
    CHECK_FALSE(std::filesystem::exists(experiment.cache() / "frames"));

    // Even root cannot make a folder in a file, or in the process table.
    const std::filesystem::path file = experiment.folder().file("taken", "");
    check_says(
        experiment.overt({"run", experiment.protocol().string(), "--observer", "P01", "--simulate-observer",
                          "1", "--virtual-time", "--sessions", (file / "sessions").string()}),
        2, {file.string(), "no folder"});
    CHECK_FALSE(std::filesystem::exists(experiment.cache() / "frames"));
}

TEST_CASE("a number on the command line that cannot be is refused with its option", "[session]") {
    const SmallExperiment experiment;
    const std::string protocol = experiment.protocol().string();
    const auto refused = [&](const std::vector<std::string>& line, const std::vector<std::string>& words) {
        check_says(experiment.overt(line), 2, words);
    };
    refused({"import", protocol, "--screen-mm", "532x300", "300"},
            {"--screen-mm: '532x300' is not a number above 0"});
    refused({"import", protocol, "--distance-mm", "inf"}, {"--distance-mm: 'inf' is not a number above 0"});
    refused({"run", protocol, "--observer", "P01", "--session", "0"},
            {"--session: '0' is not a number above 0"});
    refused({"run", protocol, "--observer", "P01", "--pin", "-1"},
            {"--pin: '-1' is not a number of 0 or above"});
    refused({"run", protocol, "--observer", "P01", "--seed", "many"}, {"--seed", "many"});
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}

TEST_CASE("a stimulus that there is not is refused with those there are", "[session]") {
    const SmallExperiment experiment;
    const auto play = [&](const std::string& stimulus, const std::string& frame) {
        return experiment.overt({"play", experiment.protocol().string(), "--stimulus", stimulus, "--frame",
                                 frame, "--context", "osmesa", "--picture",
                                 (experiment.folder().path() / "f.png").string()});
    };
    check_says(play("bust/mat", "0"), 2, {"bust/mat", "did you mean \"bust/matt\"?"});
    check_says(play("venus", "0"), 2, {"venus", "tall/smooth"});
    check_says(play("bust/matt", "31"), 2, {"--frame 31", "0 to 30"});
    CHECK_FALSE(std::filesystem::exists(experiment.folder().path() / "f.png"));
    CHECK(play("bust/matt", "30").exit_code == 0);
}

TEST_CASE("a damaged session is told from a sound one, and nothing is exported of it", "[session]") {
    static const SmallExperiment experiment;
    if (!std::filesystem::exists(experiment.session()))
        REQUIRE(experiment.run({"--trials", "2", "--maps", "prepared"}).exit_code == 0);
    const TemporaryFolder folder;
    const std::filesystem::path session = folder.path() / "session", tables = folder.path() / "tables";
    std::filesystem::copy(experiment.session(), session, std::filesystem::copy_options::recursive);
    const auto exported = [&] {
        return experiment.overt({"export", session.string(), "--out", tables.string()});
    };
    const std::filesystem::path database = session / "session.sqlite";

    SECTION("a folder that is no session") {
        check_says(experiment.overt({"export", experiment.cache().string()}), 2,
                   {experiment.cache().string()});
        check_says(experiment.overt({"show", (session / "nowhere").string()}), 2, {"nowhere"});
        check_says(experiment.overt({"export", session.string(), "--format", "xls"}), 2, {"--format"});
    }
    SECTION("a file that is no database") {
        folder.file("session/session.sqlite", "not a database, not at all\n");
        check_says(exported(), 1, {database.string()});
        check_says(experiment.overt({"show", session.string()}), 1, {database.string()});
    }
    SECTION("cut in half") {
        std::filesystem::resize_file(database, std::filesystem::file_size(database) / 2);
        check_says(exported(), 1, {database.string()});
    }
    SECTION("bytes overwritten") {
        std::string bytes = text_of(database);
        std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 4),
                  bytes.begin() + static_cast<std::ptrdiff_t>(3 * bytes.size() / 4), 'x');
        folder.file("session/session.sqlite", bytes);
        check_says(exported(), 1, {database.string()});
    }
    SECTION("another map") {
        const std::filesystem::path map = session / "maps/bust/pose_03.exr",
                                    other = session / "maps/bust/pose_04.exr";
        std::filesystem::copy_file(other, map, std::filesystem::copy_options::overwrite_existing);
        check_says(exported(), 1, {map.string(), "changed, damaged or taken away"});
    }
    SECTION("no mesh") {
        std::filesystem::remove(session / "meshes/bust.ply");
        check_says(exported(), 1, {"bust.ply"});
    }
    SECTION("no map") {
        std::filesystem::remove(session / "maps/bust/pose_03.exr");
        check_says(exported(), 1, {"pose_03.exr"});
    }
    SECTION("another mesh") {
        write_ply(session / "meshes/bust.ply", tall_bust());
        check_says(exported(), 1, {"bust.ply"});
    }
    SECTION("no trial of that number") {
        const ProgramRun shown = experiment.overt(
            {"show", session.string(), "--trial", "3", "--picture", (folder.path() / "t.png").string()});
        check_says(shown, 2, {"no completed trial 3"});
    }
    CHECK_FALSE(std::filesystem::exists(tables));
}

TEST_CASE("what is mistyped on the command line is said with what can be meant", "[session]") {
    const SmallExperiment experiment;
    const std::string protocol = experiment.protocol().string();
    check_says(experiment.overt({"chek", protocol}), 2, {"no command \"chek\"", "\"check\""});
    check_says(experiment.overt({"help", "rum"}), 2, {"no command \"rum\"", "\"run\""});
    const ProgramRun help = experiment.overt({"help", "check"});
    CHECK(help.exit_code == 0);
    CHECK(help.out == experiment.overt({"check", "--help"}).out);
    check_says(experiment.run({"--session", "0"}), 2, {"'0' is not a number above 0"});
    check_says(experiment.overt({"check", protocol, "--seed=-1"}), 2,
               {"'-1' is not a whole number from 0 to"});
    check_says(experiment.overt({"check", protocol, "--answer-time", "nan"}), 2, {"not a number of seconds"});
    for (const char* const observer : {"0", "99999999999"})
        check_says(experiment.overt({"check", protocol, "--observer", observer}), 2, {"from 1 to 999999999"});
    check_says(experiment.overt({"check", protocol, "--observer", std::string(41, 'x')}), 2,
               {"41 characters are too many"});
}
