#include "devices/display_plus_plus.h"

#include <array>

#include <catch2/catch.hpp>

#include "devices/switch_record.h"
#include "experiment/error.h"
#include "experiment/random.h"
#include "tests/devices/in_memory_line.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// A box on a line, opened.
struct Bench {
    VirtualClock clock;
    InMemoryBitsBox box{clock};
    DisplayPlusPlusSettings settings;

    DisplayPlusPlus open() { return DisplayPlusPlus(box.line(), clock, settings); }
};

RgbBytes ramp(int line, int pixel) {
    return {static_cast<std::uint8_t>(pixel), static_cast<std::uint8_t>(255 - pixel),
            static_cast<std::uint8_t>(line + 3 * pixel)};
}

std::vector<DrawnLine> drawn_ramps(std::initializer_list<int> lines) {
    std::vector<DrawnLine> drawn;
    for (const int line : lines) {
        drawn.push_back({line, {}});
        for (int pixel = 0; pixel < 256; ++pixel)
            drawn.back().pixels.push_back(ramp(line, pixel));
    }
    return drawn;
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const DeviceError& error) {
        return error.what();
    }
    return "nothing was thrown";
}

} // namespace

TEST_CASE("a box is known whatever ends its lines, whatever noise is about, and while it streams", "[unit]") {
    for (const char* end : {"\n\r", "\r", "\r\n", "\n", "\r\r\n\n"})
        for (const char* noise :
             {"", "\r\n", "x#Prod\r", "#ProductType", "$touch;9.12;100;200;1;\r", "#Unknown;7;\r\xff\xfe"})
            for (const bool streaming : {false, true}) {
                Bench bench;
                bench.box.model.line_end = end;
                bench.box.model.before_reply = noise;
                if (streaming)
                    bench.box.stream_from_now();
                const BoxIdentity identity = bench.open().identity();
                INFO(printable(end) << " after " << printable(noise));
                CHECK(identity.product == "Display++");
                CHECK(identity.serial_number == "DPP-0042");
                CHECK(identity.firmware_date == "Mar 14 2018");
                CHECK(identity.port == "/dev/ttyACM0");
            }
}

TEST_CASE("half a command that another program left in the box does not hide it", "[unit]") {
    Bench bench;
    bench.box.model.receive("$GetVideoLi", 0.0);
    CHECK(bench.open().identity().product == "Display++");
}

TEST_CASE(
    "a reply that does not come is an error in half a second that names port, command and what came instead",
    "[unit]") {
    for (const char* command : {"SerialNumber", "FirmwareDate", "VideoFrameRate"}) {
        Bench bench;
        bench.box.model.silent_on = {command};
        const std::string message = message_of([&] { bench.open().video_rate_hz(); });
        CHECK_THAT(message, Contains("/dev/ttyACM0") && Contains(command) && Contains("but nothing"));
    }
    Bench bench;
    auto display = bench.open();
    bench.box.far.answer = [](std::string_view) { return std::string("?bad command\r"); };
    const SessionTime asked = bench.clock.now();
    CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("?bad command"));
    CHECK(to_seconds(bench.clock.now() - asked) == Approx(0.5).margin(0.01));
}

TEST_CASE("an answer that comes too late is not taken for that to the next question", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.far.delay = 700ms;
    CHECK_THROWS_AS(display.video_rate_hz(), DeviceError);
    bench.clock.wait_until(bench.clock.now() + 1s);
    bench.box.far.delay = 2ms;
    bench.box.model.rate_hz = 100.0;
    CHECK(display.video_rate_hz() == 100.0);

    // Half of it came before the question and half after.
    bench.box.far.send(bench.clock.now(), "#VideoFrameRate;50.0");
    bench.box.far.send(bench.clock.now() + 1ms, "00;Hz;\r");
    CHECK(display.video_rate_hz() == 100.0);
}

