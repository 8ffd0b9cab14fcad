#include "devices/triggers/threaded_marker_sink.h"

#include <mutex>
#include <thread>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"

using namespace overt;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// What was done at an output, and when.
struct Deeds {
    struct Deed {
        SessionTime at;
        int code; ///< 0: at rest
        std::string text;
    };
    std::mutex mutex;
    std::vector<Deed> all;
    bool works = true;

    std::vector<Deed> so_far() {
        const std::scoped_lock lock(mutex);
        return all;
    }
};

class NotedOutput final : public MarkerOutput {
  public:
    NotedOutput(Deeds& deeds, const Clock& clock, bool needs_code)
        : deeds_(deeds), clock_(clock), needs_code_(needs_code) {}
    const std::string& name() const noexcept override { return name_; }
    bool needs_code() const noexcept override { return needs_code_; }
    bool send(const Marker& marker) noexcept override {
        const std::scoped_lock lock(deeds_.mutex);
        deeds_.all.push_back({clock_.now(), marker.code, std::string(marker.text)});
        return deeds_.works;
    }
    void rest() noexcept override {
        const std::scoped_lock lock(deeds_.mutex);
        deeds_.all.push_back({clock_.now(), 0, "rest"});
    }
    std::string fault() const override { return "unplugged"; }

  private:
    Deeds& deeds_;
    const Clock& clock_;
    bool needs_code_;
    std::string name_ = "noted output";
};

struct SinkBench {
    SteadyClock clock;
    Deeds deeds;

    std::unique_ptr<ThreadedMarkerSink> sink(MarkerPulse pulse, bool needs_code = true,
                                             std::size_t capacity = 4096) {
        return std::make_unique<ThreadedMarkerSink>(std::make_unique<NotedOutput>(deeds, clock, needs_code),
                                                    clock, pulse, capacity);
    }
};

std::vector<SentMarker> fates_of(MarkerSink& sink) {
    std::array<SentMarker, 8> some{};
    std::vector<SentMarker> all;
    for (std::size_t count = some.size(); count == some.size();) {
        count = sink.poll(some);
        all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return all;
}

} // namespace

TEST_CASE("pulses of an output last at least their length, with a rest between them, in order", "[unit]") {
    SinkBench bench;
    const auto sink = bench.sink({5ms, 2ms});
    for (int i = 1; i <= 20; ++i)
        sink->mark({bench.clock.now(), static_cast<std::uint8_t>(i % 2 == 0 ? 7 : i), "text"});
    CHECK(sink->finish().empty());
    const auto deeds = bench.deeds.so_far();
    REQUIRE(deeds.size() == 40);
    for (std::size_t i = 0; i < deeds.size(); i += 2) {
        const int number = static_cast<int>(i) / 2 + 1;
        CHECK(deeds[i].code == (number % 2 == 0 ? 7 : number));
        CHECK(deeds[i + 1].code == 0);
        CHECK(deeds[i + 1].at - deeds[i].at >= 5ms);
        if (i > 0)
            CHECK(deeds[i].at - deeds[i - 1].at >= 2ms);
    }
}

TEST_CASE("what poll tells of a marker holds when it really went out", "[unit]") {
    SinkBench bench;
    const auto sink = bench.sink({});
    std::vector<SessionTime> given;
    for (int i = 1; i <= 10; ++i) {
        given.push_back(bench.clock.now());
        sink->mark({given.back(), static_cast<std::uint8_t>(i), ""});
    }
    sink->finish();
    const auto fates = fates_of(*sink);
    const auto deeds = bench.deeds.so_far();
    REQUIRE(fates.size() == 10);
    for (std::size_t i = 0; i < fates.size(); ++i) {
        CHECK(fates[i].is_sent);
        CHECK(fates[i].code == i + 1);
        CHECK(fates[i].at == given[i]);
        CHECK(fates[i].not_before <= deeds[2 * i].at);
        CHECK(deeds[2 * i].at <= fates[i].not_after);
    }
    CHECK(fates_of(*sink).empty());
}

TEST_CASE("outputs of codes pass over markers that have none, outputs of text do not", "[unit]") {
    SinkBench bench;
    const std::string text(200, 'x');
    for (const bool needs_code : {true, false}) {
        const auto sink = bench.sink({0ms, 0ms}, needs_code);
        sink->mark({bench.clock.now(), 0, text});
        sink->finish();
        CHECK(fates_of(*sink).size() == (needs_code ? 0 : 1));
    }
    REQUIRE(bench.deeds.so_far().size() == 1); // without a pulse nothing is taken back
    CHECK(bench.deeds.so_far().front().text == text.substr(0, longest_marker));
}

