/// `overt bake`: shards, resuming, what sessions take of it, and what it refuses.
#include <catch2/catch.hpp>

#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/stimuli/bake_plan.h"
#include "experiment/base/random.h"
#include "tests/app/stimuli/traced_experiment.h"
#include "tests/support/running_program.h"
#include "tests/support/skip.h"
#include "tests/support/small_disk.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("the shards of a bake, joined, are the whole, bit for bit", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path whole = experiment.folder().path() / "whole",
                                joined = experiment.folder().path() / "joined";
    CHECK(bake(experiment, {"--quality", "draft"}, whole).exit_code == 0);
    std::size_t before = 0;
    for (const char* const shard : {"3/3", "1/3", "2/3"}) {
        const ProgramRun run = bake(experiment, {"--quality", "draft", "--shard", shard}, joined);
        INFO(run.err);
        CHECK(run.exit_code == 0);
        const std::size_t now = files_below(joined / "frames").size();
        // Four stimuli of three poses, dealt to three.
        CHECK(now - before == 4);
        before = now;
    }
    CHECK(files_below(whole / "frames").size() == 4 * poses);
    CHECK(same_pictures(whole / "frames", joined / "frames"));
}

TEST_CASE("a bake that is killed goes on with what it had, to the same frames", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path whole = experiment.folder().path() / "whole",
                                killed = experiment.folder().path() / "killed";
    const std::vector<std::string> wish{"--quality", "draft", "--samples", "200"};
    pid_t program_that_was_killed = 0;
    {
        std::vector<std::string> arguments{"bake", experiment.protocol().string(), "--context", "osmesa"};
        arguments.insert(arguments.end(), wish.begin(), wish.end());
        RunningProgram program(arguments, {"OVERT_CACHE=" + killed.string()},
                               experiment.folder().path() / "said");
        while (program.is_running() && whole_files_below(killed / "frames") < 2)
            usleep(2000);
        REQUIRE(program.is_running());
        program.signal(SIGKILL);
        program.wait();
        program_that_was_killed = program.id();
    }
    std::map<std::string, std::filesystem::file_time_type> kept;
    for (const auto& file : files_below(killed / "frames")) {
        if (file.filename().string().front() != '.')
            kept[file.string()] = std::filesystem::last_write_time(killed / "frames" / file);
    }
    CHECK(kept.size() >= 2);
    // What a program that was killed leaves half written, at its name and host, and what a running one
    // writes.
    char host[65] = "";
    ::gethostname(host, sizeof host - 1);
    const std::filesystem::path one = kept.begin()->first;
    const auto hidden = [&](pid_t writer) {
        const std::string name = fmt::format(".{}.partial-{}-{}-7", one.filename().string(), host, writer);
        return experiment.folder().file(("killed/frames" / one.parent_path() / name).string(), "half");
    };
    const std::filesystem::path abandoned = hidden(program_that_was_killed), alive = hidden(::getpid());
    const ProgramRun on = bake(experiment, wish, killed);
    CHECK(on.exit_code == 0);
    CHECK_FALSE(std::filesystem::exists(abandoned));
    CHECK(std::filesystem::remove(alive));
    CHECK(whole_files_below(killed) == static_cast<int>(files_below(killed).size()));
    CHECK(on.out.find(fmt::format("{} of {} frames are there, {} rendered now", 4 * poses, 4 * poses,
                                  4 * poses - kept.size())) != std::string::npos);
    for (const auto& [file, time] : kept)
        CHECK(std::filesystem::last_write_time(killed / "frames" / file) == time);
    CHECK(bake(experiment, wish, whole).exit_code == 0);
    for (const auto& file : files_below(whole / "frames"))
        CHECK(values_in(whole / "frames" / file) == values_in(killed / "frames" / file));
}

