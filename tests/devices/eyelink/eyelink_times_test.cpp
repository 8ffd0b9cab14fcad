// When the EyeLink's driver does what it does, by a clock that goes only where it is waited for.
#include "devices/eyelink/eyelink_driver.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <thread>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/eyelink/eyelink_bench.h"
#include "tests/devices/tracker/row_parts.h"
#include "tests/support/counted_clock.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

struct TimedBench {
    explicit TimedBench(std::string file = OVERT_STAND_IN_EYELINK, bool tells_modes = true)
        : library(std::move(file)) {
        settings.library = library.path;
        if (tells_modes)
            library.tell("read_mode_list", "1000B 2000");
        wish.file_name = "ob";
    }
    StandIn library;
    CountedClock clock;
    EyelinkSettings settings;
    TrackerWish wish;
    KeptItems kept;
};

/// What is said of a mark, without "message ".
std::string message_of(const StandIn& library) { return library.said().back().substr(8); }

} // namespace

TEST_CASE("an EyeLink's host has 50 ms to be idle, its last samples 100 ms and its file 500 ms", "[unit]") {
    TimedBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    REQUIRE_FALSE(bench.clock.waits.empty());
    CHECK(bench.clock.waits.front() == 50ms);
    CHECK(std::ranges::count(bench.clock.waits, SessionDuration(50ms)) == 1);
    CHECK(std::ranges::all_of(bench.clock.waits, [](auto wait) { return wait == 1ms || wait == 50ms; }));
    bench.clock.waits.clear();
    CHECK(bench.library.ask("stand_in_offline") == 1);
    driver.start();
    CHECK(bench.library.ask("stand_in_offline") == 2);
    CHECK(bench.clock.waits == std::vector<SessionDuration>{50ms});
    bench.clock.waits.clear();
    driver.stop();
    CHECK(bench.clock.waits == std::vector<SessionDuration>{100ms});
    driver.stop(); // nothing is left to stop
    CHECK(bench.clock.waits.size() == 1);
    const auto said = bench.library.said();
    CHECK(std::ranges::count(said, "stop") == 1);
    CHECK(bench.library.ask("stand_in_offline") == 3);
    driver.drift_check({1, 1});
    CHECK(bench.library.ask("stand_in_offline") == 4);
    bench.clock.waits.clear();
    const TemporaryFolder folder;
    CHECK(driver.finish(folder.path().string(), {}).size() == 1);
    CHECK(bench.clock.waits == std::vector<SessionDuration>{500ms});
    CHECK(bench.library.ask("stand_in_offline") == 5);
}

TEST_CASE(
    "a host that does not answer is asked for half a second, and one that is silent of its settings once",
    "[unit]") {
    for (const bool tells_modes : {true, false}) {
        TimedBench bench(OVERT_STAND_IN_EYELINK, tells_modes);
        EyelinkDriver driver(bench.settings, bench.clock);
        const SessionTime before = bench.clock.time;
        bench.library.tell("screen_pixel_coords", ""); // tells nothing of its settings
        driver.connect(bench.wish);
        // To be idle; what it answers comes with the third reading.
        CHECK(bench.clock.time - before == 50ms + (tells_modes ? 2ms : 500ms) + 2ms);
    }
}

TEST_CASE("an EyeLink is lost when it is silent for more than a second, and read until the deadline",
          "[unit]") {
    TimedBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    driver.start();
    bench.library.set("stalled", 1);
    const SessionTime began = bench.clock.time;
    bench.clock.waits.clear();
    CHECK(driver.read(bench.kept, began + 2500us) == RecordingState::running);
    CHECK(bench.clock.time == began + 2500us);
    CHECK(bench.clock.waits == std::vector<SessionDuration>{1ms, 1ms, 500us});
    CHECK(driver.read(bench.kept, began + 1s) == RecordingState::running);
    CHECK(bench.clock.time == began + 1s);
    CHECK(driver.read(bench.kept, began + 2s) == RecordingState::lost);
    CHECK(bench.clock.time == began + 1001ms); // more than a second
    // What comes is given at once.
    bench.library.set("stalled", 0);
    driver.stop();
    driver.start();
    for (int tries = 0; tries < 1000 && bench.kept.items.empty(); ++tries) {
        const SessionTime asked = bench.clock.time;
        CHECK(driver.read(bench.kept, asked + (bench.kept.items.empty() ? 0ms : 10ms)) ==
              RecordingState::running);
        CHECK(bench.clock.time == asked);
        std::this_thread::sleep_for(1ms);
    }
    CHECK_FALSE(bench.kept.items.empty());
}

