#include "devices/opengaze/opengaze_message.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "devices/link/text_line.h"
#include "devices/opengaze/opengaze_clock.h"
#include "devices/opengaze/opengaze_marks.h"
#include "devices/opengaze/opengaze_samples.h"
#include "tests/support/kept_items.h"

using namespace overt;
using namespace overt::test;
using Kind = OpenGazeMessage::Kind;

namespace {

OpenGazeRecord record_of(std::string_view line) {
    const auto message = parse_opengaze(line);
    REQUIRE(message);
    REQUIRE(message->kind == Kind::record);
    return read_opengaze_record(*message);
}

} // namespace

// The examples are those of the document "Open Gaze API by Gazepoint", revision of March 11, 2025.

TEST_CASE("an Open Gaze record gives gaze, pupil and place of each eye as the interface documents them",
          "[unit]") {
    const OpenGazeRecord record = record_of(
        R"(<REC CNT="1484" TIME="4.99716" TIME_TICK="2096547271623" LPOGX="0.48439" LPOGY="0.50313" LPOGV="1" )"
        R"(RPOGX="-0.01" RPOGY="1.25" RPOGV="1" BPOGX="0.25" BPOGY="0.75" BPOGV="1" LPD="15.23866" LPS="1.04834" )"
        R"(LPV="1" LEYEX="-0.04796" LEYEY="0.00305" LEYEZ="0.69235" LPUPILD="0.00210" LPUPILV="1" )"
        R"(RPUPILD="0.0024" RPUPILV="0" REYEX="1" REYEY="1" REYEZ="1" RPMM="2.5" RPMMV="1" />)");
    CHECK(record.counter == 1484);
    CHECK(record.time_s == 4.99716);
    CHECK(record.ticks == 2096547271623);
    CHECK(record.left.gaze == glm::dvec2(0.48439, 0.50313));
    CHECK(record.right.gaze == glm::dvec2(-0.01, 1.25));
    CHECK(record.best == glm::dvec2(0.25, 0.75));
    CHECK(record.left.pupil_px == 15.23866);
    CHECK(*record.left.pupil_mm == Approx(2.1));
    REQUIRE(record.left.eye_mm);
    CHECK(record.left.eye_mm->x == Approx(-47.96f));
    CHECK(record.left.eye_mm->y == Approx(3.05f));
    CHECK(record.left.eye_mm->z == Approx(692.35f));
    CHECK_FALSE(record.right.eye_mm);
    CHECK(record.right.pupil_mm == 2.5);
}

TEST_CASE("what an Open Gaze record marks as not valid, or does not tell, is no measurement", "[unit]") {
    const OpenGazeRecord record = record_of(
        R"(<REC CNT="-" TIME="nan" TIME_TICK="1e3" LPOGX="0.5" LPOGY="0.5" LPOGV="0" RPOGX="0.5" RPOGV="1" BPOGX="" BPOGY="1" BPOGV="1" />)");
    CHECK_FALSE(record.counter);
    CHECK_FALSE(record.time_s);
    CHECK_FALSE(record.ticks);
    CHECK_FALSE(record.left.gaze);
    CHECK_FALSE(record.right.gaze);
    CHECK_FALSE(record.best);
}

TEST_CASE("attributes of Open Gaze are found whatever blanks stand between them", "[unit]") {
    for (const std::string_view line :
         {R"(<ACK ID="USER_DATA" VALUE="0" DUR="1" />)", R"(<ACK ID="USER_DATA" VALUE="0"DUR="1"/>)",
          R"(  <ACK	ID = "USER_DATA"   VALUE="0" DUR=" 1" / >)",
          R"(<ACK ID="USER_DATA"VALUE=" 0 "DUR="1" />>)",
          R"(<ACK noise ID="USER_DATA" "" VALUE=7 VALUE="0" DUR="1" DUR="9">)"}) {
        const auto message = parse_opengaze(line);
        CAPTURE(line);
        REQUIRE(message);
        CHECK(message->kind == Kind::acknowledged);
        CHECK(message->value("ID") == "USER_DATA");
        CHECK(message->value("VALUE") == "0");
        CHECK(message->number("DUR") == 1.0);
        CHECK_FALSE(message->value("STATE"));
    }
}