TEST_CASE("Ctrl-C ends a bake between two frames and says how to go on", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path said = experiment.folder().path() / "said";
    RunningProgram program(
        {"bake", experiment.protocol().string(), "--context", "osmesa", "--samples", "2000"},
        {"OVERT_CACHE=" + experiment.cache().string()}, said);
    while (program.is_running() && files_below(experiment.cache() / "frames").empty())
        usleep(2000);
    REQUIRE(program.is_running());
    program.signal(SIGINT);
    CHECK(program.wait() == 1);
    CHECK(text_of(said).find("the same command goes on where it ended") != std::string::npos);
    for (const auto& file : files_below(experiment.cache() / "frames"))
        CHECK(file.filename().string().front() != '.');
}

TEST_CASE("Ctrl-C ends a session's preparation with what was rendered, and the session begins the next time",
          "[session]") {
    // Previews of many poses take longer than it takes to look for the first.
    const SmallExperiment experiment(
        with(traced_protocol(), "width_px = 40\nheight_px = 48\n", "width_px = 160\nheight_px = 160\n"),
        Cache::own);
    const std::filesystem::path said = experiment.folder().path() / "said";
    const std::vector<std::string> arguments{"run",
                                             experiment.protocol().string(),
                                             "--simulate-observer",
                                             "5",
                                             "--virtual-time",
                                             "--observer",
                                             "P01",
                                             "--context",
                                             "osmesa",
                                             "--quality",
                                             "preview",
                                             "--sessions",
                                             experiment.sessions().string()};
    {
        RunningProgram program(arguments, {"OVERT_CACHE=" + experiment.cache().string()}, said);
        while (program.is_running() && whole_files_below(experiment.cache() / "frames") < 1)
            usleep(500);
        REQUIRE(program.is_running());
        program.signal(SIGINT);
        CHECK(program.wait() == 1);
    }
    INFO(text_of(said));
    CHECK(text_of(said).find("overt: interrupted while the stimuli were made ready") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(experiment.session()));
    const auto kept = files_below(experiment.cache() / "frames");
    CHECK_FALSE(kept.empty());
    CHECK(static_cast<int>(kept.size()) == whole_files_below(experiment.cache() / "frames"));
    CHECK(kept.size() < 4 * poses);
    RunningProgram again(arguments, {"OVERT_CACHE=" + experiment.cache().string()}, said);
    CHECK(again.wait() == 0);
    CHECK(std::filesystem::exists(experiment.session()));
}

TEST_CASE("a disk that takes no more ends a bake with what it had, whole", "[session]") {
#if defined(__SANITIZE_THREAD__)
    OVERT_SKIP("the thread sanitizer's own files do not fit into such a limit");
#endif
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    // The maps are there; frames of noise are larger than the limit on files.
    REQUIRE(bake(experiment, {"--quality", "preview"}).exit_code == 0);
    const auto before = files_below(experiment.cache() / "frames");
    const std::string command =
        fmt::format("ulimit -f 1; OVERT_CACHE={} exec {} bake {} --quality draft --context osmesa 2>{}",
                    experiment.cache().string(), OVERT_PROGRAM, experiment.protocol().string(),
                    (experiment.folder().path() / "said").string());
    const int status = std::system(("bash -c " + quoted_for_shell(command) + " >/dev/null").c_str());
    CHECK(WEXITSTATUS(status) == 1);
    const std::string said = text_of(experiment.folder().path() / "said");
    INFO(said);
    CHECK(said.find("What was finished before is kept") != std::string::npos);
    CHECK(files_below(experiment.cache() / "frames") == before);
    CHECK(bake(experiment, {"--quality", "draft"}).exit_code == 0);
}

