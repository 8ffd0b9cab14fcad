#include <tuple>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/devices/display_box/box_bench.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

TEST_CASE("status samples arrive whole, in order, with the box's time", "[unit]") {
    Bench bench;
    bench.box.clock_zero = SessionTime(-5s);
    auto display = bench.open();
    display.start_status();
    std::array<ArrivedStatus, 64> samples;
    std::uint64_t last = 0, count = 0;
    for (int refresh = 0; refresh < 240; ++refresh) {
        bench.clock.wait_until(bench.clock.now() + 8333us);
        for (std::size_t n = samples.size(); n == samples.size();) {
            n = display.poll_status(samples);
            for (std::size_t i = 0; i < n; ++i) {
                const StatusSample& sample = samples[i].sample;
                CHECK((last == 0 || sample.number == last + 1));
                CHECK(to_seconds(sample.at) < bench.box.box_s(samples[i].read_at));
                CHECK((sample.digital.all() && sample.infrared.all() && !sample.trigger));
                CHECK(sample.analogue_v[3] == -0.0125f);
                last = sample.number;
                ++count;
            }
        }
    }
    CHECK(count > 2700);
    CHECK(display.lost_samples() == 0);
    CHECK(display.video_rate_hz() == 120.0); // asked while the stream runs
    display.stop_status();
    CHECK(display.poll_status(samples) == 0);
    CHECK_FALSE(bench.box.model.streaming);
}

TEST_CASE("a status line that is cut or has another number of fields is no sample", "[unit]") {
    BitsBoxModel model;
    const std::string line = model.status_line(1.234567);
    const std::string whole = line.substr(0, line.size() - 1);
    const auto sample = parse_status_line(whole);
    REQUIRE(sample);
    CHECK(sample->number == 1);
    CHECK(sample->at == BoxTime(1234567us));
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK_FALSE(parse_status_line(whole.substr(0, length)));
    CHECK_FALSE(parse_status_line(whole + "0;"));
    CHECK(parse_status_line("#sample;99;0.12" + whole)->number == 1);
}

TEST_CASE("a press is a change to 0 of an input and to 1 of the trigger, between two samples' times",
          "[unit]") {
    StatusSample sample;
    sample.digital.set();
    sample.infrared.set();
    sample.infrared[5] = false; // held down from before
    BoxEdgeDetector edges(0.5f);
    CHECK(edges.feed(sample).empty());
    sample.at = BoxTime(700us);
    CHECK(edges.feed(sample).empty());
    sample.at = BoxTime(1400us);
    sample.trigger = true;
    sample.digital[9] = false;
    sample.infrared[5] = true;
    sample.analogue_v[2] = 0.75f;
    const auto events = edges.feed(sample);
    REQUIRE(events.size() == 4);
    CHECK((events[0].input == BoxInput{BoxInput::Kind::trigger, 0} && events[0].active));
    CHECK((events[1].input == BoxInput{BoxInput::Kind::digital, 9} && events[1].active));
    CHECK((events[2].input == BoxInput{BoxInput::Kind::infrared, 5} && !events[2].active));
    CHECK((events[3].input == BoxInput{BoxInput::Kind::analogue, 2} && events[3].analogue_v == 0.75f));
    for (const BoxEvent& event : events) {
        CHECK(event.at == BoxTime(1400us));
        CHECK(event.not_before == BoxTime(700us));
    }
    sample.analogue_v[2] = 1.0f; // less than the threshold from the last event
    CHECK(edges.feed(sample).empty());
    sample.analogue_v[2] = 1.3f;
    CHECK(edges.feed(sample).size() == 1);
}

