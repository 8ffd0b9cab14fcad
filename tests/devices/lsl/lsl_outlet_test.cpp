#include "devices/lsl/lsl_outlet.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "devices/lsl/lsl_inlet.h"
#include "devices/triggers/threaded_marker_sink.h"
#include "tests/devices/lsl/lsl_bench.h"
#include "tests/support/kept_items.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// A tracker whose every read gives what was put down for it.
class ScriptedTracker final : public TrackerDriver {
  public:
    std::vector<std::vector<TrackerItem>> reads;
    TrackerDescription connect(const TrackerWish& wish) override {
        return {"Scripted", 500.0, wish.eye, wish.both_eyes, "model 7"};
    }
    void start() override {}
    void stop() noexcept override {}
    RecordingState read(TrackerItemSink& sink, SessionTime) noexcept override {
        for (const TrackerItem& item : reads.at(next_))
            sink.put(item);
        ++next_;
        return RecordingState::running;
    }

    std::optional<ClockPair> read_clocks() noexcept override { return clocks; }
    std::optional<ClockPair> clocks;

  private:
    std::size_t next_ = 0;
};

GazeSample sample_of(Eye eye, int at_us, std::optional<ScreenPoint> gaze, float pupil) {
    GazeSample sample;
    sample.eye = eye;
    sample.sampled_at = tracker_time(at_us);
    sample.gaze = gaze;
    sample.pupil_area = pupil;
    return sample;
}

} // namespace

TEST_CASE("markers become a stream of text, stamped with the time of what they mark", "[unit]") {
    LslBench bench;
    const auto library = load_lsl(LslBench::library());
    {
        ThreadedMarkerSink sink(std::make_unique<LslMarkerOutlet>(library, "s01", bench.clock), bench.clock,
                                {0ms, 0ms});
        REQUIRE(bench.fake().sent.size() == 1);
        const double offset_s = library->local_clock() - to_seconds(bench.clock.now());
        const SessionTime at = bench.clock.now() - 100s;
        sink.mark({at, 3, "ONSET runner/smooth"});
        sink.mark({at, 200, ""});
        CHECK(sink.finish().empty());
        const FakeStream& stream = *bench.fake().sent.front();
        CHECK(stream.name == "overt");
        CHECK(stream.type == "Markers");
        CHECK(stream.channels == 1);
        CHECK(stream.format == 3);
        CHECK(stream.rate_hz == 0.0);
        CHECK(stream.source == "overt s01");
        REQUIRE(stream.pushed.size() == 2);
        CHECK(stream.pushed[0].text == "ONSET runner/smooth");
        CHECK(stream.pushed[1].text == "200");
        // The time that it is about, and not that of its sending.
        CHECK(std::abs(stream.pushed[0].time_s - (to_seconds(at) + offset_s)) < 20.0);
    }
    CHECK(bench.fake().outlets == 0);
    CHECK(bench.fake().infos == 0);
}

TEST_CASE("a relayed tracker gives what it gave, and its samples are a stream of gaze as well", "[unit]") {
    LslBench bench;
    auto tracker = std::make_unique<ScriptedTracker>();
    SampleDetail detail;
    detail.eye = Eye::right;
    detail.sampled_at = tracker_time(2000);
    detail.confidence = 0.75f;
    tracker->reads = {{sample_of(Eye::left, 2000, ScreenPoint{1.0, 2.0}, 3.0f),
                       sample_of(Eye::right, 2000, std::nullopt, 0.0f), detail,
                       sample_of(Eye::left, 4000, ScreenPoint{5.0, 6.0}, 3.5f),
                       sample_of(Eye::right, 4000, ScreenPoint{7.0, 8.0}, 4.5f)},
                      {},
                      {TrackerGap{}, sample_of(Eye::left, 6000, std::nullopt, 0.0f)}};
    LslGazeRelay relay(std::move(tracker), load_lsl(LslBench::library()), "s01", bench.clock);
    TrackerWish wish;
    wish.both_eyes = true;
    CHECK(relay.connect(wish).model == "model 7");
    KeptItems items;
    for (int i = 0; i < 3; ++i)
        relay.read(items, SessionTime());
    CHECK(items.items.size() == 7);
    const FakeStream& stream = *bench.fake().sent.back();
    CHECK(stream.name == "overt gaze");
    CHECK(stream.rate_hz == 500.0);
    REQUIRE(stream.pushed.size() == 3);
    const std::vector<double>& first = stream.pushed[0].values;
    CHECK(std::vector<double>(first.begin(), first.begin() + 3) == std::vector<double>{1.0, 2.0, 3.0});
    CHECK(std::isnan(first[4]));
    CHECK(first[7] == 0.75);
    CHECK(first[8] == 0.002);
    CHECK(stream.pushed[1].values[4] == 7.0);
    CHECK(std::isnan(stream.pushed[1].values[7])); // the confidence of the sample before is not this one's
    CHECK(std::isnan(stream.pushed[2].values[0]));
    CHECK(stream.pushed[2].values[8] == 0.006);

    // What one sends another receives: the channels say what they are.
    bench.fake().network = {bench.fake().sent.back()};
    LslInletSettings settings;
    settings.library = LslBench::library();
    settings.patience = 100ms;
    LslInlet inlet(settings, bench.clock);
    CHECK_THROWS_WITH(inlet.connect(wish), Catch::Contains("sends nothing"));
}

