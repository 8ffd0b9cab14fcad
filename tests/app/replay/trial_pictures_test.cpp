/// Frames of a recorded trial with the gaze on them, and the trial as a movie.
#include "tests/app/replay/replayed_session.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/replay/replay_picture.h"
#include "experiment/pictures/picture_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::vector<std::uint8_t> rgb_of(const fs::path& png) {
    PictureFile picture(png, "picture");
    const glm::ivec2 size = picture.header().size_px;
    std::vector<std::uint8_t> bytes(3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    picture.read(3, PixelType::bits8, bytes.data());
    return bytes;
}

/// Mean of the gaze in the image over the samples of a trial that fell on a frame, by the exported table.
glm::dvec2 mean_gaze(const fs::path& samples, const std::string& trial, const std::string& frame) {
    std::istringstream table(text_of(samples));
    std::map<std::string, std::size_t> columns;
    glm::dvec2 sum{0.0};
    int count = 0;
    for (std::string line; std::getline(table, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, '\t');)
            cells.push_back(cell);
        if (columns.empty())
            for (std::size_t i = 0; i < cells.size(); ++i)
                columns[cells[i]] = i;
        else if (cells[columns.at("trial")] == trial && cells[columns.at("frame")] == frame) {
            sum += glm::dvec2(std::stod(cells[columns.at("image_x_px")]),
                              std::stod(cells[columns.at("image_y_px")]));
            ++count;
        }
    }
    return sum / static_cast<double>(count);
}

} // namespace

TEST_CASE("a frame of a trial is drawn as it was lit, with the gaze on it, and its surface point is told",
          "[session]") {
    const SmallExperiment experiment;
    const std::string faults =
        experiment.folder()
            .file("faults.toml", with(faults_of_both, "refreshes = 4", "refreshes = 8"))
            .string();
    REQUIRE(experiment.run({"--trials", "2", "--faults", faults}).exit_code == 0);
    const fs::path file = experiment.folder().path() / "frame.png";
    const ProgramRun run =
        replay(experiment, {"--trial", "2", "--frame", "9", "--picture", file.string(), "--json"});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const auto json = nlohmann::json::parse(run.out);
    CHECK(json["trial"] == 2);
    CHECK(json["frame"] == 9);
    CHECK(json["shown_animation_frame"] == 8);
    CHECK(json["samples"] >= 32);
    CHECK(json["samples"] <= 34); // 1000 Hz, a thirtieth of a second
    REQUIRE(experiment
                .overt({"export", experiment.session().string(), "--out",
                        (experiment.folder().path() / "tables").string()})
                .exit_code == 0);
    // A sample at the edge of the frame's time may fall on the frame beside it.
    const glm::dvec2 mean = mean_gaze(experiment.folder().path() / "tables" / "samples.tsv", "2", "8");
    CHECK(json["gaze_image_px"][0].get<double>() == Approx(mean.x).margin(0.5));
    CHECK(json["gaze_image_px"][1].get<double>() == Approx(mean.y).margin(0.5));
    CHECK(json["begin_s"].get<double>() == Approx(8.0 / 30.0));
    CHECK(json["surface_point"]["unit"] == "mm");

    // Where eight refreshes from the 50th on were skipped, the frame before stayed.
    const ProgramRun late =
        replay(experiment, {"--trial", "2", "--frame", "14", "--picture",
                            (experiment.folder().path() / "late.png").string(), "--json"});
    const auto told = nlohmann::json::parse(late.out);
    CHECK(told["planned_animation_frame"] == 13);
    CHECK(told["shown_animation_frame"] == 12);

    const ProgramRun again = replay(experiment, {"--trial", "2", "--frame", "9", "--picture", file.string()});
    CHECK(again.exit_code == 2);
    CHECK_THAT(again.err, Contains("frame.png") && Contains("--overwrite"));
    const std::vector<std::uint8_t> before = rgb_of(file);
    CHECK(replay(experiment, {"--trial", "2", "--frame", "9", "--picture", file.string(), "--overwrite"})
              .exit_code == 0);
    CHECK(rgb_of(file) == before);
    CHECK_THAT(replay(experiment, {"--trial", "2", "--frame", "31", "--picture", "x.png"}).err,
               Contains("--frame 31") && Contains("30 frames"));
    CHECK_THAT(replay(experiment, {"--trial", "3", "--frame", "1", "--picture", "x.png"}).err,
               Contains("no attempt at trial 3"));
    CHECK(replay(experiment, {"--trial", "2"}).exit_code == 2);
    CHECK(replay(experiment, {"--trial", "2", "--picture", "x.png"}).exit_code == 2);
}