TEST_CASE("samples that are missing or that nobody fetched are counted", "[unit]") {
    Bench bench;
    auto display = bench.open();
    display.start_status();
    std::array<ArrivedStatus, 8> samples;
    bench.clock.wait_until(bench.clock.now() + 20ms);
    display.poll_status(samples);
    bench.box.model.next_sample += 5;
    bench.clock.wait_until(bench.clock.now() + 40ms);
    while (display.poll_status(samples) == samples.size()) {
    }
    CHECK(display.lost_samples() == 5);
    // A number that comes again, or is lower than the last, says nothing of samples that are lost.
    for (const std::uint64_t back : {1u, 10u}) {
        bench.box.model.next_sample -= back;
        bench.clock.wait_until(bench.clock.now() + 40ms);
        while (display.poll_status(samples) == samples.size()) {
        }
        CHECK(display.lost_samples() == 5);
    }
    bench.box.model.next_sample += 1;
    bench.clock.wait_until(bench.clock.now() + 40ms);
    while (display.poll_status(samples) == samples.size()) {
    }
    CHECK(display.lost_samples() == 6);
}

TEST_CASE("the box's clock is related to the session's to within the stated uncertainty", "[unit]") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        RandomStream random(seed, "display clock test");
        Bench bench;
        bench.box.clock_zero = SessionTime(from_seconds(random.uniform(-5000.0, 0.0)));
        bench.box.drift_ppm = random.uniform(-150.0, 150.0);
        bench.box.far.delay = SessionDuration(std::llround(random.uniform(0.2e6, 5e6)));
        auto display = bench.open();
        display.set_mode(BoxMode::mono_plus_plus);
        int shown = 0;
        const auto show_reset = [&] {
            bench.clock.wait_until(bench.clock.now() + 17ms);
            const SessionTime now = bench.clock.now();
            if (++shown > 2) // the first two come while the box is not ready yet
                bench.box.clock_zero = now - SessionDuration(std::llround(random.uniform(0.0, 1e5)));
            return ShownClockReset{now - 100us, now};
        };
        auto pairs = display.relate_clocks(show_reset);
        CHECK(shown == 3);
        for (int minute = 0; minute < 10; ++minute) {
            bench.clock.wait_until(bench.clock.now() + 1min);
            pairs.push_back(display.read_clocks());
        }
        const BoxClockMap map(pairs);
        CHECK(std::abs(map.drift_ppm() - bench.box.drift_ppm) <= map.drift_uncertainty_ppm());
        for (int i = 0; i < 50; ++i) {
            const SessionTime time = bench.box.clock_zero + from_seconds(random.uniform(0.0, 600.0));
            const MappedTime mapped =
                map.to_session(BoxTime(BoxClock::duration(std::llround(1e6 * bench.box.box_s(time)))));
            CHECK(std::chrono::abs(mapped.time - time) <= mapped.uncertainty);
            CHECK(mapped.uncertainty < 10ms);
        }
    }
}

TEST_CASE("a clock reset line that the box does not read, or much later than shown, is an error", "[unit]") {
    Bench bench;
    bench.box.clock_zero = SessionTime(-100s);
    auto display = bench.open();
    bool late = false;
    const auto show_reset = [&] {
        if (late)
            bench.box.clock_zero = bench.clock.now() + 50ms;
        return ShownClockReset{bench.clock.now(), bench.clock.now() + 8ms};
    };
    CHECK_THAT(message_of([&] { display.relate_clocks(show_reset); }), Contains("did not restart"));
    late = true;
    CHECK_THAT(message_of([&] { display.relate_clocks(show_reset); }), Contains("did not restart"));
}

TEST_CASE("a reading of the clocks holds also when the first status line is a leftover", "[unit]") {
    Bench bench;
    bench.box.clock_zero = SessionTime(-100s);
    auto display = bench.open();
    bool first = true;
    bench.box.mutate = [&](std::string line) {
        if (line.find("#sample;") == 0 && first) {
            first = false;
            return BitsBoxModel().status_line(12.0);
        }
        return line;
    };
    const BoxClockPair pair = display.read_clocks();
    CHECK(to_seconds(pair.other) >= bench.box.box_s(pair.before) - 1e-6);
    CHECK(to_seconds(pair.other) <= bench.box.box_s(pair.after) + 1e-6);
}

