// The driver with the stand-in library, loaded as the vendor's is.
#include "devices/eyelink/eyelink_driver.h"

#include <cstdlib>
#include <set>

#include <catch2/catch.hpp>

#include "devices/tracker/threaded_tracker.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "tests/devices/eyelink/eyelink_bench.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

struct DriverBench {
    StandIn library;
    SteadyClock clock;
    EyelinkSettings settings;
    TrackerWish wish;
    KeptItems kept;

    explicit DriverBench(std::string file = OVERT_STAND_IN_EYELINK) : library(std::move(file)) {
        settings.library = library.path;
        library.tell("read_mode_list", "250RB 500RB 1000B 2000");
        wish.file_name = "ob_b1";
    }

    /// Reads for so long; gives the last state.
    RecordingState read(EyelinkDriver& driver, SessionDuration time) {
        const SessionTime until = clock.now() + time;
        RecordingState state = RecordingState::running;
        while (clock.now() < until && state == RecordingState::running)
            state = driver.read(kept, clock.now() + 2ms);
        return state;
    }
};

/// The files that were opened on the host, without their ending.
std::set<std::string> opened_files(const StandIn& library) {
    std::set<std::string> names;
    for (const std::string& text : library.said())
        if (text.starts_with("file ") && text.ends_with(".EDF"))
            names.insert(text.substr(5, text.size() - 9));
    return names;
}

/// What lies in a folder, without the endings.
std::set<std::string> files_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().stem().string());
    return names;
}

/// Whether each sample is one interval after the one before it, by its time and by its number in x.
void check_unbroken(const std::vector<GazeSample>& samples, std::int64_t interval_us) {
    std::size_t wrong = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        wrong += (samples[i].sampled_at - samples[i - 1].sampled_at).count() != interval_us;
        if (samples[i].gaze)
            wrong += samples[i].gaze->x_px != static_cast<double>(i);
    }
    CHECK(wrong == 0);
}

} // namespace

TEST_CASE("an EyeLink's library that is not there is said with where to get it", "[unit][waits]") {
    CHECK_THROWS_WITH(EyelinkLibrary("/nowhere/libeyelink_core.so"),
                      Catch::Contains("/nowhere/libeyelink_core.so") && Catch::Contains("Developers Kit") &&
                          Catch::Contains("OVERT_EYELINK_LIBRARY"));
    CHECK_THROWS_WITH(EyelinkLibrary(OVERT_STAND_IN_EYELINK_LACKING),
                      Catch::Contains("lacks start_recording, check_recording"));
}

TEST_CASE("the EyeLink's library is that of the setting, else of the environment", "[unit]") {
    setenv("OVERT_EYELINK_LIBRARY", OVERT_STAND_IN_EYELINK_OLD, 1);
    CHECK(EyelinkLibrary().path() == OVERT_STAND_IN_EYELINK_OLD);
    CHECK(EyelinkLibrary(OVERT_STAND_IN_EYELINK).path() == OVERT_STAND_IN_EYELINK);
    unsetenv("OVERT_EYELINK_LIBRARY");
    CHECK_FALSE(EyelinkLibrary(OVERT_STAND_IN_EYELINK)->setup_graphic_hook_functions_V2 == nullptr);
    CHECK(EyelinkLibrary(OVERT_STAND_IN_EYELINK_OLD)->setup_graphic_hook_functions_V2 == nullptr);
}

TEST_CASE("an EyeLink is connected, told the screen and opens its file", "[unit]") {
    DriverBench bench;
    bench.wish.rate_hz = 2000.0;
    bench.wish.both_eyes = true;
    EyelinkDriver driver(bench.settings, bench.clock);
    const TrackerDescription granted = driver.connect(bench.wish);
    CHECK(granted.sample_rate_hz == 1000.0);
    CHECK(granted.both_eyes);
    CHECK_THAT(granted.model, Catch::StartsWith("EYELINK CL 5.12, its file B1") && Catch::EndsWith(".EDF"));
    CHECK(driver.tells_events());
    CHECK(driver.calibrates_itself());
    const auto said = bench.library.said();
    REQUIRE(said.size() > 5);
    CHECK(said[0] == "address 100.1.1.1");
    CHECK(said[1] == "file " + granted.model.substr(granted.model.size() - 12));
    CHECK(bench.library.heard("command sample_rate = 1000"));
    CHECK(said.back() == "message DISPLAY_COORDS 0 0 1919 1079");
}