TEST_CASE("what is sent on is stamped with when it was measured, and not with when it came", "[unit]") {
    LslBench bench;
    const auto library = load_lsl(LslBench::library());
    auto tracker = std::make_unique<ScriptedTracker>();
    ScriptedTracker& scripted = *tracker;
    // The tracker's clock is an hour ahead; what it measured came 100 s late.
    const SessionTime now = bench.clock.now();
    const auto tracker_time_of = [&](SessionTime at) {
        return tracker_time(
            std::chrono::duration_cast<TrackerClock::duration>(at.time_since_epoch()).count() +
            3'600'000'000);
    };
    GazeSample late = sample_of(Eye::right, 0, ScreenPoint{1.0, 2.0}, 3.0f);
    late.sampled_at = tracker_time_of(now - 100s);
    const ClockPair one_way{now - 50ms, tracker_time_of(now - 25ms), now};
    scripted.reads = {{late}, {late}, {one_way, late}};
    LslGazeRelay relay(std::move(tracker), library, "s01", bench.clock);
    relay.connect({});
    KeptItems items;
    relay.read(items, SessionTime()); // nothing is known of the clock yet
    scripted.clocks = ClockPair{now - 1ms, tracker_time_of(now), now + 1ms};
    CHECK(relay.read_clocks());
    relay.read(items, SessionTime());
    relay.connect({}); // another clock, for all that is known
    relay.read(items, SessionTime());
    const double offset_s = library->local_clock() - to_seconds(bench.clock.now());
    const double measured_s = to_seconds(now - 100s) + offset_s;
    std::vector<double> stamps_s;
    for (const auto& stream : bench.fake().sent)
        for (const FakeStream::Pushed& pushed : stream->pushed)
            stamps_s.push_back(pushed.time_s);
    REQUIRE(stamps_s.size() == 3);
    CHECK(stamps_s[0] > measured_s + 50.0);
    CHECK(std::abs(stamps_s[1] - measured_s) < 20.0);
    CHECK(std::abs(stamps_s[2] - measured_s) < 20.0);
}

TEST_CASE("a relayed stream says what it is, channel by channel", "[unit]") {
    LslBench bench;
    auto tracker = std::make_unique<ScriptedTracker>();
    LslGazeRelay relay(std::move(tracker), load_lsl(LslBench::library()), "s01", bench.clock);
    TrackerWish wish;
    wish.both_eyes = true;
    relay.connect(wish);
    FakeStream& stream = *bench.fake().sent.back();
    CHECK(stream.type == "Gaze");
    CHECK(stream.source == "overt gaze s01");
    CHECK(stream.channels == 9);
    CHECK(stream.format == 2);
    std::string told;
    for (const FakeXml& about : stream.desc.children) {
        told += about.name + (about.text.empty() ? "" : "=" + about.text) + "\n";
        for (const FakeXml& channel : about.children) {
            CHECK(channel.name == "channel");
            for (const FakeXml& property : channel.children)
                told += " " + property.name + "=" + property.text;
            told += "\n";
        }
    }
    std::string wanted = "manufacturer=Scripted\nmodel=model 7\nchannels\n";
    const auto channel = [&](const std::string& label, const std::string& eye, const char* type,
                             const char* unit) {
        wanted += fmt::format(" label={} eye={} type={} unit={} coordinate_system=screen\n", label, eye, type,
                              unit);
    };
    for (const std::string eye : {"left", "right"}) {
        channel(eye + "_x", eye, "ScreenX", "pixels");
        channel(eye + "_y", eye, "ScreenY", "pixels");
        channel(eye + "_pupil", eye, "Diameter", "tracker");
        channel(eye + "_confidence", eye, "Confidence", "");
    }
    channel("tracker_time", "both", "Time", "seconds");
    CHECK(told == wanted);
}

TEST_CASE("of two eyes of a relayed tracker each value stands in its own channel", "[unit]") {
    LslBench bench;
    auto tracker = std::make_unique<ScriptedTracker>();
    SampleDetail left, right;
    left.eye = Eye::left;
    left.sampled_at = right.sampled_at = tracker_time(2500);
    left.confidence = 0.25f;
    right.eye = Eye::right;
    right.confidence = 0.5f;
    SampleDetail late = left;
    late.sampled_at = tracker_time(2600); // of another sample
    late.confidence = 0.125f;
    tracker->reads = {{sample_of(Eye::left, 2400, ScreenPoint{1.0, 2.0}, 0.0f), // a pupil that is not known
                       sample_of(Eye::left, 2500, ScreenPoint{1.0, 2.0}, 3.0f), left,
                       sample_of(Eye::right, 2500, ScreenPoint{4.0, 5.0}, 6.0f), right, late}};
    LslGazeRelay relay(std::move(tracker), load_lsl(LslBench::library()), "s01", bench.clock);
    TrackerWish wish;
    wish.both_eyes = true;
    relay.connect(wish);
    KeptItems items;
    CHECK(relay.read(items, SessionTime()) == RecordingState::running);
    const FakeStream& stream = *bench.fake().sent.back();
    REQUIRE(stream.pushed.size() == 2);
    CHECK(stream.pushed[0].values[0] == 1.0);
    CHECK(std::isnan(stream.pushed[0].values[2]));
    CHECK(stream.pushed[1].values == std::vector<double>{1.0, 2.0, 3.0, 0.25, 4.0, 5.0, 6.0, 0.5, 0.0025});
}
