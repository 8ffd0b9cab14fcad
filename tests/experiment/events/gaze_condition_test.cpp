/// Gaze that is waited for comes true at the very sample that it should.
#include <catch2/catch.hpp>

#include <vector>

#include "experiment/base/random.h"
#include "experiment/events/gaze_condition.h"

using namespace overt;

namespace {

using us = TrackerClock::duration;

/// 2000 Hz, 200 ms in one piece, blinks up to 300 ms.
constexpr GazeCondition::Settings usual{us(200'000), us(300'000), us(500)};

/// What a sample is: inside, outside, lost, or lacking.
std::vector<WatchedSample> samples_of(std::string_view what, int each = 1) {
    std::vector<WatchedSample> samples;
    std::int64_t at = 1'000'000;
    for (const char one : what)
        for (int i = 0; i < each; ++i, at += 500)
            if (one != ' ')
                samples.push_back({tracker_time(at), one != '-', one == 'i'});
    return samples;
}

/// Index of the sample at which it comes true; -1: at none.
int true_at(const GazeCondition::Settings& settings, const std::vector<WatchedSample>& samples,
            GazeCondition* left = nullptr) {
    GazeCondition condition(settings);
    int at = -1;
    for (std::size_t i = 0; i < samples.size() && at < 0; ++i)
        if (condition.take(samples[i]))
            at = static_cast<int>(i);
    if (left)
        *left = condition;
    return at;
}

} // namespace

TEST_CASE("gaze that stays long enough comes true at the first sample by which it did", "[unit]") {
    // 400 intervals of 0.5 ms are 200 ms: the 401st sample inside.
    GazeCondition condition(usual);
    CHECK(true_at(usual, samples_of("oi", 1000), &condition) == 1000 + 400);
    CHECK(condition.onset() == tracker_time(1'500'000));
    CHECK(condition.detected() == tracker_time(1'700'000));
    // One sample short.
    CHECK(true_at(usual, samples_of(std::string(400, 'i') + "o")) == -1);
    // No time: a single sample.
    CHECK(true_at({us(0), us(0), us(500)}, samples_of("ooi")) == 2);
}

TEST_CASE("a single sample outside breaks the piece, and the next begins anew", "[unit]") {
    const std::string piece(400, 'i');
    CHECK(true_at(usual, samples_of(piece + "o" + piece)) == -1);
    GazeCondition condition(usual);
    CHECK(true_at(usual, samples_of(piece + "o" + piece + "i"), &condition) == 801);
    CHECK(condition.onset() == tracker_time(1'000'000 + 401 * 500));
}

TEST_CASE("a blink up to the stated length neither counts nor breaks, and a longer one breaks", "[unit]") {
    const GazeCondition::Settings short_blinks{us(10'000), us(5'000), us(500)}; // 20 intervals; 10 intervals
    const std::string half(11, 'i');                                            // 10 intervals
    // From the last sample before to the first after it are 5 ms: nine are lost.
    GazeCondition condition(short_blinks);
    const auto blinked = samples_of(half + std::string(9, '-') + half);
    CHECK(true_at(short_blinks, blinked, &condition) == static_cast<int>(blinked.size()) - 1);
    CHECK(condition.onset() == blinked.front().at);
    CHECK(true_at(short_blinks, samples_of(half + std::string(10, '-') + half)) == -1);
    // The same of samples that are lacking, as a link loses them.
    const auto lacking = samples_of(half + std::string(9, ' ') + half);
    CHECK(true_at(short_blinks, lacking) == static_cast<int>(lacking.size()) - 1);
    CHECK(true_at(short_blinks, samples_of(half + std::string(10, ' ') + half)) == -1);
    // Gaze that is elsewhere when the eye opens breaks it, however short the blink was.
    CHECK(true_at(short_blinks, samples_of(half + "--o--" + half)) == -1);
}

TEST_CASE("what comes after it came true changes nothing, and neither does the clock's origin", "[unit]") {
    RandomStream random(5, "gaze condition");
    for (int round = 0; round < 200; ++round) {
        std::string what;
        while (what.size() < 2000)
            what += std::string(1 + random.below(60), "ioi-"[random.below(4)]);
        const GazeCondition::Settings settings{us(500 * random.below(80)), us(500 * random.below(20)),
                                               us(500)};
        const auto samples = samples_of(what);
        GazeCondition whole(settings);
        for (const WatchedSample& sample : samples)
            whole.take(sample);
        GazeCondition stopped(settings);
        const int at = true_at(settings, samples, &stopped);
        CHECK(whole.is_true() == (at >= 0));
        CHECK(whole.onset() == stopped.onset());
        CHECK(whole.detected() == stopped.detected());
        auto moved = samples;
        for (WatchedSample& sample : moved)
            sample.at += us(123'456'789);
        CHECK(true_at(settings, moved) == at);
    }
}