TEST_CASE("a bake on a real disk that fills up keeps what is finished, and goes on when there is room",
          "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path whole = experiment.folder().path() / "whole",
                                disk_folder = experiment.folder().path() / "disk",
                                said = experiment.folder().path() / "said";
    REQUIRE(bake(experiment, {"--quality", "draft"}, whole).exit_code == 0);
    std::uint64_t bytes = 0;
    for (const auto& file : files_below(whole))
        bytes += std::filesystem::file_size(whole / file);
    SmallDisk disk(disk_folder, bytes / 2);
    if (!disk.is_there())
        OVERT_SKIP("this system lets no ordinary user mount a file system");
    const auto bake_there = [&](const std::string& more) {
        RunningProgram program(
            {"bake", experiment.protocol().string(), "--context", "osmesa", "--quality", "draft", more},
            {"OVERT_CACHE=" + (disk_folder / "cache").string()}, said, [&] { disk.enter(); });
        return program.wait();
    };
    CHECK(bake_there("--json") == 1);
    CHECK(text_of(said).find("No space left on device. What was finished before is kept") !=
          std::string::npos);
    REQUIRE(disk.resize(4 * bytes));
    CHECK(bake_there("--json") == 0);
    const std::string told = text_of(said);
    INFO(told);
    const auto json = nlohmann::json::parse(told.substr(told.find('{')));
    CHECK(json.at("there_before") > 0);
    CHECK(json.at("there_before") < json.at("frames"));
    CHECK(json.at("complete") == true);
}

TEST_CASE("a bake that makes no sense is refused before anything is rendered", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const auto refusal = [&](const std::vector<std::string>& more, const std::string& reason) {
        const ProgramRun run = bake(experiment, more);
        INFO(run.err);
        CHECK(run.exit_code == 2);
        CHECK(run.err.find(reason) != std::string::npos);
    };
    refusal({"--shard", "3/2"}, "1/4 to 4/4");
    refusal({"--shard", "0/2"}, "1/4 to 4/4");
    refusal({"--shard", "one"}, "1/4 to 4/4");
    refusal({"--stimulus", "bust/smoth"}, "did you mean \"bust/smooth\"");
    refusal({"--stimulus", "bust"}, "bust/smooth");
    refusal({"--frames", "5-7"}, "frames 0 to 6");
    refusal({"--frames", "4-2"}, "0-30");
    refusal({"--quality", "perfect"}, "--quality");
    refusal({"--samples", "0"}, "--samples");
    refusal({"--samples", "1000000"}, "--samples");
    refusal({"--as", "spectra"}, "--out");
    refusal({"--as", "xyz", "--png16", "--out", "x"}, "EXR");
    refusal({"--strip", "strip.png"}, "--stimulus");
    refusal({"--sheet", "sheet.png", "--shard", "1/2"}, "when all are there");
    refusal({"--sheet", "sheet.png", "--stimulus", "bust/matt"}, "leave out --stimulus");
    const auto file = experiment.folder().file("out", "no folder");
    refusal({"--out", file.string()}, "is no folder");
    CHECK(files_below(experiment.cache() / "frames").empty());
    const SmallExperiment dark(
        with(traced_protocol(), "[animation]\n", "[light]\nprobe = \"no.exr\"\n[animation]\n"), Cache::own);
    const ProgramRun run = bake(dark, {});
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("there is no file") != std::string::npos);
}

TEST_CASE("a session takes the best quality that is there of all stimuli, and records it", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const ProgramRun first = experiment.run({"--trials", "1"});
    INFO(first.err);
    CHECK(first.exit_code == 0);
    CHECK(first.out.find("frames: path traced, preview") != std::string::npos);
    REQUIRE(bake(experiment, {"--quality", "draft", "--stimulus", "bust/smooth"}).exit_code == 0);
    CHECK(experiment.run({"--trials", "1"}).out.find("frames: path traced, preview") != std::string::npos);
    REQUIRE(bake(experiment, {"--quality", "draft"}).exit_code == 0);
    const ProgramRun better = experiment.run({"--trials", "1"});
    CHECK(better.out.find("frames: path traced, draft: 16 samples, CIE 1931") != std::string::npos);
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string()});
    CHECK(check.out.find("One with a simulated observer takes draft.") != std::string::npos);
    CHECK(check.out.find("A session is refused until `overt bake` has made standard quality.") !=
          std::string::npos);
    CHECK(check.out.find(fmt::format("draft                       {0} of {0} frames", 4 * poses)) !=
          std::string::npos);
}