TEST_CASE("neither a stream nor a reply without end holds a question up", "[unit]") {
    Bench bench;
    auto display = bench.open();
    SECTION("a stream") {
        display.start_status();
        bench.box.model.silent_on = {"VideoFrameRate"};
        const SessionTime asked = bench.clock.now();
        CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("lines of a stream"));
        CHECK(to_seconds(bench.clock.now() - asked) == Approx(0.5).margin(0.01));
    }
    SECTION("a reply without end") {
        const SessionTime asked = bench.clock.now();
        bench.box.far.send(asked + 1ms, "#VideoFrameRate;");
        for (int i = 1; i < 100; ++i)
            bench.box.far.send(asked + i * 100ms, "1");
        bench.box.model.silent_on = {"VideoFrameRate"};
        CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("no end of «#VideoFrameRate;»"));
        CHECK(to_seconds(bench.clock.now() - asked) == Approx(5.0).margin(0.01));
    }
}

TEST_CASE("an answer that is no rate is refused", "[unit]") {
    for (const char* rate : {"", "fast", "1e400", "nan", "-3", "12 0", "100000"}) {
        Bench bench;
        auto display = bench.open();
        bench.box.far.answer = [rate](std::string_view) {
            return fmt::format("#VideoFrameRate;{};\r", rate);
        };
        CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("is no rate"));
    }
}

TEST_CASE("a change of mode returns when the box is back and its rate is steady", "[unit]") {
    Bench bench;
    bench.box.model.mode_change_s = 1.5; // silent, then as long again unsteady
    auto display = bench.open();
    CHECK_FALSE(display.mode());
    const ModeSwitch change = display.set_mode(BoxMode::mono_plus_plus);
    CHECK(change.rate_hz == 120.0);
    CHECK(to_seconds(change.settled_after) > 3.0);
    CHECK(to_seconds(change.settled_after) < 4.5);
    CHECK(bench.box.model.mode == "monoPlusPlus");
    CHECK(display.mode() == BoxMode::mono_plus_plus);
    display.set_mode(BoxMode::color_plus_plus);
    CHECK(bench.box.model.mode == "colorPlusPlus");
    for (const char* spelling : {"colorPlusPlus", "colourPlusPlus"}) // no box is known to take both
        CHECK(std::ranges::count(bench.box.model.commands, spelling) == 1);
}

TEST_CASE("a box that does not settle after a change of mode is an error that says what was seen", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.model.rate_hz = 0.0; // no video signal
    const SessionTime begun = bench.clock.now();
    CHECK_THAT(message_of([&] { display.set_mode(BoxMode::color_plus_plus); }), Contains("0.000;Hz"));
    CHECK(to_seconds(bench.clock.now() - begun) < 11.5);
    CHECK_FALSE(display.mode());
}

TEST_CASE("closing switches back to Bits++ only if something else was switched to", "[unit]") {
    Bench bench;
    bench.open();
    CHECK(std::ranges::count(bench.box.model.commands, "BitsPlusPlus") == 0);
    for (const BoxMode mode : {BoxMode::mono_plus_plus, BoxMode::color_plus_plus}) {
        bench.open().set_mode(mode);
        CHECK(bench.box.model.mode == "BitsPlusPlus");
    }
    bench.open().read_video_line(1, 4); // calls up the status screen
    CHECK(bench.box.model.mode == "BitsPlusPlus");
}

TEST_CASE("dithering and the gamma table are set as the box spells it, and only file names are let through",
          "[unit]") {
    Bench bench;
    auto display = bench.open();
    display.disable_temporal_dithering();
    display.select_gamma_table(DisplayPlusPlus::linear_gamma_table);
    CHECK(bench.box.model.dithering == "OFF");
    CHECK(bench.box.model.gamma_table == "13bitLinearLUT.txt");
    for (const char* name : {"", "a b", "x]\r$USB_massStorage", "../config.xml;", "é"})
        CHECK_THROWS_AS(display.select_gamma_table(name), InputError);
    CHECK(bench.box.model.gamma_table == "13bitLinearLUT.txt");
}

TEST_CASE("a video line comes as the box received it", "[unit]") {
    Bench bench;
    bench.box.model.video = ramp;
    auto display = bench.open();
    for (const int pixels : {1, 2, 256, 1920}) {
        const auto line = display.read_video_line(7, pixels);
        REQUIRE(line.size() == static_cast<std::size_t>(pixels));
        for (int pixel = 0; pixel < pixels; ++pixel)
            CHECK(line[static_cast<std::size_t>(pixel)] == ramp(7, pixel));
    }
}