TEST_CASE("an EyeLink's marks carry their age, and the fourth of a burst waits for a millisecond", "[unit]") {
    TimedBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.send({bench.clock.time, "before there is a connection"});
    CHECK(bench.library.said().empty());
    driver.connect(bench.wish);
    bench.clock.time += 5s;
    bench.clock.waits.clear();
    const auto sent = [&](SessionDuration age, std::string text) {
        driver.send({bench.clock.time - age, std::move(text)});
        return message_of(bench.library);
    };
    CHECK(sent(250ms, "ONSET") == "250 ONSET");
    CHECK(sent(-3ms, "EARLY") == "-3 EARLY");
    CHECK(sent(400us, "NOW") == "NOW");
    CHECK(sent(600us, "SOON") == "1 SOON");
    CHECK(bench.clock.waits.empty());
    CHECK(sent(0ms, "FIFTH") == "1 FIFTH"); // it had to wait, and says so
    CHECK(bench.clock.waits == std::vector<SessionDuration>{1ms});
    for (int i = 0; i < 3; ++i)
        CHECK(sent(0ms, "M") == "M");
    CHECK(sent(0ms, "M") == "1 M");
    // After exactly a millisecond another burst begins.
    bench.clock.waits.clear();
    CHECK(sent(0ms, "M") == "M");
    CHECK(sent(0ms, "M") == "M");
    bench.clock.time += 1ms;
    for (int i = 0; i < 4; ++i)
        CHECK(sent(0ms, "M") == "M");
    CHECK(bench.clock.waits.empty());
    CHECK(sent(0ms, "12") == "1 12");
    CHECK(sent(0ms, "12") == "0 12"); // no time is taken for its text
    // A text that is too long is cut where the library has room for it.
    CHECK(sent(0ms, std::string(200, 'x')) == std::string(127, 'x'));
}

TEST_CASE("readings of an EyeLink's clock are as wide as it cannot be known", "[unit]") {
    TimedBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    const SessionTime before = bench.clock.time;
    const auto pair = driver.read_clocks();
    REQUIRE(pair);
    CHECK(pair->before == before - 250us);
    CHECK(pair->after == before + 250us);

    for (const double us : {1.0, 1e17}) {
        bench.library.set("microseconds", us);
        REQUIRE(driver.read_clocks());
        CHECK(driver.read_clocks()->other == tracker_time(static_cast<std::int64_t>(us)));
    }
    for (const double us : {0.0, -1.0, 1.1e17, std::nan(""), HUGE_VAL}) {
        bench.library.set("microseconds", us);
        CHECK_FALSE(driver.read_clocks());
    }

    TimedBench older(OVERT_STAND_IN_EYELINK_OLD);
    EyelinkDriver exchanging(older.settings, older.clock);
    exchanging.connect(older.wish);
    const SessionTime asked = older.clock.time;
    const auto exchanged = exchanging.read_clocks();
    REQUIRE(exchanged);
    CHECK(exchanged->before == asked - 500us);
    CHECK(exchanged->after == asked + 500us);
    CHECK(exchanged->other.time_since_epoch().count() % 1000 == 500);
    // One that does not answer for more than 10 ms tells nothing.
    older.library.set("mute", 1);
    older.clock.reading = 1ms;
    const SessionTime began = older.clock.time;
    CHECK_FALSE(exchanging.read_clocks());
    CHECK(older.clock.time - began == 12ms); // read at 1 ms for the first time, and until 11 ms later
    older.clock.reading = {};
    older.library.set("broken", 1);
    older.library.set("mute", 0);
    CHECK_FALSE(exchanging.read_clocks());
}