TEST_CASE("what an EyeLink's host has otherwise than it was told is said", "[unit]") {
    DriverBench bench;
    // It takes both commands without a word, and keeps what it had.
    bench.library.tell("screen_pixel_coords", "0.00, 0.00, 1023.00, 767.00");
    bench.library.tell("file_sample_data", "LEFT,RIGHT,GAZE,AREA");
    EyelinkDriver driver(bench.settings, bench.clock);
    const std::string model = driver.connect(bench.wish).model;
    CHECK_THAT(model,
               Catch::Contains("its host has screen_pixel_coords = 0.00, 0.00, 1023.00, 767.00 where 0 0 "
                               "1919 1079 was asked for") &&
                   Catch::Contains("its host has file_sample_data = LEFT,RIGHT,GAZE,AREA"));
    CHECK_THAT(model, !Catch::Contains("sample_rate"));
}

TEST_CASE("what keeps an EyeLink from being set up is told at once", "[unit]") {
    DriverBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    bench.library.set("connection", -201);
    CHECK_THROWS_WITH(driver.connect(bench.wish), Catch::Contains("No EyeLink answers at 100.1.1.1"));
    bench.library.set("connection", 0);
    bench.library.set("version", 2);
    CHECK_THROWS_WITH(driver.connect(bench.wish), Catch::Contains("EyeLink 1000 and later"));
    bench.library.set("version", 3);
    bench.library.set("open_file", -1);
    CHECK_THROWS_WITH(driver.connect(bench.wish), Catch::Contains("data file B1"));
    bench.library.set("open_file", 0);
    bench.library.tell("refused", "screen_distance");
    CHECK_THROWS_WITH(driver.connect(bench.wish),
                      Catch::Contains("screen_distance = 1750") && Catch::Contains("VALUE OUT OF RANGE"));
    bench.library.tell("refused", "button_function"); // not needed
    CHECK_NOTHROW(driver.connect(bench.wish));
    bench.settings.address = "host";
    EyelinkDriver elsewhere(bench.settings, bench.clock);
    CHECK_THROWS_AS(elsewhere.connect(bench.wish), InputError);
}

TEST_CASE("an EyeLink at 2000 Hz delivers each sample once, half milliseconds apart", "[unit]") {
    DriverBench bench;
    bench.library.set("rate", 2000);
    bench.wish.rate_hz = 2000.0;
    ThreadedTracker tracker(std::make_unique<EyelinkDriver>(bench.settings, bench.clock), bench.clock,
                            bench.wish);
    CHECK(tracker.description().sample_rate_hz == 2000.0);
    tracker.start_recording();
    std::vector<GazeSample> samples;
    std::array<TrackerItem, 64> items;
    const SessionTime until = bench.clock.now() + 600ms;
    while (bench.clock.now() < until) {
        bench.clock.wait_until(bench.clock.now() + 8ms);
        for (std::size_t count; (count = tracker.poll(items)) > 0;)
            for (std::size_t i = 0; i < count; ++i)
                if (const auto* sample = std::get_if<GazeSample>(&items[i]))
                    samples.push_back(*sample);
    }
    CHECK(tracker.recording_state() == RecordingState::running);
    tracker.stop_recording();
    CHECK(samples.size() > 600);
    check_unbroken(samples, 500);
    REQUIRE(samples.size() > 500);
    CHECK_FALSE(samples[499].gaze); // the stand-in loses its pupil there
    CHECK(bench.library.heard("start 1111"));
    CHECK(bench.library.heard("stop"));
}