TEST_CASE("a video line that is cut, too long or no numbers is refused", "[unit]") {
    for (const char* reply : {"1;2;3;4;5;", "1;2;3;4;5;6;7;", "1;2;3;4;5;256;", "1;2;3;4;;6;",
                              "1;2;3;4;-5;6;", "1;2;3;4;5x;6;", ""}) {
        const VideoLine line = parse_video_line(reply, 2);
        INFO(reply);
        CHECK(line.pixels.empty());
        CHECK_FALSE(line.fault.empty());
    }
    CHECK(parse_video_line("1;02;003;4;5;6", 2).pixels == std::vector<RgbBytes>{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("an unchanged picture passes the check and the mode is set again after it", "[unit]") {
    Bench bench;
    bench.box.model.video = ramp;
    auto display = bench.open();
    display.set_mode(BoxMode::color_plus_plus);
    const VideoLineReport report = display.check_video([] { return drawn_ramps({1, 2, 600}); });
    CHECK(report.good());
    CHECK(report.readings == 9);
    CHECK(report.bytes == 9 * 256 * 3);
    CHECK_THAT(report.description(), Contains("arrived as they were drawn"));
    CHECK(display.mode() == BoxMode::color_plus_plus);
    CHECK(bench.box.model.mode == "colorPlusPlus");
}

TEST_CASE("the check names each changed byte, finds a shift of the picture, and finds dithering", "[unit]") {
    Bench bench;
    auto display = bench.open();
    SECTION("one byte") {
        bench.box.model.video = [](int line, int pixel) {
            RgbBytes bytes = ramp(line, pixel);
            if (line == 2 && pixel == 17)
                bytes[1] = 1;
            return bytes;
        };
        const auto report = display.check_video([] { return drawn_ramps({1, 2}); }, 1);
        CHECK(report.changed == 1);
        CHECK_FALSE(report.shift_px);
        CHECK_THAT(report.description(),
                   Contains("line 2, pixel 17, green: sent 238, received 1") && Contains("gamma"));
    }
    SECTION("one pixel at the edge of a line of one colour, which is no shift") {
        bench.box.model.video = [](int, int pixel) {
            return pixel == 0 ? RgbBytes{9, 9, 9} : RgbBytes{5, 5, 5};
        };
        const auto report = display.check_video([] {
            return std::vector<DrawnLine>{{1, std::vector<RgbBytes>(64, RgbBytes{5, 5, 5})}};
        });
        CHECK(report.changed == 9);
        CHECK_FALSE(report.shift_px);
    }
    SECTION("shift") {
        for (const int shift : {1, -2, 8}) {
            bench.box.model.video = [shift](int line, int pixel) {
                return pixel < shift || pixel >= 256 + shift ? RgbBytes{} : ramp(line, pixel - shift);
            };
            const auto report = display.check_video([] { return drawn_ramps({1, 5}); });
            CHECK_FALSE(report.good());
            CHECK(report.shift_px == shift);
        }
    }
    SECTION("dithering") {
        int reading = 0;
        bench.box.model.video = [&reading](int line, int pixel) {
            RgbBytes bytes = ramp(line, pixel);
            if (pixel == 100)
                bytes[0] = static_cast<std::uint8_t>(bytes[0] + reading++ % 2);
            return bytes;
        };
        const auto report = display.check_video([] { return drawn_ramps({1}); });
        CHECK(report.unsteady_lines == 1);
        CHECK_THAT(report.description(), Contains("dithering"));
    }
}

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
    CHECK(to_seconds(pair.box) >= bench.box.box_s(pair.before) - 1e-6);
    CHECK(to_seconds(pair.box) <= bench.box.box_s(pair.after) + 1e-6);
}

TEST_CASE("status fields that are switched off on the box are said to be the reason", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.mutate = [](std::string line) {
        return line.find("#sample;") == 0 ? line.substr(0, 40) + "\r" : line;
    };
    CHECK_THAT(message_of([&] { display.read_clocks(); }), Contains("config.xml") && Contains("#sample;"));
}

TEST_CASE("an unplugged box is an error at a question and a state while its stream runs", "[unit]") {
    Bench bench;
    auto display = bench.open();
    display.set_mode(BoxMode::color_plus_plus);
    display.start_status();
    bench.box.far.unplugged = true;
    std::array<ArrivedStatus, 8> samples;
    while (display.poll_status(samples) > 0) {
    }
    CHECK(display.lost());
    CHECK_THAT(message_of([&] { display.video_rate_hz(); }), Contains("unplugged by the test"));
}

TEST_CASE("a box that takes no bytes is an error", "[unit]") {
    Bench bench;
    auto display = bench.open();
    bench.box.far.takes_bytes = false;
    CHECK_THAT(message_of([&] { display.disable_temporal_dithering(); }), Contains("did not take"));
}

namespace {

/// All that can be said to a box, as one text.
std::string whole_conversation(const std::function<std::size_t()>& piece) {
    Bench bench;
    bench.box.model.video = ramp;
    bench.box.model.before_reply = "$touch;9.125000;0100;0200;1;\r";
    bench.box.far.piece = piece;
    // Reading in small pieces takes time, which must not show: the stream ends before the questions go on.
    std::string said;
    auto display = bench.open();
    said += display.identity().product + display.identity().serial_number + display.identity().firmware_date;
    said += fmt::format(" {}", display.video_rate_hz());
    for (const RgbBytes& bytes : display.read_video_line(3, 300))
        said += fmt::format(" {},{},{}", bytes[0], bytes[1], bytes[2]);
    said += fmt::format(" {}", display.set_mode(BoxMode::mono_plus_plus).rate_hz);
    BitsLineSplitter splitter;
    std::string stream;
    for (const double time_s : {1.5, 1.6, 1.7})
        stream += bench.box.model.status_line(time_s) + "\n";
    for (std::size_t at = 0; at < stream.size();) {
        const std::size_t length = piece ? std::max<std::size_t>(1, piece()) : stream.size();
        splitter.feed(std::string_view(stream).substr(at, length), [&said](std::string_view line) {
            const auto sample = parse_status_line(line);
            said += sample ? fmt::format(" {}@{}", sample->number, to_seconds(sample->at)) : " no sample";
        });
        at += length;
    }
    return said;
}

} // namespace

TEST_CASE("however what the box says is split on its way, the same is understood", "[unit]") {
    const std::string whole = whole_conversation({});
    CHECK_THAT(whole, Contains("Display++DPP-0042Mar 14 2018 120") && Contains(" 3@1.7"));
    CHECK(whole_conversation([] { return std::size_t{1}; }) == whole);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        RandomStream random(seed, "split test");
        const auto piece = [&random] {
            return static_cast<std::size_t>(std::ceil(random.exponential(1.0) * 20.0));
        };
        CHECK(whole_conversation(piece) == whole);
    }
}

TEST_CASE("no damage to what the box says makes the program hang or fall", "[unit]") {
    int answered = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        RandomStream random(seed, "damage test");
        const auto below = [&random](std::size_t n) {
            return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(n)), n - 1);
        };
        Bench bench;
        bench.box.model.video = ramp;
        const double chance = random.uniform();
        bench.box.mutate = [&](std::string text) {
            while (!text.empty() && random.uniform() < chance * 0.6) {
                const std::size_t at = below(text.size());
                switch (below(6)) {
                case 0:
                    text[at] = static_cast<char>(below(256));
                    break;
                case 1:
                    text.erase(at, 1 + below(20));
                    break;
                case 2:
                    text.insert(at, text.substr(below(text.size()), 1 + below(60)));
                    break;
                case 3:
                    text.insert(at, std::string(1 + below(5), ";\r\n#$9-.e\0"[below(10)]));
                    break;
                case 4:
                    text.resize(at);
                    break;
                default:
                    text += text;
                    text.resize(std::min<std::size_t>(text.size(), 100000));
                }
            }
            return text;
        };
        const SessionTime begun = bench.clock.now();
        try {
            auto display = bench.open();
            const double rate_hz = display.video_rate_hz();
            CHECK((rate_hz >= 0.0 && rate_hz < 1000.0));
            const std::size_t pixels = display.read_video_line(1, 8).size();
            CHECK(pixels == 8);
            display.read_clocks();
            display.set_mode(BoxMode::mono_plus_plus);
            ++answered;
        } catch (const DeviceError&) {
            ++refused;
        }
        // The longest way: each question at its limit, the change of mode, and the way back in the
        // destructor.
        CHECK(to_seconds(bench.clock.now() - begun) < 40.0);
    }
    CHECK(answered > 100);
    CHECK(refused > 100);
}