TEST_CASE("gaze is drawn where it was, over the display's background", "[unit]") {
    LinearImage frame({40, 30});
    ShownFrame shown;
    shown.gaze_px = {{10.5, 20.5}};
    shown.mean_px = glm::dvec2(10.5, 20.5);
    const LinearImage image = with_gaze(frame, shown, 0.25);
    CHECK(image.at(39, 0) == glm::vec4(0.25f, 0.25f, 0.25f, 1.0f));
    CHECK(image.at(10, 20).r > 0.9f); // the dot
    CHECK(image.at(10, 20).g < 0.1f);
    CHECK(image.at(18, 20).g > 0.8f); // the ring, 8 pixels away
    CHECK(image.at(14, 20) == glm::vec4(0.25f, 0.25f, 0.25f, 1.0f));
}

TEST_CASE("a movie has each frame as its picture has it, and needs ffmpeg", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    const fs::path folder = experiment.folder().path();
    const std::string movie = (folder / "trial.mp4").string();
    const std::vector<std::string> asked{"replay", experiment.session().string(), "--trial", "1", "--movie",
                                         movie};
    const ProgramRun without = experiment.overt(asked, {"PATH=" + (folder / "meshes").string()});
    CHECK(without.exit_code == 1);
    CHECK_THAT(without.err, Contains("ffmpeg") && Contains("apt-get install ffmpeg"));
    CHECK_FALSE(fs::exists(movie));

    // One that keeps what it is given, in the file that its last word names.
    const auto stand_in = [&](const std::string& does) {
        const fs::path program = experiment.folder().file("bin/ffmpeg", "#!/bin/bash\n" + does + "\n");
        fs::permissions(program, fs::perms::owner_all);
        return std::vector<std::string>{"PATH=" + (folder / "bin").string() + ":/usr/bin:/bin"};
    };
    const ProgramRun run =
        experiment.overt(asked, stand_in("cat > \"${@: -1}\"; echo \"$@\" > " + (folder / "words").string()));
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(text_of(folder / "words"), Contains("-video_size 128x128 -framerate 30.000000"));
    const std::string frames = text_of(movie);
    constexpr std::size_t bytes = 3 * 128 * 128;
    REQUIRE(frames.size() == 30 * bytes);
    for (const int number : {1, 17, 30}) {
        const fs::path picture = folder / fmt::format("{}.png", number);
        REQUIRE(replay(experiment,
                       {"--trial", "1", "--frame", std::to_string(number), "--picture", picture.string()})
                    .exit_code == 0);
        const std::vector<std::uint8_t> expected = rgb_of(picture);
        const std::string found = frames.substr(static_cast<std::size_t>(number - 1) * bytes, bytes);
        CHECK(std::equal(expected.begin(), expected.end(), found.begin(),
                         [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }));
    }
    CHECK(experiment.overt(asked, stand_in("cat > /dev/null")).exit_code == 2); // the file is there
    fs::remove(movie);
    const ProgramRun failed = experiment.overt(asked, stand_in("echo no such codec; exit 1"));
    CHECK(failed.exit_code == 1);
    CHECK_THAT(failed.err, Contains("trial.mp4") && Contains("no such codec"));
    CHECK_FALSE(fs::exists(movie));
}