TEST_CASE("a check of drift ends with its patience, and asks at the nearest pixel", "[unit]") {
    TimedBench bench;
    bench.settings.drift_patience = 3s;
    EyelinkDriver driver(bench.settings, bench.clock);
    driver.connect(bench.wish);
    bench.library.set("drift_waits", 1);
    bench.clock.reading = 1ms;
    const SessionTime began = bench.clock.time;
    CHECK(driver.drift_check({100.5, -0.4})->kind == DriftOutcome::Kind::no_eye);
    CHECK(bench.library.heard("drift 101 0 0 0"));
    CHECK(bench.clock.time - began >= 3s + 50ms);
    CHECK(bench.clock.time - began <= 3s + 60ms);
    bench.clock.reading = {};
    bench.library.set("drift_waits", 0);
    bench.library.set("drift", 5); // whatever else it says
    CHECK(driver.drift_check({1, 1})->kind == DriftOutcome::Kind::no_eye);
}

TEST_CASE("an EyeLink's refusals say the command, the number and what the host said", "[unit]") {
    TimedBench bench;
    EyelinkDriver driver(bench.settings, bench.clock);
    bench.library.tell("refused", "sample_rate");
    CHECK_THROWS_WITH(driver.connect(bench.wish),
                      "The EyeLink refuses the command \"sample_rate = 1000\" (error -3: "
                      "VALUE OUT OF RANGE).");
    bench.library.tell("refused", "no such command");
    bench.library.set("open_file", -2);
    CHECK_THROWS_WITH(driver.connect(bench.wish), Catch::Contains("EDF (error -2): is its disk full?"));
    bench.library.set("open_file", 0);
    bench.library.set("broken", 1);
    CHECK_THROWS_WITH(driver.connect(bench.wish),
                      "The EyeLink at 100.1.1.1 was reached, but its link is not open (state 0).");
    CHECK(bench.library.said().back() == "closed");
    bench.library.set("broken", 0);
    bench.library.set("version", 2);
    CHECK_THROWS_WITH(driver.connect(bench.wish),
                      "The tracker calls itself \"EYELINK CL 5.12\" (kind 2): overt knows "
                      "the EyeLink 1000 and later.");
    bench.library.set("version", 3);
    driver.connect(bench.wish);
    bench.library.set("start", -9);
    CHECK_THROWS_WITH(driver.start(), "The EyeLink does not begin to record (error -9). Look at its host.");
    bench.library.set("start", 0);
    bench.library.set("eyes", -1);
    CHECK_THROWS_WITH(driver.start(), Catch::Contains("it says that it measures no eye"));
    bench.library.set("eyes", 2);
    CHECK_THROWS_WITH(driver.start(),
                      Catch::Contains("measures both eyes and not the right eye, as was agreed"));
    bench.library.set("eyes", 0);
    CHECK_THROWS_WITH(driver.start(), Catch::Contains("measures the left eye and not the right eye"));
    bench.wish.eye = Eye::left;
    driver.connect(bench.wish);
    CHECK_NOTHROW(driver.start());
}