TEST_CASE("both eyes of an EyeLink are two samples of one time, the left one's first", "[unit]") {
    DriverBench bench;
    bench.library.set("eyes", 2);
    bench.wish.both_eyes = true;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    driver.start();
    bench.read(driver, 150ms);
    driver.stop();
    const auto samples = bench.kept.all<GazeSample>();
    REQUIRE(samples.size() > 100);
    REQUIRE(samples.size() % 2 == 0);
    std::vector<GazeSample> left;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < samples.size(); i += 2) {
        wrong += samples[i].eye != Eye::left || samples[i + 1].eye != Eye::right ||
                 samples[i].sampled_at != samples[i + 1].sampled_at;
        left.push_back(samples[i]);
    }
    CHECK(wrong == 0);
    check_unbroken(left, 1000);
}

TEST_CASE("a full queue of an EyeLink's link is a gap of as many samples", "[unit]") {
    DriverBench bench;
    bench.library.set("overflow_at", 40);
    bench.library.set("overflow_samples", 25);
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    driver.start();
    bench.read(driver, 120ms);
    const auto gaps = bench.kept.all<TrackerGap>();
    REQUIRE(gaps.size() == 1);
    CHECK(gaps[0].lost_samples == 25);
    CHECK(gaps[0].after == bench.kept.all<GazeSample>()[39].sampled_at);
}

TEST_CASE("what the operator of an EyeLink's host does becomes of the trial", "[unit]") {
    const auto [code, state] = GENERATE(table<int, RecordingState>({{1, RecordingState::repeat},
                                                                    {2, RecordingState::skip},
                                                                    {3, RecordingState::abort},
                                                                    {-1, RecordingState::lost}}));
    DriverBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    driver.start();
    CHECK(bench.read(driver, 20ms) == RecordingState::running);
    bench.library.set("host", code);
    CHECK(bench.read(driver, 20ms) == state);
    driver.stop();
    bench.library.set("start", code); // and when it is so at the beginning
    if (code < 0) {
        CHECK_THROWS_AS(driver.start(), DeviceError);
    } else {
        driver.start();
        CHECK(bench.read(driver, 20ms) == state);
    }
}

TEST_CASE("an EyeLink whose operator chose at the end of a recording is not lost", "[unit]") {
    DriverBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    driver.start();
    bench.library.set("exit", 2);
    bench.library.set("host", -1);
    CHECK(bench.read(driver, 20ms) == RecordingState::skip);
}

TEST_CASE("an EyeLink that falls silent or whose link breaks is lost, and can be had again", "[unit]") {
    DriverBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    driver.start();
    const char* fault = GENERATE("broken", "stalled");
    CHECK(bench.read(driver, 20ms) == RecordingState::running);
    bench.library.set(fault, 1);
    CHECK(bench.read(driver, 3s) == RecordingState::lost);
    driver.stop();
    bench.library.set(fault, 0);
    driver.connect(bench.wish);
    driver.start();
    CHECK(bench.read(driver, 20ms) == RecordingState::running);
    driver.stop();
    const TemporaryFolder folder;
    // What was recorded before the loss lies in a file of its own.
    CHECK(driver.finish(folder.path().string(), {}).size() == 2);
    CHECK(files_in(folder.path()).size() == 2);
    CHECK(opened_files(bench.library) == files_in(folder.path()));
}

TEST_CASE("an EyeLink that records otherwise than agreed is refused", "[unit]") {
    DriverBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    bench.library.set("eyes", 0);
    CHECK_THROWS_WITH(driver.start(), Catch::Contains("the left eye and not the right eye"));
    bench.library.set("eyes", 1);
    bench.library.set("rate", 500);
    CHECK_THROWS_WITH(driver.start(), Catch::Contains("500 Hz and not at 1000 Hz"));
    bench.library.set("rate", 1000);
    bench.library.set("block", 0);
    CHECK_THROWS_WITH(driver.start(), Catch::Contains("no samples"));
    bench.library.set("block", 1);
    CHECK_NOTHROW(driver.start());
}

