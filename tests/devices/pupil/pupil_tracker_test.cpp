#include "devices/pupil/pupil_tracker.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "experiment/protocol/protocol.h"
#include "tests/devices/pupil/pupil_peer.h"
#include "tests/devices/tracker/scripted_setup_screen.h"
#include "tests/support/counted_clock.h"
#include "tests/support/kept_items.h"
#include "tests/support/next_function.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::VectorContains;

namespace {

/// Pupil Capture over sockets in real time, and its driver.
struct PupilBench {
    SteadyClock clock;
    PupilPeer peer;
    PupilSettings settings;
    TrackerWish wish;
    KeptItems items;
    std::unique_ptr<PupilTracker> tracker;

    PupilBench() {
        settings.remote = peer.address();
        settings.patience = 20s; // the peer's thread may get no processor for long
        wish.both_eyes = true;
    }

    TrackerDescription connect() {
        tracker = std::make_unique<PupilTracker>(settings, clock);
        return tracker->connect(wish);
    }

    /// Until so many samples have come.
    RecordingState read_samples(std::size_t wanted) {
        RecordingState state = RecordingState::running;
        const SessionTime give_up = clock.now() + 60s;
        while (items.all<GazeSample>().size() < wanted && state == RecordingState::running &&
               clock.now() < give_up)
            state = tracker->read(items, clock.now() + 2ms);
        return state;
    }
};

} // namespace

TEST_CASE("Pupil Capture tells its version and how fast its cameras are", "[unit]") {
    PupilBench bench;
    const TrackerDescription description = bench.connect();
    CHECK(description.name == "Pupil Core");
    CHECK(description.model == "Pupil Capture 3.5.1");
    CHECK(description.sample_rate_hz == Approx(120.0).epsilon(1e-3));
    CHECK(description.told_rate_hz == Approx(120.0).epsilon(1e-3));
    CHECK(description.both_eyes);
    CHECK_THAT(bench.peer.commands(),
               VectorContains(std::string("notify.start_plugin {\"args\":{},\"name\":\"Annotation_Capture\","
                                          "\"subject\":\"start_plugin\"}")));
}

TEST_CASE("the rate is that of gaze, and that of the eye's camera is told beside it", "[unit]") {
    PupilBench bench;
    bench.peer.gazes_a_picture = 2;
    bench.peer.has_surface = GENERATE(true, false);
    const TrackerDescription description = bench.connect();
    CHECK(description.sample_rate_hz == Approx(240.0).epsilon(0.02));
    CHECK(description.told_rate_hz == Approx(120.0).epsilon(1e-3));
}

TEST_CASE("a recording of Pupil Capture ends with its driver, whoever forgets it", "[unit]") {
    PupilBench bench;
    bench.connect();
    bench.tracker->start();
    bench.read_samples(5);
    bench.tracker->stop();
    bench.tracker.reset();
    CHECK(bench.peer.commands().back() == "r");
}

TEST_CASE("gaze on the surface that is named becomes samples over real sockets", "[unit]") {
    PupilBench bench;
    bench.connect();
    bench.tracker->start();
    REQUIRE(bench.read_samples(60) == RecordingState::running);
    bench.tracker->stop();
    const auto samples = bench.items.all<GazeSample>();
    for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {
        CHECK(samples[i].eye == Eye::left);
        REQUIRE(samples[i].gaze);
        CHECK(samples[i].gaze->x_px == Approx(480.0));
        CHECK(samples[i].gaze->y_px == Approx(270.0));
        CHECK(samples[i + 1].sampled_at == samples[i].sampled_at);
        if (i > 0)
            CHECK(samples[i].sampled_at > samples[i - 2].sampled_at);
    }
    CHECK(samples[samples.size() - 2].pupil_area == 4.5f);
    CHECK(samples.back().pupil_area == 3.5f);
    CHECK(bench.items.all<TrackerGap>().empty());
    CHECK(*bench.items.all<SampleDetail>().back().eye_mm == glm::vec3(1.0f, 2.0f, 40.0f));
}