TEST_CASE("status fields that are switched off on the box are said to be the reason", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.mutate = [](const std::string& line) {
        return line.find("#sample;") == 0 ? line.substr(0, 40) + "\r" : line;
    };
    CHECK_THAT(message_of([&] { display.read_clocks(); }), Contains("config.xml") && Contains("#sample;"));
}

TEST_CASE("a status line's numbers are taken up to what can be, and refused beyond", "[unit]") {
    const auto line = [](const std::string& number, const std::string& time, const std::string& bits,
                         const std::string& volts) {
        std::string text = "#sample;" + number + ";" + time + ";" + bits + ";";
        StatusSample none;
        for (std::size_t i = 0; i < none.digital.size() + none.infrared.size(); ++i)
            text += "1;";
        for (std::size_t i = 0; i < none.analogue_v.size(); ++i)
            text += volts + ";";
        return parse_status_line(text);
    };
    const auto sample = line("18446744073709551615", "999999999.5", "1", "-999.5");
    REQUIRE(sample);
    CHECK(sample->number == 18446744073709551615u);
    CHECK(sample->at == BoxTime(999999999500000us));
    CHECK(sample->trigger);
    CHECK(sample->digital.all());
    CHECK(sample->infrared.all());
    for (const float volts : sample->analogue_v)
        CHECK(volts == -999.5f);
    CHECK(line("1", "0", "0", "1000"));
    CHECK_FALSE(line("1", "0", "0", "1000.5"));
    CHECK(line("1", "1000000000", "0", "0"));
    CHECK_FALSE(line("1", "1000000001", "0", "0"));
    CHECK_FALSE(line("1", "-1", "0", "0"));
    CHECK_FALSE(line("1", "0", "2", "0"));
    CHECK_FALSE(line("x", "0", "0", "0"));
    CHECK_FALSE(line("1", "", "0", "0"));
    // Each of the analogue inputs has edges, by its own threshold.
    BoxEdgeDetector volts(0.5f);
    StatusSample level = *line("1", "1", "0", "0.0");
    CHECK(volts.feed(level).empty());
    for (std::size_t i = 0; i < level.analogue_v.size(); ++i) {
        level.analogue_v[i] = 0.5f;
        const auto told = volts.feed(level);
        REQUIRE(told.size() == 1);
        CHECK(told[0].input == BoxInput{BoxInput::Kind::analogue, static_cast<std::uint8_t>(i)});
        CHECK(told[0].analogue_v == 0.5f);
    }
    // An edge detector tells no volts with edges that have none.
    BoxEdgeDetector edges;
    StatusSample before = *line("1", "1", "0", "0.5");
    CHECK(edges.feed(before).empty());
    StatusSample after = *line("2", "2", "1", "0.9");
    after.digital[0] = after.infrared[2] = false;
    const auto events = edges.feed(after);
    REQUIRE(events.size() == 3); // and none for volts without a threshold
    for (const BoxEvent& event : events) {
        CHECK(event.analogue_v == 0.0f);
        CHECK(event.active);
        CHECK(event.not_before == BoxTime(1s));
        CHECK(event.at == BoxTime(2s));
    }
}

