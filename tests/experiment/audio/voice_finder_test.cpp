/// Voices, clocks and faults of recordings whose truth is known.
#include "experiment/audio/voice_finder.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/audio/sample_clock.h"
#include "experiment/base/random.h"

using namespace overt;

namespace {

/// A tone with the harmonics of a voice in noise, from `begin_s` to `end_s`.
std::vector<float> sound_with_voice(double noise_dbfs, double voice_dbfs, double begin_s, double end_s,
                                    double duration_s, double rate_hz, std::uint64_t seed) {
    RandomStream random(seed, "noise");
    const double noise = std::pow(10.0, noise_dbfs / 20.0), voice = std::pow(10.0, voice_dbfs / 20.0);
    std::vector<float> sound(static_cast<std::size_t>(duration_s * rate_hz));
    for (std::size_t i = 0; i < sound.size(); ++i) {
        const double at_s = static_cast<double>(i) / rate_hz, since_s = at_s - begin_s;
        double value = noise * random.normal();
        if (at_s >= begin_s && at_s < end_s)
            for (int harmonic = 1; harmonic <= 8; ++harmonic)
                value += 0.5 * voice * std::sin(2.0 * std::numbers::pi * 130.0 * harmonic * since_s);
        sound[i] = static_cast<float>(std::clamp(value, -1.0, 1.0));
    }
    return sound;
}

} // namespace

TEST_CASE("the onset of a voice is found within 10 ms, in rooms from silent to noisy", "[unit]") {
    for (const double rate_hz : {16000.0, 44100.0, 48000.0}) {
        for (const double noise_dbfs : {-90.0, -70.0, -55.0, -45.0, -38.0}) {
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                const double begin_s = 0.4 + 0.137 * static_cast<double>(seed), end_s = begin_s + 0.9;
                CAPTURE(rate_hz, noise_dbfs, seed);
                VoiceFinder finder(rate_hz);
                finder.add(sound_with_voice(noise_dbfs, -24.0, begin_s, end_s, 3.0, rate_hz, seed));
                const auto voice = finder.voice();
                REQUIRE(voice);
                // Where the voice stands far above the noise, to the three milliseconds that tell it.
                CHECK(std::abs(voice->begin / rate_hz - begin_s) < (noise_dbfs <= -55.0 ? 0.003 : 0.010));
                CHECK(std::abs(voice->end / rate_hz - end_s) < 0.025);
                CHECK(finder.noise_dbfs() == Approx(noise_dbfs).margin(1.0));
                CHECK(finder.clipped_samples() == 0);
            }
        }
    }
}

TEST_CASE("a voice is found, too, that speaks from soon after the question to the end", "[unit]") {
    VoiceFinder finder(48000.0);
    finder.add(sound_with_voice(-60.0, -20.0, 0.3, 8.0, 8.0, 48000.0, 2));
    REQUIRE(finder.voice());
    CHECK(std::abs(finder.voice()->begin / 48000.0 - 0.3) < 0.010);
}

TEST_CASE("noise, hum, clicks and silence are no voice", "[unit]") {
    const double rate_hz = 48000.0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        VoiceFinder noise(rate_hz);
        noise.add(sound_with_voice(-50.0, -20.0, 0.0, 0.0, 5.0, rate_hz, seed));
        CHECK_FALSE(noise.voice());
    }
    VoiceFinder silence(rate_hz);
    silence.add(std::vector<float>(48000));
    CHECK_FALSE(silence.voice());
    CHECK(silence.peak_dbfs() < -100.0);
    VoiceFinder nothing(rate_hz);
    CHECK_FALSE(nothing.voice());
    std::vector<float> knocked = sound_with_voice(-60.0, -20.0, 0.0, 0.0, 3.0, rate_hz, 1);
    for (std::size_t i = 48000; i < 48000 + 480; ++i) // 10 ms
        knocked[i] = 0.5f;
    VoiceFinder knock(rate_hz);
    knock.add(knocked);
    CHECK_FALSE(knock.voice());
    // A microphone that gives a direct current, which begins with a step.
    std::vector<float> offset = sound_with_voice(-60.0, -20.0, 1.0, 2.0, 3.0, rate_hz, 1);
    for (float& sample : offset)
        sample += 0.1f;
    VoiceFinder with_offset(rate_hz);
    with_offset.add(offset);
    REQUIRE(with_offset.voice());
    CHECK(std::abs(with_offset.voice()->begin / rate_hz - 1.0) < 0.010);
}