TEST_CASE("an EyeLink's library is called in its order, from the connection to its end", "[unit]") {
    TimedBench bench;
    bench.library.set("trace", 1);
    bench.wish.rate_hz = 1000.0;
    auto take = [&, from = std::size_t{0}]() mutable {
        std::vector<std::string> said = bench.library.said();
        std::string all;
        for (const std::string& each : std::span(said).subspan(from))
            if (!each.starts_with("read ") || each == "read read_mode_list")
                all += (all.empty() ? "" : ", ") + each;
        from = said.size();
        return all;
    };
    {
        EyelinkDriver driver(bench.settings, bench.clock);
        take();
        const TrackerDescription told = driver.connect(bench.wish);
        const std::string file = told.model.substr(told.model.size() - 12);
        const std::string said = take();
        CHECK_THAT(said, Catch::StartsWith("address 100.1.1.1, connect 0, file " + file +
                                           ", command add_file_preamble_text 'Recorded by overt', offline, "
                                           "read read_mode_list, command ") &&
                             Catch::EndsWith("message DISPLAY_COORDS 0 0 1919 1079"));
        driver.start();
        CHECK(take() == "offline, reset 1, start 1111, wait 100 1 0");
        driver.stop();
        CHECK(take() == "stop, offline");
        CHECK_FALSE(driver.drift_check({10.0, 20.0})); // it says nothing of it
        CHECK(take() == "offline, drift 10 20 0 0");
        driver.start();
        take();
        // Connected anew while it records: what was open is closed, and another file is opened.
        driver.connect(bench.wish);
        CHECK_THAT(take(), Catch::StartsWith("closed, address 100.1.1.1, connect 0, file "));
        driver.start();
        take();
    }
    CHECK(take() == "stop, offline, closed"); // nobody has stopped it
    {
        EyelinkDriver driver(bench.settings, bench.clock);
        driver.connect(bench.wish);
        driver.start();
        driver.connect(bench.wish);
        take();
    }
    CHECK(take() == "closed"); // after the new connection nothing is recorded
    { EyelinkDriver never(bench.settings, bench.clock); }
    CHECK(take().empty());
    // Without a tracker the library simulates one, of which nothing is asked back.
    bench.settings.is_dummy = true;
    {
        EyelinkDriver dummy(bench.settings, bench.clock);
        CHECK(dummy.connect(bench.wish).name == "eyelink without a tracker");
        CHECK_THAT(take(), Catch::Contains("connect 1") && !Catch::Contains("closed"));
        dummy.start();
        dummy.stop();
        CHECK(dummy.drift_check({1.0, 1.0})->kind == DriftOutcome::Kind::no_eye);
        CHECK_FALSE(dummy.read_clocks());
        CHECK(dummy.read(bench.kept, bench.clock.time + 7ms) == RecordingState::running);
        CHECK(bench.clock.waits.back() == 7ms);
        CHECK(dummy.finish("", {}).empty());
        CHECK(take() == "closed");
    }
    CHECK(take().empty());
}

TEST_CASE("a host whose variables cannot be asked for is taken as it is, at once", "[unit]") {
    TimedBench bench;
    bench.library.set("unreadable", 1);
    bench.library.tell("screen_pixel_coords", "0 0 1 1");
    EyelinkDriver driver(bench.settings, bench.clock);
    const SessionTime before = bench.clock.time;
    CHECK_THAT(driver.connect(bench.wish).model, !Catch::Contains("its host has"));
    CHECK(bench.clock.time - before == 50ms);
}

TEST_CASE("the row of the EyeLink takes address, targets and notes from the protocol", "[unit]") {
    StandIn library;
    setenv("OVERT_EYELINK_LIBRARY", library.path.c_str(), 1);
    const TemporaryFolder notes;
    RowParts parts;
    constexpr TrackerKind eyelink = kind_called<TrackerKind>("eyelink");
    CHECK(parts.driver<eyelink>()->connect({}).name == "eyelink");
    CHECK(library.heard("address 100.1.1.1"));
    CHECK(library.heard("command calibration_type = HV" + std::to_string(parts.protocol.calibration.points)));
    parts.protocol.tracker.address = "10.0.0.9";
    parts.protocol.calibration.points = 13;
    parts.notes = notes.path();
    {
        const auto driver = parts.driver<eyelink>();
        driver->connect({});
        CHECK(library.heard("address 10.0.0.9"));
        CHECK(library.heard("command calibration_type = HV13"));
        driver->belongs_in("/somewhere");
    }
    CHECK_FALSE(std::filesystem::is_empty(notes.path()));
    parts.protocol.tracker.address = "dummy";
    CHECK(parts.driver<eyelink>()->connect({}).name == "eyelink without a tracker");
    CHECK(tracker_device_of<eyelink>().look_for() == "its library is there");
    unsetenv("OVERT_EYELINK_LIBRARY");
}

TEST_CASE("of a refusal the host's word is told, however short, or none", "[unit]") {
    for (const auto& [word, end] : {std::pair("", "(error -3)."), {"X", "(error -3: X)."}}) {
        TimedBench bench;
        bench.library.tell("last_message", word);
        bench.library.tell("refused", "sample_rate");
        EyelinkDriver driver(bench.settings, bench.clock);
        CHECK_THROWS_WITH(driver.connect(bench.wish), Catch::EndsWith(end));
    }
}