TEST_CASE("a box's clock may have drifted by 200 ppm from the reset on, and no more", "[unit]") {
    for (const double drift_ppm : {-185.0, 0.0, 185.0, -300.0, 300.0}) {
        CAPTURE(drift_ppm);
        Bench bench;
        bench.box.drift_ppm = drift_ppm;
        bench.box.far.delay = 100us;
        auto display = bench.open();
        int resets = 0;
        const auto show_reset = [&] {
            bench.box.clock_zero = bench.clock.now();
            const ShownClockReset shown{bench.clock.now(), bench.clock.now()};
            bench.clock.wait_until(bench.clock.now() + 100s);
            ++resets;
            return shown;
        };
        if (std::abs(drift_ppm) < 200.0) {
            const auto pairs = display.relate_clocks(show_reset);
            CHECK(pairs.size() == 6); // the reset and five readings
            CHECK(pairs.front().other == BoxTime());
            CHECK(pairs.front().before == bench.box.clock_zero);
            CHECK(pairs.front().after == bench.box.clock_zero);
        } else {
            CHECK_THAT(message_of([&] { display.relate_clocks(show_reset); }), Contains("did not restart"));
        }
        CHECK(resets == 1); // after the first the time to settle is over
    }
}

TEST_CASE("of what a box says instead of an answer the end is told, and the lines that came last", "[unit]") {
    Bench bench;
    auto display = bench.open();
    const auto told_after = [&](const std::string& noise) {
        bench.box.far.answer = [noise](std::string_view) { return noise; };
        return message_of([&] { display.video_rate_hz(); });
    };
    CHECK_THAT(told_after("first\rsecond\r"), Contains("\"first\\x0asecond\""));
    // Of a line that is longer than 256 bytes its end.
    std::string digits;
    for (int i = 0; i < 100; ++i)
        digits += fmt::format("{:03};", i);
    CHECK_THAT(told_after(digits + "\r"), Contains("098;099;\"") && Contains("but \"…"));
    CHECK_THAT(told_after(digits + "\rlast\r"), Contains("098;099;\\x0alast\""));
    // More than 512 bytes: what came before is forgotten.
    CHECK_THAT(told_after(digits + "\r" + digits + "\rlast\r"),
               Contains("but \"last\"") || Contains("099;\\x0alast\""));
    CHECK_THAT(told_after("line\rbegun"), Contains("but \"line\\x0abegun\""));
}

TEST_CASE("a box's stream is stopped before its clock is read, and goes on after it where it ran", "[unit]") {
    for (const bool streams : {false, true}) {
        Bench bench;
        auto display = bench.open();
        if (streams)
            display.start_status();
        bench.box.model.commands.clear();
        display.read_clocks();
        CHECK(bench.box.model.commands == (streams
                                               ? std::vector<std::string>{"Stop", "Start", "Stop", "Start"}
                                               : std::vector<std::string>{"Stop", "Start", "Stop"}));
    }
    Bench nameless;
    nameless.box.model.product = "";
    CHECK_THAT(message_of([&] { nameless.open(); }), Contains("was answered without a name"));
}

TEST_CASE("a box has settled when two readings of its rate in turn are the same within half a percent",
          "[unit]") {
    for (const auto& [one, other, settles] : {std::tuple(100.0, 100.0, true),
                                              {100.0, 100.45, true},
                                              {100.0, 99.55, true},
                                              {100.0, 100.6, false},
                                              {100.0, 99.4, false},
                                              {0.0, 0.0, false}}) {
        Bench bench;
        auto display = bench.open();
        int asked = 0;
        bench.box.mutate = [&, low = one, high = other](std::string reply) {
            return reply.starts_with("#VideoFrameRate")
                       ? fmt::format("#VideoFrameRate;{:.3f};Hz;\r", ++asked % 2 == 1 ? low : high)
                       : reply;
        };
        CAPTURE(one, other);
        if (settles) {
            CHECK(display.set_mode(BoxMode::mono_plus_plus).rate_hz == Approx(other));
            CHECK(asked == 2);
        } else {
            const SessionTime began = bench.clock.now();
            CHECK_THAT(message_of([&] { display.set_mode(BoxMode::mono_plus_plus); }),
                       Contains("within 10 s after a change of mode"));
            CHECK(bench.clock.now() - began >= 10s);
            CHECK(asked > 90); // ten times a second
            CHECK(asked < 105);
        }
        bench.box.mutate = nullptr;
    }
}