TEST_CASE("an EyeLink's marks say how long ago they were, and come in no burst", "[unit]") {
    DriverBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    const SessionTime now = bench.clock.now();
    driver.send({now - 250ms, "ONSET 100% %s"});
    std::string said = bench.library.said().back();
    int ago = 0;
    char text[64]{};
    REQUIRE(std::sscanf(said.c_str(), "message %d %63[^\n]", &ago, text) == 2);
    CHECK(ago >= 250);
    CHECK(std::string(text) == "ONSET 100% %s"); // no format
    const SessionTime begun = bench.clock.now();
    for (int i = 0; i < 40; ++i)
        driver.send({bench.clock.now(), fmt::format("M{}", i)});
    CHECK(bench.clock.now() - begun >= 8ms);
    CHECK_THAT(bench.library.said().back(), Catch::EndsWith("M39"));
}

TEST_CASE("an EyeLink's clock is read between two readings of ours", "[unit]") {
    DriverBench bench(GENERATE(std::string(OVERT_STAND_IN_EYELINK), std::string(OVERT_STAND_IN_EYELINK_OLD)));
    EyelinkDriver driver(bench.settings, bench.clock);
    CHECK_FALSE(driver.read_clocks());
    driver.connect(bench.wish);
    const auto first = driver.read_clocks();
    bench.clock.wait_until(bench.clock.now() + 50ms);
    const auto second = driver.read_clocks();
    REQUIRE(first);
    REQUIRE(second);
    CHECK(first->before < first->after);
    // Both clocks go at the same rate here: what went by on one lies within what went by on the other.
    const SessionDuration went_by = second->other - first->other;
    CHECK(went_by >= second->before - first->after);
    CHECK(went_by <= second->after - first->before);
    bench.library.set("mute", 1);
    bench.library.set("broken", bench.library.path == OVERT_STAND_IN_EYELINK ? 1 : 0);
    CHECK_FALSE(driver.read_clocks());
}

