#include "devices/sound/beeper.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr double sound_rate_hz = 48000.0;

/// A second of it, in pieces as a sound system asks for them.
std::vector<float> second_of(BeepSound& sound) {
    std::vector<float> samples(48000);
    for (std::size_t at = 0; at < samples.size(); at += 480)
        sound.fill(std::span(samples).subspan(at, 480));
    return samples;
}

double length_of(Beep beep) {
    double length_s = 0.0;
    for (const BeepTone& tone : tones_of(beep))
        length_s += tone.length_s;
    return length_s;
}

/// Pitch by the times that the sound goes upward through zero.
double pitch_of(std::span<const float> samples) {
    int crossings = 0;
    for (std::size_t i = 1; i < samples.size(); ++i)
        crossings += samples[i - 1] < 0.0f && samples[i] >= 0.0f;
    return crossings * sound_rate_hz / static_cast<double>(samples.size());
}

} // namespace

TEST_CASE("beeps have their pitch and length, and none clicks", "[unit]") {
    for (const Beep beep :
         {Beep::target_appears, Beep::calibration_good, Beep::calibration_bad, Beep::drift_good,
          Beep::drift_bad, Beep::answered, Beep::correct, Beep::wrong, Beep::missed}) {
        BeepSound sound(sound_rate_hz);
        CHECK(second_of(sound)[100] == 0.0f);
        sound.start(beep);
        const std::vector<float> samples = second_of(sound);
        const double length_s = length_of(beep);
        CHECK(length_s > 0.05);
        const auto end = static_cast<std::size_t>(length_s * sound_rate_hz);
        for (std::size_t i = end + 1; i < samples.size(); ++i)
            REQUIRE(samples[i] == 0.0f);
        CHECK(sound.silent_samples() >= static_cast<std::int64_t>(samples.size() - end - 2));
        // The steepest step of a sine of 1200 Hz and 0.3 of full scale is 0.047; a click is larger.
        for (std::size_t i = 1; i < samples.size(); ++i)
            REQUIRE(std::abs(samples[i] - samples[i - 1]) < 0.05f);
        const BeepTone first = tones_of(beep).front();
        const auto tone = static_cast<std::size_t>(first.length_s * sound_rate_hz);
        CHECK(pitch_of(std::span(samples).first(tone)) ==
              Approx(first.pitch_hz).epsilon(0.03).margin(1.0 / first.length_s));
    }
    CHECK(tones_of(Beep::calibration_good).back().pitch_hz > tones_of(Beep::calibration_bad).back().pitch_hz);
}

TEST_CASE("a beep that begins ends the one before", "[unit]") {
    BeepSound sound(sound_rate_hz), other(sound_rate_hz);
    sound.start(Beep::calibration_bad);
    std::vector<float> begun(480), after(480), alone(480);
    sound.fill(begun);
    sound.start(Beep::target_appears);
    other.start(Beep::target_appears);
    sound.fill(after);
    other.fill(alone);
    CHECK(after == alone);
}