TEST_CASE("an output that is gone is told with each marker and in the end", "[unit]") {
    SinkBench bench;
    bench.deeds.works = false;
    const auto sink = bench.sink({50ms, 50ms});
    for (int i = 1; i <= 3; ++i)
        sink->mark({bench.clock.now(), 1, ""});
    const auto said = sink->finish();
    REQUIRE(said.size() == 1);
    CHECK(said.front() == "noted output: 3 markers could not be sent: unplugged");
    CHECK(fates_of(*sink).size() == 3);
    CHECK_FALSE(bench.deeds.so_far().empty());
}

TEST_CASE("more markers than are held are counted, and none waits", "[unit]") {
    SinkBench bench;
    const auto sink = bench.sink({20ms, 0ms}, true, 4);
    for (int i = 0; i < 20; ++i)
        sink->mark({bench.clock.now(), 1, ""});
    const auto said = sink->finish();
    REQUIRE_FALSE(said.empty());
    CHECK_THAT(said.front(), Contains("went lost: too many at once"));
}

namespace {

/// Until so many deeds were done.
std::vector<Deeds::Deed> deeds_of(Deeds& deeds, std::size_t count) {
    for (int tries = 0; tries < 5000 && deeds.so_far().size() < count; ++tries)
        std::this_thread::sleep_for(1ms);
    return deeds.so_far();
}

} // namespace

TEST_CASE("a pulse lasts exactly its length, and the next one begins its rest later", "[unit]") {
    for (const bool works : {true, false}) {
        VirtualClock clock(SessionTime(10s));
        Deeds deeds;
        deeds.works = works;
        ThreadedMarkerSink sink(std::make_unique<NotedOutput>(deeds, clock, true), clock, {5ms, 2ms});
        for (int i = 1; i <= 3; ++i)
            sink.mark({SessionTime(9s), static_cast<std::uint8_t>(i), "m", 70 + i});
        const auto said = sink.finish();
        const auto all = deeds.so_far();
        const auto fates = fates_of(sink);
        REQUIRE(fates.size() == 3);
        CHECK(said.size() == (works ? 0u : 1u));
        // What could not be sent is not taken back, and takes no time.
        REQUIRE(all.size() == (works ? 6u : 3u));
        for (std::size_t i = 0; i < 3; ++i) {
            const SessionTime at = SessionTime(10s) + (works ? static_cast<int>(i) * 7ms : 0ms);
            const auto& deed = all[works ? 2 * i : i];
            CHECK(deed.at == at);
            CHECK(deed.code == static_cast<int>(i) + 1);
            CHECK(deed.text == "m");
            CHECK(fates[i].at == SessionTime(9s));
            CHECK(fates[i].not_before == at);
            CHECK(fates[i].not_after == at);
            CHECK(fates[i].number == 71 + static_cast<int>(i));
            CHECK(fates[i].is_sent == works);
            if (works)
                CHECK(all[2 * i + 1].at == at + 5ms);
        }
        CHECK(sink.finish().empty()); // it has ended
    }
}

TEST_CASE("what became of markers that nobody asked for is counted, and each sentence says of how many",
          "[unit]") {
    VirtualClock clock(SessionTime(10s));
    Deeds deeds;
    ThreadedMarkerSink sink(std::make_unique<NotedOutput>(deeds, clock, true), clock, {0ms, 0ms}, 4);
    for (std::size_t i = 1; i <= 6; ++i) {
        if (i == 6) {
            const std::scoped_lock lock(deeds.mutex);
            deeds.works = false;
        }
        sink.mark({clock.now(), 1, ""});
        CHECK(deeds_of(deeds, i).size() == i);
    }
    CHECK(sink.finish() ==
          std::vector<std::string>{"noted output: 1 marker could not be sent: unplugged",
                                   "noted output: when 2 markers went out is not known: nobody asked"});
    CHECK(fates_of(sink).size() == 4);
    // One that has not ended ends with its object, and sends what waits.
    Deeds others;
    {
        ThreadedMarkerSink other(std::make_unique<NotedOutput>(others, clock, true), clock, {1ms, 1ms});
        other.mark({clock.now(), 9, ""});
    }
    REQUIRE(others.so_far().size() == 2);
    CHECK(others.so_far()[0].code == 9);
    CHECK(others.so_far()[1].text == "rest");
}