TEST_CASE("what is found does not depend on how the sound is cut into blocks", "[unit]") {
    const auto sound = sound_with_voice(-60.0, -20.0, 0.7, 1.5, 2.0, 48000.0, 3);
    VoiceFinder whole(48000.0), pieces(48000.0);
    whole.add(sound);
    RandomStream random(1, "cuts");
    for (std::size_t at = 0; at < sound.size();) {
        const std::size_t count = std::min<std::size_t>(random.below(700), sound.size() - at);
        pieces.add(std::span(sound).subspan(at, count));
        at += count;
    }
    REQUIRE(whole.voice());
    CHECK(pieces.voice()->begin == whole.voice()->begin);
    CHECK(pieces.voice()->end == whole.voice()->end);
}

TEST_CASE("samples at full scale are counted in runs, a single one is none", "[unit]") {
    VoiceFinder finder(48000.0);
    finder.add(std::vector<float>{0.0f, 1.0f, 0.5f, 1.0f, 1.0f, 1.0f, 0.0f, -1.0f, -1.0f, 1.0f, -1.0f});
    CHECK(finder.clipped_samples() == 5);
}

TEST_CASE("the sample at a time is found to less than a tenth of a millisecond through jitter and drift",
          "[unit]") {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        RandomStream random(seed, "stamps");
        const double true_rate_hz = 48000.0 * (1.0 + 1e-6 * random.uniform(-150.0, 150.0));
        const SessionTime begun{std::chrono::hours(3)};
        SampleClock clock(48000.0);
        for (int block = 0; block < 1000; ++block)
            clock.add(256 * block,
                      begun + from_seconds(256.0 * block / true_rate_hz + random.uniform(-1e-3, 1e-3)));
        const double at_s = random.uniform(0.0, 5.0);
        const auto place = clock.sample_at(begun + from_seconds(at_s));
        CAPTURE(seed, place.sample, at_s * true_rate_hz);
        const double off_s = std::abs(place.sample - at_s * true_rate_hz) / true_rate_hz;
        CHECK(off_s < 1e-4);
        CHECK(off_s < 2.0 * to_seconds(place.uncertainty));
        CHECK(to_seconds(place.uncertainty) < 3e-4);
        CHECK(clock.rate_hz() == Approx(true_rate_hz).epsilon(60e-6));
    }
}

TEST_CASE("blocks that were handed over late do not move the line", "[unit]") {
    RandomStream random(4, "late");
    SampleClock clock(48000.0);
    for (int block = 0; block < 600; ++block) {
        const bool is_late = random.uniform() < 0.1;
        const double off_s = random.uniform(-2e-4, 2e-4) + (is_late ? random.uniform(5e-3, 5e-2) : 0.0);
        clock.add(256 * block, SessionTime{} + from_seconds(256.0 * block / 48001.0 + off_s));
    }
    const auto place = clock.sample_at(SessionTime{} + from_seconds(0.02));
    CHECK(std::abs(place.sample - 0.02 * 48001.0) < 5.0);
    CHECK(to_seconds(place.uncertainty) < 1e-4);
}

TEST_CASE("a rate that no crystal has is not believed", "[unit]") {
    SampleClock clock(48000.0);
    for (int block = 0; block < 300; ++block)
        clock.add(256 * block, SessionTime{} + from_seconds(256.0 * block / 37000.0));
    CHECK(clock.rate_hz() == 48000.0);
    // Nobody knows where the onset is, and that is said.
    CHECK(to_seconds(clock.sample_at(SessionTime{}).uncertainty) > 5e-3);
}

TEST_CASE("a recording too short to tell the rate takes the nominal one", "[unit]") {
    SampleClock clock(48000.0);
    clock.add(0, SessionTime{});
    CHECK(clock.sample_at(SessionTime{std::chrono::milliseconds(10)}).sample == Approx(480.0));
    clock.add(256, SessionTime{std::chrono::milliseconds(9)});
    CHECK(clock.rate_hz() == 48000.0);
}