TEST_CASE("a session that asks for more than is there is refused, with what to do", "[session]") {
    const SmallExperiment experiment(
        with(traced_protocol(), "[tracker]\n", "[bake]\nquality = \"standard\"\n[tracker]\n"), Cache::own);
    const ProgramRun refused = experiment.run({"--trials", "1"});
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("run `overt bake") != std::string::npos);
    CHECK(files_below(experiment.sessions()).empty());
    const ProgramRun content = experiment.run({"--trials", "1", "--quality", "preview"});
    INFO(content.err);
    CHECK(content.exit_code == 0);
    // A look takes what there is.
    CHECK(experiment
              .overt({"play", experiment.protocol().string(), "--stimulus", "bust/matt", "--picture",
                      (experiment.folder().path() / "p.png").string()})
              .exit_code == 0);
}

TEST_CASE("a look at one frame renders one preview, a look at another one more", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const auto look = [&](const std::string& frame) {
        return experiment.overt({"play", experiment.protocol().string(), "--stimulus", "bust/matt", "--frame",
                                 frame, "--picture", (experiment.folder().path() / "p.png").string()});
    };
    // Frames 0 and 6 of a period share a pose.
    int rendered = 0;
    for (const auto& [frame, more] : {std::pair{"1", 1}, {"0", 1}, {"6", 0}, {"4", 1}}) {
        const ProgramRun run = look(frame);
        INFO("frame " << frame << '\n' << run.err);
        CHECK(run.exit_code == 0);
        CHECK(whole_files_below(experiment.cache() / "frames") == (rendered += more));
    }
}

TEST_CASE("a person is not shown previews unless somebody says so", "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    std::string text = with(traced_protocol(), "refresh_hz = 120", "refresh_hz = 60");
    text = with(text, "output = \"color++\"",
                "output = \"native-8bit\"\nlinearised_by = \"display\"\ntiming = \"unproven\"");
    const auto refused = [](const SmallExperiment& experiment) {
        return experiment.overt({"run", experiment.protocol().string(), "--observer", "P01", "--context",
                                 "window", "--windowed", "--refresh-check", "0", "--sessions",
                                 experiment.sessions().string()},
                                x_server_alone);
    };
    const SmallExperiment experiment(text, Cache::own);
    const ProgramRun run = refused(experiment);
    INFO(run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("frames of standard quality") != std::string::npos);
    CHECK(run.err.find("run `overt bake") != std::string::npos);
    CHECK(files_below(experiment.sessions()).empty());
}

TEST_CASE("shards share out all units once, and evenly by cost", "[unit]") {
    std::vector<BakeUnit> units;
    RandomStream random(3, "units");
    double all = 0.0, dearest = 0.0;
    for (int i = 0; i < 97; ++i) {
        units.push_back({{i / 30, i % 30 / 10}, {{Degrees{1.0 * (i % 10)}}, {}}, random.uniform(1.0, 20.0)});
        all += units.back().cost;
        dearest = std::max(dearest, units.back().cost);
    }
    for (const int count : {1, 2, 7, 97, 200}) {
        std::map<std::tuple<int, int, double>, int> seen;
        for (int number = 1; number <= count; ++number) {
            double load = 0.0;
            for (const BakeUnit& unit : dealt_to({number, count}, units)) {
                ++seen[{unit.stimulus.object, unit.stimulus.material, unit.pose.object.angle.value}];
                load += unit.cost;
            }
            CHECK(load <= all / count + dearest);
        }
        std::map<std::tuple<int, int, double>, int> wanted;
        for (const BakeUnit& unit : units)
            ++wanted[{unit.stimulus.object, unit.stimulus.material, unit.pose.object.angle.value}];
        CHECK(seen == wanted);
    }
}
