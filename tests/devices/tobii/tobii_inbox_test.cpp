// What Tobii's library tells, by callbacks that the test itself makes.
#include "devices/tobii/tobii_inbox.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "tests/devices/tobii/tobii_bench.h"
#include "tests/devices/tracker/row_parts.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// What is subscribed to, by its name: callback, what is given to it, and of which tracker.
struct NotedSubscription {
    void* callback = nullptr;
    void* user = nullptr;
    TobiiEyeTracker* tracker = nullptr;
};
std::map<std::string, NotedSubscription> subscribed;
std::vector<std::string> wrongly_ended;
std::string refused_subscription;

template <class Callback>
TobiiStatus noted(const char* name, TobiiEyeTracker* tracker, Callback callback, void* user) {
    if (refused_subscription == name)
        return 218;
    subscribed[name] = {reinterpret_cast<void*>(callback), user, tracker};
    return tobii_ok;
}
template <class Callback> TobiiStatus ended(const char* name, TobiiEyeTracker* tracker, Callback callback) {
    const auto at = subscribed.find(name);
    if (at == subscribed.end())
        return 213;
    if (at->second.callback != reinterpret_cast<void*>(callback) || at->second.tracker != tracker)
        wrongly_ended.emplace_back(name);
    subscribed.erase(at);
    return tobii_ok;
}

struct InboxBench {
    explicit InboxBench(int version = 2, std::size_t room = 8) : inbox(version, room) {
        subscribed.clear();
        wrongly_ended.clear();
        refused_subscription.clear();
        library.subscribe_to_gaze = [](auto t, auto c, auto u) { return noted("gaze", t, c, u); };
        library.subscribe_to_time_sync = [](auto t, auto c, auto u) { return noted("time", t, c, u); };
        library.subscribe_to_signals = [](auto t, auto c, auto u) { return noted("port", t, c, u); };
        library.subscribe_to_stream_errors = [](auto t, auto c, auto u) { return noted("errors", t, c, u); };
        library.subscribe_to_notifications = [](auto t, auto c, auto u) { return noted("news", t, c, u); };
        library.unsubscribe_from_gaze = [](auto t, auto c) { return ended("gaze", t, c); };
        library.unsubscribe_from_time_sync = [](auto t, auto c) { return ended("time", t, c); };
        library.unsubscribe_from_signals = [](auto t, auto c) { return ended("port", t, c); };
        library.unsubscribe_from_stream_errors = [](auto t, auto c) { return ended("errors", t, c); };
        library.unsubscribe_from_notifications = [](auto t, auto c) { return ended("news", t, c); };
    }
    void open(bool has_port = true) { inbox.open(library, tracker, has_port); }
    template <class Data> void tell(const char* name, const Data& data) {
        const NotedSubscription& to = subscribed.at(name);
        reinterpret_cast<void (*)(const void*, void*)>(to.callback)(&data, to.user);
    }
    void notify(int kind, const std::string& text = {}) {
        TobiiNotification told{};
        told.kind = kind;
        text.copy(told.value, sizeof told.value);
        tell("news", told);
    }
    /// What is told of one notification: lost, dropped, and complaints.
    std::string effect_of(int kind) {
        open();
        notify(kind, "it is hot");
        std::string effect = inbox.is_connection_lost() ? "lost " : "";
        for (TobiiNews news; inbox.next(news);)
            effect += std::holds_alternative<TobiiDropped>(news) ? "dropped " : "other ";
        for (const std::string& each : inbox.take_complaints())
            effect += each;
        inbox.close(library, tracker);
        return effect;
    }

    int place = 0;
    TobiiEyeTracker* tracker = reinterpret_cast<TobiiEyeTracker*>(&place);
    TobiiLibrary library = *load_tobii(OVERT_STAND_IN_TOBII);
    TobiiInbox inbox;
};

template <class Origin> TobiiGaze<Origin> gaze_told() {
    TobiiGaze<Origin> told{};
    told.device_us = 77;
    told.left.gaze = {{0.25f, 0.5f}, {}, 1};
    told.left.pupil = {3.5f, 1};
    told.left.origin.in_user_mm = {1.0f, 2.0f, 3.0f};
    told.left.origin.validity = 1;
    told.right = told.left;
    told.right.gaze.on_display = {0.75f, 0.125f};
    return told;
}