TEST_CASE("what is played comes out at the sound device, again after a rest", "[unit]") {
    // ALSA with a device that writes what it is given to a file: floats of one channel, as they are asked
    // for.
    const TemporaryFolder folder;
    const auto sound_file = folder.path() / "sound.raw";
    const auto settings =
        folder.file("asound.conf",
                    fmt::format("pcm.!default {{ type file slave.pcm \"null\" file \"{}\" format \"raw\" }}\n"
                                "pcm.null {{ type null }}\n",
                                sound_file.string()));
    setenv("ALSA_CONFIG_PATH", settings.c_str(), 1);
    const auto heard = [&] {
        std::ifstream stream(sound_file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        std::vector<float> samples(bytes.size() / sizeof(float));
        std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(float));
        return samples;
    };
    /// Runs of sound between 10 ms of silence or more, each as begin and end.
    const auto tones_in = [](const std::vector<float>& samples) {
        std::vector<std::pair<std::size_t, std::size_t>> runs;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (samples[i] == 0.0f)
                continue;
            if (runs.empty() || i - runs.back().second > 441)
                runs.emplace_back(i, i);
            runs.back().second = i;
        }
        return runs;
    };
    {
        Beeper beeper;
        CHECK_FALSE(beeper.name().empty());
        beeper.play(Beep::calibration_good);
        // Until it rests: the file grows no more.
        const auto wait_for_rest = [&](std::size_t tones) {
            std::size_t before = 0;
            for (int i = 0; i < 100; ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(200));
                const std::vector<float> now = heard();
                if (now.size() == before && tones_in(now).size() >= tones)
                    return;
                before = now.size();
            }
        };
        wait_for_rest(2);
        beeper.play(Beep::target_appears);
        wait_for_rest(3);
    }
    unsetenv("ALSA_CONFIG_PATH");
    const std::vector<float> samples = heard();
    const auto runs = tones_in(samples);
    REQUIRE(runs.size() == 3);
    const std::array<double, 3> ratios{1.0, 1.5, 1.0}; // of the pitches 800, 1200 and 800 Hz
    const auto pitch = [&](const auto& run) {
        return pitch_of(std::span(samples).subspan(run.first, run.second - run.first + 1));
    };
    for (std::size_t i = 0; i < runs.size(); ++i)
        CHECK(pitch(runs[i]) / pitch(runs[0]) == Approx(ratios[i]).epsilon(0.03));
}

TEST_CASE("a machine without a sound device says so", "[unit]") {
    try {
        Beeper beeper; // this machine may have one
        beeper.play(Beep::target_appears);
    } catch (const DeviceError& error) {
        CHECK_THAT(error.what(),
                   Catch::Contains("sound device that plays") || Catch::Contains("does not play"));
    }
}

TEST_CASE("each beep is made of the tones that its users know it by", "[unit]") {
    const auto words_of = [](Beep beep) {
        std::string words;
        for (const BeepTone& tone : tones_of(beep))
            words += fmt::format("{}{} Hz {} s", words.empty() ? "" : ", ", tone.pitch_hz, tone.length_s);
        return words;
    };
    CHECK(words_of(Beep::target_appears) == "800 Hz 0.08 s");
    for (const Beep good : {Beep::calibration_good, Beep::drift_good})
        CHECK(words_of(good) == "800 Hz 0.1 s, 0 Hz 0.03 s, 1200 Hz 0.15 s");
    for (const Beep bad : {Beep::calibration_bad, Beep::drift_bad})
        CHECK(words_of(bad) == "600 Hz 0.15 s, 0 Hz 0.05 s, 400 Hz 0.3 s");
    CHECK(words_of(Beep::answered) == "600 Hz 0.1 s");
    CHECK(words_of(Beep::correct) == "1200 Hz 0.1 s");
    CHECK(words_of(Beep::wrong) == "300 Hz 0.25 s");
    CHECK(words_of(Beep::missed) == "300 Hz 0.1 s, 0 Hz 0.05 s, 300 Hz 0.1 s");
    // Within 5 ms of both its ends a tone is faded, and else 0.3 of full scale.
    BeepSound sound(sound_rate_hz);
    sound.start(Beep::answered);
    std::vector<float> samples(4801);
    sound.fill(samples);
    for (std::size_t i = 0; i < 4800; ++i) {
        const double at_s = static_cast<double>(i) / sound_rate_hz, from_end_s = std::min(at_s, 0.1 - at_s);
        REQUIRE(samples[i] ==
                Approx(0.3 * std::min(1.0, from_end_s / 0.005) * std::sin(6.283185307179586 * 600.0 * at_s))
                    .margin(1e-5));
    }
    CHECK(samples[4800] == 0.0f);
    CHECK(sound.silent_samples() == 1);
}