TEST_CASE("kinds of Open Gaze lines are told apart, and lines that are none are refused", "[unit]") {
    CHECK(parse_opengaze(R"(<NACK ID="X" />)")->kind == Kind::refused);
    CHECK(parse_opengaze(R"(<CAL ID=" CALIB_START_PT" PT="2" />)")->value("ID") == "CALIB_START_PT");
    CHECK(parse_opengaze(R"(<UPDATE ACTIVE_ID="1" MAX_ID="2" >)")->kind == Kind::other);
    CHECK(parse_opengaze("<RECORD />")->kind == Kind::other);
    CHECK(parse_opengaze("<REC/>")->kind == Kind::record);
    for (const std::string_view line : {"", " ", "REC />", R"(<REC LPOGX="0.123)", R"(OGV="1" />)", "<"})
        CHECK_FALSE(parse_opengaze(line));
}

TEST_CASE("a calibration's result gives each point and where each eye was measured", "[unit]") {
    const auto message = parse_opengaze(
        R"(<CAL ID="CALIB_RESULT" CALX1="0.50000" CALY1="0.50000" LX1="0.50229" LY1="0.50279" LV1="1" RX1="0.51467" RY1="0.50870" RV1="1" CALX2="0.85000" CALY2="0.15000" LX2="0.84943" LY2="0.14930" LV2="0" RX2="0.84600" RY2="0.14763" RV2="1" />>)");
    REQUIRE(message);
    const auto first = calibration_point(*message, 1), second = calibration_point(*message, 2);
    REQUIRE(first);
    REQUIRE(second);
    CHECK(first->target == glm::dvec2(0.5, 0.5));
    CHECK(first->left == glm::dvec2(0.50229, 0.50279));
    CHECK(first->right == glm::dvec2(0.51467, 0.5087));
    CHECK(second->target == glm::dvec2(0.85, 0.15));
    CHECK_FALSE(second->left);
    CHECK_FALSE(calibration_point(*message, 3));
}

TEST_CASE("no text can end a value or an element of Open Gaze", "[unit]") {
    CHECK(opengaze_text("TRIALID 3 \"runner\" <b>&\r\n") == "TRIALID 3  runner   b    ");
}

TEST_CASE("a stream of Open Gaze gives the same records however it is cut into pieces", "[unit]") {
    std::string stream;
    for (int i = 0; i < 50; ++i)
        stream += fmt::format("<REC CNT=\"{}\" LPOGX=\"0.{:03}\" LPOGY=\"0.5\" LPOGV=\"1\" />\r\n", i, i);
    const auto sum_of = [&](auto&& next_piece) {
        LineSplitter splitter(4096);
        double sum = 0.0;
        for (std::string_view rest = stream; !rest.empty();) {
            const std::string_view piece = rest.substr(0, next_piece());
            rest.remove_prefix(piece.size());
            splitter.feed(piece, [&](std::string_view line) {
                const OpenGazeRecord record = record_of(line);
                sum += static_cast<double>(*record.counter + 1) * record.left.gaze->x;
            });
        }
        return sum;
    };
    const double whole = sum_of([&] { return stream.size(); });
    CHECK(whole > 0.0);
    CHECK(sum_of([] { return 1u; }) == whole);
    CHECK(sum_of([] { return 7u; }) == whole);
}

namespace {

OpenGazeRecord record_of(std::int64_t counter, double time_s) {
    OpenGazeRecord record;
    record.counter = counter;
    record.time_s = time_s;
    record.left.gaze = glm::dvec2(0.25, 0.5);
    record.left.pupil_mm = 3.0;
    record.left.eye_mm = glm::vec3(-30.0f, 1.0f, 600.0f);
    record.right.gaze = glm::dvec2(0.75, 0.5);
    record.right.pupil_mm = 4.0;
    record.best = glm::dvec2(0.5, 0.5);
    return record;
}

} // namespace

TEST_CASE("records become samples of the eyes that are wished for, in px and mm, each at its time",
          "[unit]") {
    TrackerWish wish;
    wish.eye = Eye::right;
    for (const bool both : {false, true}) {
        wish.both_eyes = both;
        OpenGazeSamples samples(wish, TrackedPoint::eyes, std::chrono::milliseconds(20));
        OpenGazeClock clock;
        KeptItems items;
        samples.begin();
        samples.take(record_of(1, 10.0), SessionTime(std::chrono::seconds(1)), clock, items);
        const auto found = items.all<GazeSample>();
        REQUIRE(found.size() == (both ? 2 : 1));
        CHECK(found.back().eye == Eye::right);
        CHECK(found.back().gaze->x_px == Approx(0.75 * wish.screen.screen_px.x));
        CHECK(found.back().gaze->y_px == Approx(0.5 * wish.screen.screen_px.y));
        CHECK(found.back().pupil_area == 4.0f);
        CHECK(found.back().sampled_at == samples.last_time());
        const auto details = items.all<SampleDetail>();
        REQUIRE(details.size() == (both ? 1 : 0)); // where an eye is is known of the left one
        if (both) {
            CHECK(found[0].eye == Eye::left);
            CHECK(found[0].pupil_area == 3.0f);
            CHECK(details[0].eye == Eye::left);
            CHECK(details[0].sampled_at == samples.last_time());
            CHECK(details[0].eye_mm == glm::vec3(-30.0f, 1.0f, 600.0f));
        }
        const auto pairs = items.all<ClockPair>();
        REQUIRE(pairs.size() == 1);
        CHECK(pairs[0].after == SessionTime(std::chrono::seconds(1)));
        CHECK(pairs[0].before == SessionTime(std::chrono::milliseconds(980)));
        CHECK(pairs[0].other == samples.last_time());
        CHECK(samples.last_arrival() == SessionTime(std::chrono::seconds(1)));
    }
    wish.both_eyes = false;
    OpenGazeSamples best(wish, TrackedPoint::best, std::chrono::milliseconds(20));
    OpenGazeClock clock;
    KeptItems items;
    best.begin();
    best.take(record_of(1, 10.0), SessionTime(std::chrono::seconds(1)), clock, items);
    CHECK(items.all<GazeSample>().at(0).gaze->x_px == Approx(0.5 * wish.screen.screen_px.x));
    CHECK(items.all<GazeSample>().at(0).pupil_area == 4.0f);
}

TEST_CASE("a gap is told with how many records it lacks, those told of as noise not twice", "[unit]") {
    TrackerWish wish;
    OpenGazeSamples samples(wish, TrackedPoint::eyes, std::chrono::milliseconds(20));
    OpenGazeClock clock;
    KeptItems items;
    samples.begin();
    double time_s = 10.0;
    const auto take = [&](std::int64_t counter) {
        time_s += 0.01;
        samples.take(record_of(counter, time_s),
                     SessionTime(std::chrono::seconds(1)) + from_seconds(time_s - 10.0), clock, items);
    };
    take(5);
    take(6);
    CHECK(items.all<TrackerGap>().empty());
    const TrackerTime last = samples.last_time();
    take(10); // 7 to 9
    REQUIRE(items.all<TrackerGap>().size() == 1);
    CHECK(items.all<TrackerGap>()[0].reason == TrackerGap::Reason::overflow);
    CHECK(items.all<TrackerGap>()[0].lost_samples == 3);
    CHECK(items.all<TrackerGap>()[0].after == last);
    samples.take_noise(items);
    take(12); // 11 came as noise
    auto gaps = items.all<TrackerGap>();
    REQUIRE(gaps.size() == 2);
    CHECK(gaps[1].reason == TrackerGap::Reason::unreadable);
    CHECK(gaps[1].lost_samples == 1);
    samples.take_noise(items);
    take(16); // of 13 to 15 one came as noise
    gaps = items.all<TrackerGap>();
    REQUIRE(gaps.size() == 4);
    CHECK(gaps[3].lost_samples == 2);
    // A counter that begins anew lacks nothing, and neither does a new recording.
    take(3);
    samples.begin();
    take(50);
    CHECK(items.all<TrackerGap>().size() == 4);
}

TEST_CASE("about once a second a reading of both clocks is told, that of the record which came soonest",
          "[unit]") {
    TrackerWish wish;
    OpenGazeSamples samples(wish, TrackedPoint::eyes, std::chrono::milliseconds(20));
    OpenGazeClock clock;
    KeptItems items;
    samples.begin();
    for (int i = 0; i <= 300; ++i) {
        // Each a hundredth of a second after the other; most come 15 ms late, one in each second 4 ms.
        const double time_s = 0.01 * i;
        const double late_s = i % 100 == 40 ? 0.004 : 0.015;
        samples.take(record_of(i, 10.0 + time_s), SessionTime(from_seconds(1.0 + time_s + late_s)), clock,
                     items);
    }
    const auto pairs = items.all<ClockPair>();
    REQUIRE(pairs.size() == 4);
    for (std::size_t k = 1; k < 4; ++k)
        CHECK(to_seconds(pairs[k].after - SessionTime()) ==
              Approx(1.0 + 0.4 + (static_cast<double>(k) - 1.0) + 0.004));
    for (const ClockPair& pair : pairs)
        CHECK(pair.after - pair.before == SessionDuration(std::chrono::milliseconds(20)));
}

TEST_CASE(
    "marks wait until a record bears them, or has had the time to, and frames are the first to be left out",
    "[unit]") {
    OpenGazeMarks marks;
    marks.begin(std::chrono::milliseconds(10));
    const auto at = [](int ms) { return SessionTime(std::chrono::milliseconds(1000 + ms)); };
    CHECK(marks.add("TRIALID 1", at(0)) == "TRIALID 1");
    CHECK(marks.add("SYNCTIME", at(5)) == "TRIALID 1 | SYNCTIME");
    marks.borne("TRIALID 1"); // not all of it
    CHECK(marks.add("FRAME 0", at(10)) == "TRIALID 1 | SYNCTIME | FRAME 0");
    marks.borne("TRIALID 1 | SYNCTIME | FRAME 0");
    CHECK(marks.add("FRAME 1", at(12)) == "FRAME 1");
    CHECK(marks.add("FRAME 2", at(27)) == "FRAME 1 | FRAME 2"); // one and a half records later
    CHECK(marks.add("FRAME 3", at(43)) == "FRAME 3");           // more: it was borne, whoever was told
    CHECK(marks.frames_left_out() == 0);
    // At most 240 bytes: frames go first, the oldest of them, then variables, then what came first.
    OpenGazeMarks full;
    full.begin(std::chrono::seconds(1));
    const std::string id = "TRIALID 1", variable = "!V TRIAL_VAR a " + std::string(80, 'x');
    full.add(id, at(0));
    full.add("FRAME 7", at(0));
    full.add(variable, at(0));
    full.add("FRAME 8", at(0));
    std::string said = full.add(std::string(110, 'y'), at(0));
    CHECK(said == id + " | FRAME 7 | " + variable + " | FRAME 8 | " + std::string(110, 'y'));
    CHECK(said.size() <= OpenGazeMarks::longest);
    said = full.add("z", at(0));
    CHECK(said.size() <= OpenGazeMarks::longest);
    said = full.add(std::string(10, 'w'), at(0));
    CHECK(said.find("FRAME") == std::string::npos);
    CHECK(said.find(variable) != std::string::npos);
    CHECK(full.frames_left_out() == 2);
    CHECK(full.others_left_out() == 0);
    said = full.add(std::string(30, 'v'), at(0));
    CHECK(said == id + " | " + std::string(110, 'y') + " | z | " + std::string(10, 'w') + " | " +
                      std::string(30, 'v'));
    CHECK(full.others_left_out() == 1);
    said = full.add(std::string(100, 'u'), at(0));
    CHECK(said.find(id) == std::string::npos);
    CHECK(full.others_left_out() == 3);
}

TEST_CASE("a server's time that goes back goes on in session time, and ticks count where they are proven",
          "[unit]") {
    OpenGazeClock clock;
    OpenGazeRecord record;
    const auto arrived = [](double s) { return SessionTime(from_seconds(s)); };
    CHECK_FALSE(clock.time_of(record, arrived(1.0)));
    record.time_s = 10.0;
    CHECK(clock.time_of(record, arrived(1.0)) == tracker_time(10'000'000));
    record.time_s = 10.5;
    CHECK(clock.time_of(record, arrived(1.5)) == tracker_time(10'500'000));
    record.time_s = 0.2; // it was calibrated
    CHECK(clock.time_of(record, arrived(2.25)) == tracker_time(11'250'000));
    record.time_s = 0.7;
    CHECK(clock.time_of(record, arrived(2.75)) == tracker_time(11'750'000));
    OpenGazeRecord earlier, later;
    earlier.time_s = 1.0;
    earlier.ticks = 5'000;
    later.time_s = 3.0;
    const auto proven = [&](std::int64_t ticks, std::optional<double> told = 1000.0) {
        later.ticks = ticks;
        return proven_tick_hz(told, earlier, later);
    };
    CHECK(proven(7'000) == 1000.0);
    CHECK(proven(7'099) == 1000.0);
    CHECK(proven(6'901) == 1000.0);
    CHECK_FALSE(proven(7'101));
    CHECK_FALSE(proven(6'899));
    CHECK_FALSE(proven(7'000, std::nullopt));
    CHECK_FALSE(proven(7'000, 0.0));
    CHECK_FALSE(proven(7'000, -1000.0));
    later.time_s = 1.1;
    CHECK(proven(5'100) == 1000.0);
    later.time_s = 1.09; // too short to say
    CHECK_FALSE(proven(5'090));
}

TEST_CASE("of a mark's text all printable characters stay but those of the language itself", "[unit]") {
    for (int code = 1; code < 256; ++code) {
        const std::string text{'a', static_cast<char>(code), 'b'};
        const bool stays = code >= 0x20 && code <= 0x7E &&
                           std::string_view("\"'<>&").find(static_cast<char>(code)) == std::string_view::npos;
        CAPTURE(code);
        CHECK(opengaze_text(text) == (stays ? text : "a b"));
    }
}

TEST_CASE(
    "marks wait for one and a half intervals, are cut to what a value holds, and leave out one at a time",
    "[unit]") {
    using namespace std::chrono_literals;
    OpenGazeMarks marks;
    marks.begin(10ms);
    CHECK(marks.add("a", SessionTime(1s)) == "a");
    CHECK(marks.add("b", SessionTime(1s + 15ms)) == "a | b");
    CHECK(marks.add("c", SessionTime(1s + 30ms + 1ns)) == "c");
    marks.borne("something else");
    CHECK(marks.add("d", SessionTime(1s + 31ms)) == "c | d");
    marks.borne("c | d");
    marks.borne(""); // an empty one bears nothing
    CHECK(marks.add(std::string(241, 'x'), SessionTime(1s + 32ms)) == std::string(240, 'x'));
    CHECK(marks.add("e", SessionTime(1s + 33ms)) == "e"); // the first of what is no frame goes
    CHECK(marks.others_left_out() == 1);
    CHECK(marks.frames_left_out() == 0);
    // Exactly what a value holds: 236 letters, a blank, a bar, a blank and another letter.
    CHECK(marks.add(std::string(236, 'y'), SessionTime(1s + 34ms)) == "e | " + std::string(236, 'y'));
    CHECK(marks.add("FRAME 1", SessionTime(1s + 35ms)) == "e | " + std::string(236, 'y'));
    CHECK(marks.frames_left_out() == 1);
    CHECK(marks.add("!V x", SessionTime(1s + 36ms)) == "e | " + std::string(236, 'y'));
    CHECK(marks.others_left_out() == 2);
}

TEST_CASE("a told frequency is proven over a tenth of a second at least, and within 5 percent", "[unit]") {
    OpenGazeRecord earlier, later;
    const auto proves = [&](double seconds, double ticks) {
        earlier.time_s = 8.0;
        later.time_s = 8.0 + seconds;
        earlier.ticks = 1000;
        later.ticks = 1000 + static_cast<std::int64_t>(ticks);
        return proven_tick_hz(1e6, earlier, later).has_value();
    };
    CHECK(proves(0.125, 125'000));
    CHECK_FALSE(proves(0.0625, 62'500));
    CHECK(proves(1.0, 1'049'000));
    CHECK(proves(1.0, 951'000));
    CHECK_FALSE(proves(1.0, 1'051'000));
    CHECK_FALSE(proves(1.0, 949'000));
    CHECK_FALSE(proves(-1.0, -1'000'000));
    CHECK_FALSE(proven_tick_hz(0.0, earlier, later));
    CHECK_FALSE(proven_tick_hz(-1e6, earlier, later));
}

TEST_CASE("a counter that jumps by a million has been set anew", "[unit]") {
    for (const std::int64_t jump : {999'999, 1'000'000}) {
        TrackerWish wish;
        OpenGazeSamples samples(wish, TrackedPoint::eyes, std::chrono::milliseconds(20));
        OpenGazeClock clock;
        KeptItems items;
        samples.begin();
        samples.take(record_of(5, 10.0), SessionTime(std::chrono::seconds(1)), clock, items);
        samples.take(record_of(5 + jump, 10.01), SessionTime(std::chrono::seconds(1)), clock, items);
        const auto gaps = items.all<TrackerGap>();
        REQUIRE(gaps.size() == (jump < 1'000'000 ? 1u : 0u));
        if (!gaps.empty())
            CHECK(gaps[0].lost_samples == jump - 1);
    }
}

TEST_CASE("what follows a message's kind ends before its bracket, and what stands around it counts not",
          "[unit]") {
    for (const char* const line : {"<REC A=\"1\">", " \t<REC A=\"1\">\t "}) {
        const auto message = parse_opengaze(line);
        REQUIRE(message);
        CHECK(message->kind == OpenGazeMessage::Kind::record);
        CHECK(message->attributes == " A=\"1\"");
    }
    CHECK(parse_opengaze("<ACK>")->attributes.empty());
    CHECK(parse_opengaze("<NACK/>")->attributes == "/");
    CHECK(parse_opengaze("<>")->attributes.empty());
    for (const char* const none : {"", " ", "<", "<REC", ">", "REC>", "x<REC>"})
        CHECK_FALSE(parse_opengaze(none));
}