template <class Origin> void check_gaze(int version) {
    InboxBench bench(version);
    REQUIRE(bench.inbox.begin_gaze(bench.library, bench.tracker) == tobii_ok);
    for (int without = 0; without < 8; ++without) {
        auto told = gaze_told<Origin>();
        told.right.gaze.validity = (without & 1) != 0 ? 0 : 1;
        told.right.pupil.validity = (without & 2) != 0 ? 0 : 1;
        told.right.origin.validity = (without & 4) != 0 ? 2 : 1;
        bench.tell("gaze", told);
        TobiiNews news;
        REQUIRE(bench.inbox.next(news));
        const auto& measured = std::get<TobiiMeasurement>(news);
        CHECK(measured.device_us == 77);
        CHECK(measured.eyes[0].on_display->x == 0.25f);
        CHECK(measured.eyes[0].on_display->y == 0.5f);
        CHECK(measured.eyes[0].pupil_mm == 3.5f);
        CHECK(measured.eyes[0].eye_mm->z == 3.0f);
        CHECK(measured.eyes[1].on_display.has_value() == ((without & 1) == 0));
        CHECK(measured.eyes[1].pupil_mm.has_value() == ((without & 2) == 0));
        CHECK(measured.eyes[1].eye_mm.has_value() == ((without & 4) == 0));
        if (measured.eyes[1].on_display)
            CHECK(measured.eyes[1].on_display->x == 0.75f);
    }
    bench.inbox.end_gaze(bench.library, bench.tracker);
    CHECK(subscribed.empty());
    CHECK(wrongly_ended.empty());
}

} // namespace

TEST_CASE("each version's notifications have their own numbers", "[unit]") {
    const std::string fault = "the tracker tells of a fault: it is hot",
                      warning = "the tracker tells of a warning: it is hot";
    InboxBench of_1(1), of_2(2);
    for (int kind = 0; kind <= 12; ++kind) {
        CAPTURE(kind);
        CHECK(of_1.effect_of(kind) == (kind == 0 ? "lost " : kind == 9 ? fault : kind == 10 ? warning : ""));
        CHECK(of_2.effect_of(kind) == (kind == 0    ? "lost "
                                       : kind == 8  ? fault
                                       : kind == 9  ? warning
                                       : kind == 10 ? "dropped "
                                                    : ""));
    }
}

TEST_CASE("both versions' gaze is what is valid of each eye", "[unit]") {
    check_gaze<TobiiOrigin1>(1);
    check_gaze<TobiiOrigin2>(2);
}

TEST_CASE("a Tobii's complaints are kept once each, twenty of them", "[unit]") {
    InboxBench bench;
    bench.open();
    bench.tell("errors", TobiiStreamError{5, 1, 0, nullptr});
    bench.tell("errors", TobiiStreamError{6, 1, 0, nullptr});
    CHECK_FALSE(bench.inbox.is_connection_lost());
    bench.tell("errors", TobiiStreamError{7, 2, 0, "the cable"});
    bench.notify(8, std::string(600, 'x')); // fills its place, without an end
    CHECK(bench.inbox.take_complaints() ==
          std::vector<std::string>{"the tracker's stream had an error: it does not say which",
                                   "the tracker's stream had an error: the cable",
                                   "the tracker tells of a fault: " + std::string(512, 'x')});
    CHECK(bench.inbox.take_complaints().empty());
    for (int i = 0; i < 30; ++i)
        bench.notify(8, std::to_string(i));
    const auto kept = bench.inbox.take_complaints();
    REQUIRE(kept.size() == 20);
    CHECK(kept.back() == "the tracker tells of a fault: 19");
    bench.tell("errors", TobiiStreamError{8, tobii_stream_connection_lost, 0, "gone"});
    CHECK(bench.inbox.is_connection_lost());
    bench.open(); // it was reached again
    CHECK_FALSE(bench.inbox.is_connection_lost());
}

TEST_CASE("a full inbox counts the measurements that it has no place for, and keeps 64 readings of clocks",
          "[unit]") {
    InboxBench bench;
    bench.open();
    bench.inbox.begin_gaze(bench.library, bench.tracker);
    for (int i = 0; i < 3; ++i)
        bench.tell("port", TobiiSignal{i, 0, 6, i == 0 ? 1 : i == 1 ? 0 : 2});
    for (int i = 0; i < 8; ++i)
        bench.tell("gaze", gaze_told<TobiiOrigin2>());
    bench.tell("port", TobiiSignal{4, 0, 9, 0});
    bench.notify(10);
    CHECK(bench.inbox.take_overflow() == 3);
    CHECK(bench.inbox.take_overflow() == 0);
    for (int i = 0; i < 3; ++i) {
        TobiiNews news;
        REQUIRE(bench.inbox.next(news));
        const auto& port = std::get<TobiiPort>(news);
        CHECK(port.device_us == i);
        CHECK(port.value == 6);
        CHECK(port.is_initial == (i == 0));
    }
    for (int i = 0; i < 9; ++i)
        bench.tell("gaze", gaze_told<TobiiOrigin2>());
    bench.inbox.forget_news();
    TobiiNews news;
    CHECK_FALSE(bench.inbox.next(news));
    CHECK(bench.inbox.take_overflow() == 0);
    const auto tell_times = [&] {
        for (int i = 0; i < 70; ++i)
            bench.tell("time", TobiiTimeSync{i, i + 1, i + 2});
    };
    tell_times();
    TobiiTimeSync sync{};
    for (int i = 0; i < 64; ++i) {
        REQUIRE(bench.inbox.next(sync));
        CHECK(sync.request_system_us == i);
        CHECK(sync.device_us == i + 1);
        CHECK(sync.response_system_us == i + 2);
    }
    CHECK_FALSE(bench.inbox.next(sync));
    tell_times();
    bench.inbox.close(bench.library, bench.tracker);
    CHECK_FALSE(bench.inbox.next(sync));
    CHECK(subscribed.empty());
    CHECK(wrongly_ended.empty());
}