TEST_CASE("an EyeLink's file is fetched with progress, and its size is checked", "[unit]") {
    DriverBench bench;
    const TemporaryFolder folder;
    std::vector<std::int64_t> done;
    const auto progress = [&](std::int64_t part, std::int64_t whole) {
        CHECK(whole == 100'000);
        done.push_back(part);
    };
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    driver.start(); // an abort: nobody has stopped it
    const auto said = driver.finish(folder.path().string(), progress);
    REQUIRE(said.size() == 1);
    REQUIRE(opened_files(bench.library).size() == 1);
    const std::string name = *opened_files(bench.library).begin();
    CHECK_THAT(said[0], Catch::Contains(name + ".edf") && Catch::Contains("100000 bytes"));
    CHECK(done.size() == 10);
    CHECK(done.back() == 100'000);
    CHECK(read_whole_file(folder.path() / (name + ".edf")).size() == 100'000);
    CHECK(bench.library.heard("stop"));
    CHECK(bench.library.heard("file closed"));
    CHECK(bench.library.said().back() == "closed");
    CHECK(driver.finish(folder.path().string(), progress).empty()); // only once
}

TEST_CASE("an EyeLink's file replaces none that is there", "[unit]") {
    DriverBench bench;
    const TemporaryFolder folder;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    const std::string name = *opened_files(bench.library).begin();
    folder.file(name + ".edf", "of another sitting");
    const auto said = driver.finish(folder.path().string(), {});
    CHECK_THAT(said.at(0), Catch::Contains(name + "-2.edf, 100000 bytes"));
    CHECK(read_whole_file(folder.path() / (name + ".edf")) == "of another sitting");
    CHECK(read_whole_file(folder.path() / (name + "-2.edf")).size() == 100'000);
    CHECK(files_in(folder.path()).size() == 2);
}

TEST_CASE("an EyeLink's file that does not arrive whole stays on the host, and it is said", "[unit]") {
    DriverBench bench;
    const TemporaryFolder folder;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    SECTION("broken off") {
        bench.library.set("transfer", -110);
        CHECK_THAT(driver.finish(folder.path().string(), {}).at(0),
                   Catch::Contains(".EDF could not be fetched: it was broken off") &&
                       Catch::Contains(".edf.part"));
    }
    SECTION("too short") {
        bench.library.set("sent_bytes", 99'999);
        CHECK_THAT(driver.finish(folder.path().string(), {}).at(0),
                   Catch::Contains("99999 bytes are there and 100000 were sent"));
    }
    SECTION("no folder to write into") {
        CHECK_THAT(driver.finish((folder.path() / "none").string(), {}).at(0),
                   Catch::Contains("cannot be opened"));
    }
    SECTION("the host does not come back") {
        bench.library.set("broken", 1);
        CHECK_THAT(driver.finish(folder.path().string(), {}).at(0),
                   Catch::Contains("stays on its host, as B1"));
    }
}

TEST_CASE("an EyeLink's file that stayed on its host is offered at the next start, and can be fetched",
          "[unit]") {
    DriverBench bench;
    const TemporaryFolder folder, notes;
    bench.settings.notes = notes.path();
    std::string name;
    {
        EyelinkDriver driver(bench.settings, bench.clock);
        driver.connect(bench.wish);
        name = *opened_files(bench.library).begin();
        bench.library.set("transfer", -110);
        const auto said = driver.finish(folder.path().string(), {});
        REQUIRE(said.size() == 2);
        CHECK_THAT(said[1], Catch::Contains("overt tracker fetch"));
    }
    const LeftOnHost left{name, bench.settings.address, folder.path()};
    CHECK(read_left_on_host(notes.path()) == std::vector<LeftOnHost>{left});
    {
        EyelinkDriver next(bench.settings, bench.clock);
        CHECK_THAT(next.connect(bench.wish).model,
                   Catch::Contains("still on its host") &&
                       Catch::Contains(name + ".EDF for " + folder.path().string()));
        bench.settings.address = "100.1.1.7"; // another tracker's host knows nothing of it
        CHECK_THAT(EyelinkDriver(bench.settings, bench.clock).connect(bench.wish).model,
                   !Catch::Contains("still on its host"));
        bench.settings.address = left.host;
    }
    EyelinkDriver fetching(bench.settings, bench.clock);
    CHECK(fetching.fetch_left_files({}).size() == 2); // it fails again, and stays noted
    CHECK(read_left_on_host(notes.path()).size() == 1);
    bench.library.set("transfer", 100'000);
    const auto said = fetching.fetch_left_files({});
    REQUIRE(said.size() == 1);
    CHECK_THAT(said[0], Catch::Contains(name + ".edf, 100000 bytes"));
    CHECK(read_whole_file(folder.path() / (name + ".edf")).size() == 100'000);
    CHECK(read_left_on_host(notes.path()).empty());
    CHECK(fetching.fetch_left_files({}).empty());
}

TEST_CASE("an EyeLink's file is noted as left on its host until it has come", "[unit]") {
    DriverBench bench;
    const TemporaryFolder folder, notes;
    bench.settings.notes = notes.path();
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    CHECK(read_left_on_host(notes.path()).empty());
    std::set<std::size_t> noted; // a library that crashed now would leave so many
    driver.finish(folder.path().string(),
                  [&](std::int64_t, std::int64_t) { noted.insert(read_left_on_host(notes.path()).size()); });
    CHECK(noted == std::set<std::size_t>{1});
    CHECK(read_left_on_host(notes.path()).empty());

    // From when it is known where it belongs: a program that is killed in a trial leaves the note.
    driver.connect(bench.wish);
    driver.belongs_in(folder.path().string());
    const std::vector<LeftOnHost> first = read_left_on_host(notes.path());
    REQUIRE(first.size() == 1);
    CHECK(first[0].folder == folder.path());
    CHECK(opened_files(bench.library).contains(first[0].name));
    // After a connection that was lost there is a second file, and neither is left by another session.
    CHECK_THAT(driver.connect(bench.wish).model, !Catch::Contains("still on its host"));
    CHECK(read_left_on_host(notes.path()).size() == 2);
    CHECK(driver.finish(folder.path().string(), {}).size() == 2);
    CHECK(read_left_on_host(notes.path()).empty());
    // The next session's folder is another one, and not told yet.
    driver.connect(bench.wish);
    CHECK(read_left_on_host(notes.path()).empty());
}

TEST_CASE("an EyeLink without a tracker records nothing and waits for nothing", "[unit]") {
    DriverBench bench;
    bench.settings.is_dummy = true;
    EyelinkDriver driver(bench.settings, bench.clock);
    CHECK_FALSE(driver.calibrates_itself());
    CHECK(driver.connect(bench.wish).name == "eyelink without a tracker");
    DiarySetupScreen setup_screen(bench.clock);
    CHECK(driver.set_up(setup_screen).kind == SetupOutcome::Kind::done);
    driver.start();
    CHECK(bench.read(driver, 10ms) == RecordingState::running);
    CHECK(bench.kept.items.empty());
    driver.stop();
    CHECK(driver.finish("/nowhere", {}).empty());
}

TEST_CASE("of an EyeLink's file nothing is told any more once its transfer is over", "[unit]") {
    DriverBench bench;
    const TemporaryFolder folder;
    int told = 0;
    const EyeTracker::FileProgress progress = [&](std::int64_t, std::int64_t) { ++told; };
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    CHECK(driver.finish(folder.path().string(), progress).size() == 1);
    CHECK(told == 10);
    bench.library.ask("stand_in_progress");
    CHECK(told == 10);
}

TEST_CASE("files of earlier sessions are told of, of the same host, in whatever folder this one's are",
          "[unit]") {
    DriverBench bench;
    const TemporaryFolder folder, notes;
    bench.settings.notes = notes.path();
    const std::string host = bench.settings.address;
    notes.file("eyelink-files.txt", "EARLIER1\t" + host + "\t" + folder.path().string() +
                                        "\nno tab\none\ttab\nEARLIER2\t" + host +
                                        "\t/else\twhere\nEARLIER3\t10.0.0.9\t/elsewhere\n");
    const std::vector<LeftOnHost> left = read_left_on_host(notes.path());
    REQUIRE(left.size() == 3);
    CHECK(left[0] == LeftOnHost{"EARLIER1", host, folder.path()});
    CHECK(left[1] == LeftOnHost{"EARLIER2", host, "/else\twhere"});
    EyelinkDriver driver(bench.settings, bench.clock);
    const auto check_told = [&](const std::string& model) {
        CHECK_THAT(model, Catch::Contains("; still on its host, and brought by overt tracker fetch: "
                                          "EARLIER1.EDF for " +
                                          folder.path().string() + " EARLIER2.EDF for /else\twhere"));
        CHECK_THAT(model, !Catch::Contains("EARLIER3"));
        CHECK_THAT(model, Catch::EndsWith("/else\twhere"));
    };
    check_told(driver.connect(bench.wish).model);
    driver.belongs_in(folder.path().string());
    check_told(driver.connect(bench.wish).model); // and not its own, in the same folder
    CHECK(read_left_on_host(notes.path()).size() == 5);
}

TEST_CASE("where the note of an EyeLink's files cannot be read or written, that is said beside the file",
          "[unit]") {
    for (const bool comes : {true, false}) {
        DriverBench bench;
        const TemporaryFolder folder, notes;
        bench.settings.notes = notes.path();
        EyelinkDriver driver(bench.settings, bench.clock);
        driver.connect(bench.wish);
        std::filesystem::create_directories(notes.path() / "eyelink-files.txt"); // a folder in its place
        bench.library.set("transfer", comes ? 100'000 : -110);
        const std::vector<std::string> said = driver.finish(folder.path().string(), {});
        REQUIRE(said.size() == 2);
        CHECK_THAT(said[0], Catch::Contains(comes ? "100000 bytes" : "could not be fetched"));
        CHECK_THAT(said[1], Catch::Contains("eyelink-files.txt"));
    }
}