TEST_CASE("what is published between recordings is no part of the next", "[unit]") {
    PupilBench bench;
    bench.connect();
    bench.tracker->start();
    bench.read_samples(10);
    bench.tracker->stop();
    bench.items.items.clear();
    const int before = bench.peer.gazes();
    while (bench.peer.gazes() < before + 50)
        bench.clock.wait_until(bench.clock.now() + 5ms);
    const auto started = static_cast<std::int64_t>(PupilPeer::now_s() * 1e6);
    bench.tracker->start();
    bench.read_samples(10);
    CHECK(bench.items.all<GazeSample>().front().sampled_at.time_since_epoch().count() > started - 50'000);
}

TEST_CASE("gaze of little confidence is lost, and one eye's camera is not the other eye's gaze",
          "[unit][waits]") {
    PupilBench bench;
    bench.peer.confidence = 0.5;
    bench.peer.cameras = 0;
    bench.wish.both_eyes = false;
    bench.connect();
    bench.tracker->start();
    bench.read_samples(5);
    CHECK_FALSE(bench.items.all<GazeSample>().back().gaze);
    CHECK(bench.items.all<SampleDetail>().back().confidence == 0.5f);
    bench.peer.confidence = 0.7;
    bench.items.items.clear();
    bench.read_samples(60);
    CHECK(bench.items.all<GazeSample>().back().gaze);
    bench.wish.eye = Eye::left;
    bench.settings.patience = 500ms;
    CHECK_THROWS_WITH(bench.connect(), Contains("tells nothing of the left eye"));
}

TEST_CASE("readings of Pupil Capture's clock hold the truth between them", "[unit]") {
    PupilBench bench;
    bench.connect();
    for (int i = 0; i < 10; ++i) {
        const double session_s = to_seconds(bench.clock.now()), pupil_s = PupilPeer::now_s();
        const auto pair = bench.tracker->read_clocks();
        REQUIRE(pair);
        const double told_s = static_cast<double>(pair->other.time_since_epoch().count()) * 1e-6;
        const double session_of_told_s = told_s - pupil_s + session_s;
        CHECK(to_seconds(pair->before) <= session_of_told_s + 1e-3);
        CHECK(session_of_told_s <= to_seconds(pair->after) + 1e-3);
    }
}

TEST_CASE("marks become annotations at the pupil time of what they mark", "[unit]") {
    PupilBench bench;
    bench.connect();
    bench.tracker->start();
    bench.read_samples(10);
    const std::optional<ClockPair> clocks = bench.tracker->read_clocks();
    REQUIRE(clocks);
    const SessionTime at = bench.clock.now() - 100s;
    const SessionTime give_up = bench.clock.now() + 20s;
    while (bench.peer.annotations().empty() && bench.clock.now() < give_up) {
        bench.tracker->send({at, "ONSET \xff 3"});
        bench.tracker->read(bench.items, bench.clock.now() + 20ms);
    }
    REQUIRE_FALSE(bench.peer.annotations().empty());
    const nlohmann::json annotation = bench.peer.annotations().front();
    CHECK(annotation["topic"] == "annotation");
    CHECK(annotation["label"] == "ONSET ? 3");
    CHECK(annotation["duration"] == 0.0);
    CHECK(annotation.size() == 4);
    // By the last reading of the clock: what it told was so in the middle of it.
    const double middle_s = 0.5 * (to_seconds(clocks->before) + to_seconds(clocks->after));
    CHECK(annotation["timestamp"].get<double>() ==
          Approx(1e-6 * static_cast<double>(clocks->other.time_since_epoch().count()) + to_seconds(at) -
                 middle_s)
              .margin(1e-8)
              .epsilon(0.0));
}

TEST_CASE("Pupil Capture records from the first recording of a session to its end", "[unit]") {
    PupilBench bench;
    bench.wish.file_name = "s01";
    bench.connect();
    for (int i = 0; i < 2; ++i) {
        bench.tracker->start();
        bench.read_samples(5);
        bench.tracker->stop();
    }
    CHECK(bench.tracker->finish("", {}).empty());
    const std::vector<std::string> commands = bench.peer.commands();
    CHECK(std::ranges::count(commands, "R s01") == 1);
    CHECK(std::ranges::count(commands, "r") == 1);
}

TEST_CASE("a surface that never comes is told in the end", "[unit]") {
    PupilBench bench;
    bench.peer.has_surface = false;
    bench.connect();
    bench.tracker->start();
    const SessionTime end = bench.clock.now() + 100ms;
    while (bench.clock.now() < end)
        CHECK(bench.tracker->read(bench.items, bench.clock.now() + 5ms) == RecordingState::running);
    bench.tracker->stop();
    CHECK(bench.items.all<GazeSample>().empty());
    REQUIRE(bench.tracker->finish("", {}).size() == 1);
    CHECK_THAT(bench.tracker->finish("", {}).front(), Contains("no gaze came on the surface \"screen\""));
}

TEST_CASE("Pupil Capture calibrates, fails, takes too long or is broken off", "[unit]") {
    PupilBench bench;
    bench.connect();
    ScriptedSetupScreen setup_screen(bench.clock);
    const SetupOutcome done = bench.tracker->set_up(setup_screen);
    CHECK(done.kind == SetupOutcome::Kind::done);
    CHECK(done.method == "tracker");
    CHECK(done.message == "Pupil Capture tells no error of its calibration");
    CHECK_THAT(setup_screen.texts.front(), Contains("Pupil Capture calibrates"));
    bench.peer.calibrates_well = false;
    const SetupOutcome failed = bench.tracker->set_up(setup_screen);
    CHECK(failed.kind == SetupOutcome::Kind::failed);
    CHECK(failed.message == "Pupil Capture could not calibrate: its own window says why");
    CHECK(bench.peer.commands().back() == "C");
    bench.peer.calibration_s = 1000.0;
    setup_screen.keys = {SetupKey{SetupKey::Kind::escape}};
    const SetupOutcome cancelled = bench.tracker->set_up(setup_screen);
    CHECK(cancelled.kind == SetupOutcome::Kind::cancelled);
    CHECK(cancelled.message == "the calibration was broken off");
    CHECK(bench.peer.commands().back() == "c");
    bench.settings.calibration_time = 100ms;
    bench.connect();
    const SetupOutcome late = bench.tracker->set_up(setup_screen);
    CHECK(late.kind == SetupOutcome::Kind::failed);
    CHECK(late.method == "tracker");
    CHECK(late.message == "Pupil Capture did not end its calibration in time");
    CHECK(bench.peer.commands().back() == "c");
}

TEST_CASE("Pupil Capture that is not there, or is something else, is refused with a remedy", "[unit]") {
    PupilBench bench;
    bench.settings.patience = 200ms;
    bench.peer.answers = false;
    CHECK_THROWS_WITH(bench.connect(), Contains("does not answer at 127.0.0.1") && Contains("Pupil Remote"));
    bench.peer.answers = true;
    bench.settings.patience = 20s;
    bench.peer.answer_sub_port("Hello\n");
    CHECK_THROWS_WITH(bench.connect(), Contains("is not Pupil Remote") && Contains("Hello\\x0a"));
}

TEST_CASE("Pupil Capture that falls silent is lost, with a gap, and can be reached again", "[unit]") {
    PupilBench bench;
    bench.settings.silence = 300ms;
    bench.connect();
    bench.tracker->start();
    bench.read_samples(10);
    bench.peer.publishes = false;
    CHECK(bench.read_samples(1'000'000) == RecordingState::lost);
    REQUIRE_FALSE(bench.items.all<TrackerGap>().empty());
    CHECK(bench.items.all<TrackerGap>().back().reason == TrackerGap::Reason::connection);
    CHECK(bench.items.all<TrackerGap>().back().lost_samples == 0);
    CHECK(bench.items.all<TrackerGap>().back().after == bench.items.all<GazeSample>().back().sampled_at);
    bench.tracker->stop();
    bench.peer.publishes = true;
    bench.settings.silence = 20s;
    bench.tracker->connect(bench.wish);
    bench.tracker->start();
    bench.items.items.clear();
    bench.read_samples(10);
    CHECK(bench.items.all<GazeSample>().size() >= 10);
}

TEST_CASE("messages that Pupil Capture would never send are gaps and nothing worse", "[unit]") {
    PupilBench bench;
    bench.connect();
    bench.tracker->start();
    bench.read_samples(10);
    bench.peer.publish_raw("surfaces.screen", std::string(1'000'000, '\x91'));
    bench.peer.publish_raw("pupil.0.3d", "");
    bench.items.items.clear();
    const SessionTime give_up = bench.clock.now() + 20s;
    while (bench.items.all<TrackerGap>().size() < 2 && bench.clock.now() < give_up)
        bench.tracker->read(bench.items, bench.clock.now() + 2ms);
    REQUIRE(bench.items.all<TrackerGap>().size() == 2);
    CHECK(bench.items.all<TrackerGap>().front().reason == TrackerGap::Reason::unreadable);
}

TEST_CASE("what waited when a recording of Pupil Capture began is no part of it, however much", "[unit]") {
    PupilBench bench;
    bench.connect();
    bench.tracker->start();
    bench.read_samples(10);
    // Messages that cannot be read, of which each is a gap.
    for (int i = 0; i < 400; ++i)
        bench.peer.publish_raw("surfaces.screen", "x");
    const SessionTime give_up = bench.clock.now() + 20s;
    while (bench.items.all<TrackerGap>().empty() && bench.clock.now() < give_up)
        bench.tracker->read(bench.items, bench.clock.now() + 2ms);
    REQUIRE_FALSE(bench.items.all<TrackerGap>().empty());
    for (int i = 0; i < 2000; ++i)
        bench.peer.publish_raw("surfaces.screen", "x");
    const int before = bench.peer.gazes();
    while (bench.peer.gazes() < before + 20)
        bench.clock.wait_until(bench.clock.now() + 5ms);
    bench.tracker->stop();
    bench.items.items.clear();
    bench.tracker->start();
    bench.read_samples(10);
    CHECK(bench.items.all<TrackerGap>().empty());
}

TEST_CASE("what is no port is refused, with the end of what was said", "[unit]") {
    PupilBench bench;
    for (const char* const port : {"0", "-1", "65536", "1x", "1000000000000"}) {
        bench.peer.answer_sub_port(port);
        CHECK_THROWS_WITH(bench.connect(), Contains(fmt::format("to SUB_PORT it says \"{}\";", port)));
    }
    bench.peer.answer_sub_port(std::string(40, 'a'));
    CHECK_THROWS_WITH(bench.connect(), Contains("says \"" + std::string(40, 'a') + "\""));
    bench.peer.answer_sub_port("b" + std::string(40, 'a'));
    CHECK_THROWS_WITH(bench.connect(), Contains("says \"…" + std::string(40, 'a') + "\""));
}

TEST_CASE("rates of Pupil Capture are those of different and rising times", "[unit]") {
    PupilBench bench;
    bench.peer.doubles = true;
    bench.peer.has_surface = false;
    const TrackerDescription description = bench.connect();
    CHECK(description.told_rate_hz == Approx(120.0).epsilon(0.02));
    CHECK(description.sample_rate_hz == Approx(120.0).epsilon(0.02));
}

TEST_CASE("an eye whose camera tells nothing is named with the camera's number", "[unit]") {
    for (const Eye eye : {Eye::left, Eye::right}) {
        PupilBench bench;
        bench.settings.patience = 300ms;
        bench.peer.cameras = eye == Eye::left ? 0 : 1;
        bench.wish.both_eyes = false;
        bench.wish.eye = eye;
        CHECK_THROWS_WITH(bench.connect(),
                          Contains(eye == Eye::left ? "nothing of the left eye; switch on the "
                                                      "detection of eye 1 in it"
                                                    : "nothing of the right eye; switch on the "
                                                      "detection of eye 0 in it"));
    }
}

namespace {

/// Options that sockets of ZeroMQ are given, and times that they are waited for, where a test notes them.
struct NotedZmq {
    std::vector<std::string> options;
    std::vector<long> waits;
};
thread_local NotedZmq* noted_zmq = nullptr;

} // namespace

// They take the place of the library's for this program.
extern "C" {
int zmq_setsockopt(void* socket, int option, const void* value, std::size_t size) {
    static auto* const next = next_function<decltype(zmq_setsockopt)>("zmq_setsockopt");
    if (noted_zmq) {
        std::int64_t number = 0;
        if (size <= sizeof number)
            std::memcpy(&number, value, size);
        noted_zmq->options.push_back(
            option == ZMQ_SUBSCRIBE || option == ZMQ_UNSUBSCRIBE
                ? fmt::format("{} {}", option, std::string(static_cast<const char*>(value), size))
                : fmt::format("{} {} of {}", option, number, size));
    }
    return next(socket, option, value, size);
}
int zmq_poll(zmq_pollitem_t* items, int count, long ms) {
    static auto* const next = next_function<decltype(zmq_poll)>("zmq_poll");
    if (noted_zmq)
        noted_zmq->waits.push_back(ms);
    return next(items, count, noted_zmq ? 0 : ms);
}
}

TEST_CASE("sockets of ZeroMQ linger not, hold ten thousand messages, and wait whole milliseconds", "[unit]") {
    CountedClock clock;
    const ZmqContext context;
    NotedZmq noted;
    noted_zmq = &noted;
    {
        ZmqSocket socket(context, ZmqSocket::Kind::subscribe, "tcp://127.0.0.1:9", clock);
        CHECK(noted.options == std::vector<std::string>{fmt::format("{} 0 of 4", ZMQ_LINGER),
                                                        fmt::format("{} 10000 of 4", ZMQ_RCVHWM),
                                                        fmt::format("{} 4194304 of 8", ZMQ_MAXMSGSIZE)});
        noted.options.clear();
        socket.subscribe("pupil.");
        socket.unsubscribe("pupil.");
        CHECK(noted.options == std::vector<std::string>{fmt::format("{} pupil.", ZMQ_SUBSCRIBE),
                                                        fmt::format("{} pupil.", ZMQ_UNSUBSCRIBE)});
        std::vector<std::string> frames;
        for (const SessionDuration left :
             {SessionDuration(-5ms), SessionDuration(0ms), SessionDuration(1ns), SessionDuration(1ms),
              SessionDuration(2500us), SessionDuration(2h)})
            CHECK_FALSE(socket.receive(frames, clock.time + left));
        CHECK(noted.waits == std::vector<long>{0, 0, 1, 1, 3, 3'600'000});
    }
    CHECK_THROWS_WITH(ZmqSocket(context, ZmqSocket::Kind::request, "nowhere", clock),
                      Contains("nowhere cannot be connected: ") && Contains("; name a host and a port."));
    noted_zmq = nullptr;
}

TEST_CASE("of a message sixteen frames are taken, each as it is, and longer ones leave nothing behind",
          "[unit]") {
    SteadyClock clock;
    const ZmqContext context;
    void* const server = zmq_socket(context.handle(), ZMQ_REP);
    REQUIRE(zmq_bind(server, "tcp://127.0.0.1:*") == 0);
    char endpoint[64];
    std::size_t size = sizeof endpoint;
    REQUIRE(zmq_getsockopt(server, ZMQ_LAST_ENDPOINT, endpoint, &size) == 0);
    {
        ZmqSocket socket(context, ZmqSocket::Kind::request, endpoint, clock);
        for (const int count : {1, 2, 15, 16, 17, 20, 3}) {
            const std::array<std::string_view, 2> question{"how many", ""};
            REQUIRE(socket.send(question, clock.now() + 20s));
            std::vector<std::string> heard;
            for (bool more = true; more;) {
                zmq_msg_t frame;
                zmq_msg_init(&frame);
                REQUIRE(zmq_msg_recv(&frame, server, 0) >= 0);
                heard.emplace_back(static_cast<const char*>(zmq_msg_data(&frame)), zmq_msg_size(&frame));
                more = zmq_msg_more(&frame) != 0;
                zmq_msg_close(&frame);
            }
            CHECK(heard == std::vector<std::string>{"how many", ""});
            for (int i = 0; i < count; ++i) {
                const std::string text = fmt::format("frame {}", i);
                zmq_send(server, text.data(), text.size(), i + 1 < count ? ZMQ_SNDMORE : 0);
            }
            std::vector<std::string> frames{"old", "older", "oldest", "and more"};
            REQUIRE(socket.receive(frames, clock.now() + 20s));
            REQUIRE(frames.size() == std::min<std::size_t>(static_cast<std::size_t>(count), 16));
            for (std::size_t i = 0; i < frames.size(); ++i)
                CHECK(frames[i] == fmt::format("frame {}", i));
        }
    }
    zmq_close(server);
}

TEST_CASE("a protocol says where Pupil Capture is, what its surface is called and where it lies", "[unit]") {
    Protocol protocol;
    PupilSettings settings = pupil_settings_of(protocol);
    CHECK(settings.remote.host == "127.0.0.1");
    CHECK(settings.remote.port == 50020);
    CHECK(settings.surface == protocol.tracker.surface);
    CHECK_FALSE(settings.surface_place);
    protocol.tracker.address = "10.1.2.3:5555";
    protocol.tracker.surface = "monitor";
    protocol.tracker.least_confidence = 0.35;
    protocol.display.output = OutputMode::native_8bit;
    protocol.display.tags_px = 200; // the tags' black borders end 20 px from the edges of 1920 x 1080
    settings = pupil_settings_of(protocol);
    CHECK(settings.remote.host == "10.1.2.3");
    CHECK(settings.remote.port == 5555);
    CHECK(settings.surface == "monitor");
    CHECK(settings.least_confidence == 0.35);
    REQUIRE(settings.surface_place);
    const ScreenPoint top_right = settings.surface_place->on_screen({1.0, 1.0}),
                      low = settings.surface_place->on_screen({0.25, 0.0});
    CHECK((top_right.x_px == 1900.0 && top_right.y_px == 20.0));
    CHECK((low.x_px == 490.0 && low.y_px == 1060.0));
}