TEST_CASE("each subscription that a Tobii refuses is named, and no other is left", "[unit]") {
    const std::pair<std::string, std::string> all[] = {{"errors", "errors of its streams"},
                                                       {"news", "what happens to it"},
                                                       {"time", "the time"},
                                                       {"port", "its input port"}};
    for (const auto& [name, words] : all) {
        InboxBench bench;
        refused_subscription = name;
        CHECK_THROWS_WITH(bench.open(), Contains("does not tell " + words + " (error 218"));
        CHECK(subscribed.empty());
        CHECK(wrongly_ended.empty());
    }
    InboxBench bench;
    bench.open(false);
    CHECK(subscribed.size() == 3);
    CHECK_FALSE(subscribed.contains("port"));
}

TEST_CASE("each status of Tobii's library that an operator can do something about is said in words",
          "[unit]") {
    const std::pair<int, const char*> words[] = {
        {2, "could not be initialized"},  {14, "area is not set"},      {18, "may have expired"},
        {201, "needs a licence"},         {202, "cannot do it"},        {203, "is not available"},
        {204, "connection failed"},       {205, "did not answer"},      {210, "calibration is under way"},
        {215, "another program uses"},    {216, "busy with a calibra"}, {218, "too many programs"},
        {220, "firmware does not answer"}};
    for (const auto& [status, text] : words)
        CHECK_THAT(describe_tobii_status(status),
                   Catch::StartsWith(fmt::format("error {}: ", status)) && Contains(text));
    for (const int other : {0, 1, 3, 13, 15, 17, 19, 200, 206, 219, 221, 999})
        CHECK(describe_tobii_status(other) == fmt::format("error {}", other));
}

TEST_CASE("what a Tobii does not tell is said, with the library's error", "[unit]") {
    TobiiBench bench;
    bench.library.set("capabilities_status", 205);
    CHECK_THROWS_WITH(bench.connect(), Contains("does not tell what it can do (error 205"));
    bench.library.set("capabilities_status", 0);
    for (const auto& [name, value] :
         {std::pair("frequencies_status", 205), {"frequencies", 0}, {"frequencies", -1}}) {
        bench.library.set(name, value);
        CHECK_THROWS_WITH(bench.connect(), Contains("does not tell its sampling rates (error"));
        bench.library.set("frequencies_status", 0);
        bench.library.set("frequencies", 5);
    }
    bench.library.set("told_rate_status", 205);
    CHECK_THROWS_WITH(bench.connect(), Contains("does not tell its sampling rate (error 205"));
    bench.library.set("told_rate_status", 0);
    bench.library.set("frequencies", 1); // 60 Hz alone
    CHECK(bench.connect().sample_rate_hz == 60.0);
}

TEST_CASE("a reading of a Tobii's clock that cannot be is none", "[unit]") {
    TobiiBench bench;
    const auto reads = [&](double asked_before_us, double answered_before_us, int status) {
        bench.library.set("asked_before_us", asked_before_us);
        bench.library.set("answered_before_us", answered_before_us);
        bench.library.set("clock_status", status);
        bench.connect();
        return bench.driver->read_clocks().has_value();
    };
    CHECK(reads(300, 0, 0));
    CHECK(reads(300, 300, 0));
    CHECK_FALSE(reads(300, 301, 0));         // answered before it was asked
    CHECK_FALSE(reads(300, -60'000'000, 0)); // in a minute
    CHECK_FALSE(reads(300, 0, 203));
}

TEST_CASE("the row of Tobii's trackers takes device and targets from the protocol", "[unit]") {
    StandInLibrary library(OVERT_STAND_IN_TOBII);
    setenv("OVERT_TOBII_LIBRARY", OVERT_STAND_IN_TOBII, 1);
    SteadyClock clock;
    RowParts parts;
    parts.clock = &clock;
    parts.protocol.tracker.address = "tet-tcp://10.0.0.7";
    parts.protocol.calibration.points = 5;
    parts.protocol.calibration.target_deg = 0.75;
    const auto driver = parts.driver<kind_called<TrackerKind>("tobii")>();
    TrackerWish wish;
    CHECK_THAT(driver->connect(wish).model, Contains("SER3"));
    DiarySetupScreen screen(clock);
    CHECK(driver->set_up(screen).method == "tracker, 5 points");
    CHECK(std::ranges::count_if(screen.diary,
                                [](const std::string& each) { return each.ends_with(" of 0.75"); }) == 5);
    library.set("devices", 2);
    CHECK(tobii_trackers_found() == "its library is there, version 2.11.7; trackers that it finds: Glass "
                                    "9000 SER1 at tet-tcp://10.0.0.1, "
                                    "Glass 9000 SER2 at tet-tcp://10.0.0.2");
    unsetenv("OVERT_TOBII_LIBRARY");
}
