/// Spoken answers from a device to a file, with their place in time.
#include "devices/sound/answer_engine.h"

#include <cmath>
#include <csignal>
#include <fstream>
#include <thread>

#include <catch2/catch.hpp>
#include <sndfile.h>
#include <sys/wait.h>
#include <unistd.h>

#include "devices/host/clocks.h"
#include "devices/simulated/simulated_answer_recorder.h"
#include "devices/simulated/simulated_voice.h"
#include "devices/sound/answer_sink.h"
#include "experiment/base/content_hash.h"
#include "experiment/session/answer_check.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

struct Wav {
    SF_INFO info{};
    std::vector<float> samples;
};

Wav read_wav(const std::filesystem::path& file) {
    Wav wav;
    SNDFILE* const sound = sf_open(file.c_str(), SFM_READ, &wav.info);
    if (!sound)
        throw std::runtime_error(file.string() + ": " + sf_strerror(nullptr));
    wav.samples.resize(static_cast<std::size_t>(wav.info.frames));
    sf_read_float(sound, wav.samples.data(), wav.info.frames);
    sf_close(sound);
    return wav;
}

/// A device of this test's own thread, whose samples are their own numbers.
struct CountingDevice {
    SoundRing& ring;
    SessionTime begun;
    double rate_hz;
    std::int64_t next = 0;
    static float value_of(std::int64_t sample) { return static_cast<float>(sample % 30000) / 32768.0f; }
    void push(bool is_lost = false) {
        SoundBlock block;
        block.first_sample = next;
        block.at = begun + from_seconds(static_cast<double>(next) / rate_hz);
        block.count = SoundBlock::room;
        for (std::uint32_t i = 0; i < block.count; ++i)
            block.samples[i] = value_of(next + i);
        next += block.count;
        if (!is_lost)
            ring.try_push(block);
    }
    /// As time goes.
    void push_until(const Clock& clock, SessionTime until) {
        while (clock.now() < until) {
            while (begun + from_seconds(static_cast<double>(next + SoundBlock::room) / rate_hz) <=
                   clock.now())
                push();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
};

RecordedAnswer wait_for(AnswerRecording& recording) {
    for (int i = 0; i < 2000; ++i) {
        if (const auto answer = recording.result())
            return *answer;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    throw std::runtime_error("the answer never came");
}

} // namespace

TEST_CASE("the sample at the response screen's onset is the one that was taken then, to the sample",
          "[unit]") {
    const TemporaryFolder folder;
    SteadyClock clock;
    SoundRing ring(sound_ring_blocks);
    const double rate_hz = 16000.0;
    AnswerEngine engine(clock, ring, {"counting", 16000, 16, {}});
    engine.keep_in(folder.path());
    CountingDevice device{ring, clock.now(), rate_hz};
    device.push_until(clock, clock.now() + std::chrono::milliseconds(60));
    const auto recording = engine.begin({4, 0, {}});
    device.push_until(clock, clock.now() + std::chrono::milliseconds(40));
    const SessionTime onset = clock.now();
    recording->response_screen_lit(onset);
    device.push_until(clock, clock.now() + std::chrono::milliseconds(700));
    const SessionTime end = clock.now();
    recording->end(end);
    device.push_until(clock, clock.now() + std::chrono::milliseconds(60));
    const RecordedAnswer answer = wait_for(*recording);
    CHECK(answer.fault.empty());
    CHECK(answer.trial == 4);
    CHECK(answer.file == "answers/trial_05.wav");
    const Wav wav = read_wav(folder.path() / answer.file);
    CHECK(wav.info.format == (SF_FORMAT_WAV | SF_FORMAT_PCM_16));
    REQUIRE(static_cast<std::int64_t>(wav.samples.size()) == answer.samples);
    const double onset_in_device = to_seconds(onset - device.begun) * rate_hz;
    const auto index = static_cast<std::size_t>(std::lround(answer.onset_sample));
    REQUIRE(index < wav.samples.size());
    const double number = static_cast<double>(wav.samples[index]) * 32768.0;
    CHECK(std::abs(number - std::fmod(onset_in_device, 30000.0)) <= 1.5);
    // Nothing is missing at its end, however late it came.
    const double length_s = (static_cast<double>(wav.samples.size()) - answer.onset_sample) / rate_hz;
    CHECK(std::abs(length_s - to_seconds(end - onset)) < 2.0 / rate_hz);
    CHECK(answer.sha256 == hash_of_file(folder.path() / answer.file));
}

TEST_CASE("blocks that the ring lost leave a gap of their length, and are counted", "[unit]") {
    const TemporaryFolder folder;
    SteadyClock clock;
    SoundRing ring(sound_ring_blocks);
    AnswerEngine engine(clock, ring, {"counting", 48000, 24, {}});
    engine.keep_in(folder.path());
    const auto recording = engine.begin({0, 0, {}});
    CountingDevice device{ring, clock.now(), 48000.0};
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    for (int block = 0; block < 40; ++block)
        device.push(block >= 10 && block < 13);
    recording->response_screen_lit(device.begun);
    recording->end(device.begun + from_seconds(40.0 * 256.0 / 48000.0));
    const RecordedAnswer answer = wait_for(*recording);
    CHECK(answer.overruns == 1);
    CHECK(answer.lost_samples == 3 * 256);
    CHECK(answer.samples == 40 * 256);
    CHECK_FALSE(warnings_about(answer).empty());
    const Wav wav = read_wav(folder.path() / answer.file);
    CHECK(wav.info.format == (SF_FORMAT_WAV | SF_FORMAT_PCM_24));
    REQUIRE(wav.samples.size() == 40 * 256);
    int wrong = 0;
    for (std::int64_t i = 0; i < 40 * 256; ++i) {
        const bool is_gap = i >= 10 * 256 && i < 13 * 256;
        wrong += std::abs(wav.samples[static_cast<std::size_t>(i)] -
                          (is_gap ? 0.0f : CountingDevice::value_of(i))) > 1e-6f;
    }
    CHECK(wrong == 0);
}

TEST_CASE("answers have files of their own, and none ends another", "[unit]") {
    const TemporaryFolder folder;
    SteadyClock clock;
    SoundRing ring(sound_ring_blocks);
    AnswerEngine engine(clock, ring, {"counting", 48000, 16, {}});
    engine.keep_in(folder.path());
    CountingDevice device{ring, clock.now(), 48000.0};
    std::vector<std::string> names;
    for (int attempt = 0; attempt < 3; ++attempt) {
        const auto recording = engine.begin({7, 0, {}});
        const SessionTime onset = clock.now();
        recording->response_screen_lit(onset);
        device.push_until(clock, onset + std::chrono::milliseconds(70));
        // The end is told before its samples have come, as by a key.
        const SessionTime end = clock.now() + std::chrono::milliseconds(20);
        recording->end(end);
        device.push_until(clock, end + std::chrono::milliseconds(30));
        const RecordedAnswer answer = wait_for(*recording);
        names.push_back(answer.file);
        CHECK(static_cast<double>(answer.samples) - answer.onset_sample ==
              Approx(to_seconds(end - onset) * 48000.0).margin(2.0));
    }
    CHECK(names == std::vector<std::string>{"answers/trial_08.wav", "answers/trial_08_2.wav",
                                            "answers/trial_08_3.wav"});
}

TEST_CASE("a device that stops, and a folder that cannot be written to, end the answer and not the session",
          "[unit]") {
    const TemporaryFolder folder;
    SteadyClock clock;
    SoundRing ring(sound_ring_blocks);
    AnswerEngine engine(clock, ring, {"counting", 48000, 16, {}});
    engine.keep_in(folder.path());
    const auto silent = engine.begin({0, 0, {}});
    silent->end(clock.now());
    CHECK(wait_for(*silent).fault.find("gave nothing") != std::string::npos);
    folder.file("blocked", "a file where a folder should be");
    engine.keep_in(folder.path() / "blocked");
    const auto blocked = engine.begin({1, 0, {}});
    CHECK_FALSE(wait_for(*blocked).fault.empty());
}

TEST_CASE("a recorder that is killed leaves a file that can be heard up to there", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "killed.wav";
    int written[2];
    REQUIRE(::pipe(written) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
        WavFile wav(file, 48000, 16);
        const std::vector<float> block(256, 0.25f);
        for (int i = 0; i < 400; ++i)
            wav.write(block);
        char done = 1;
        if (::write(written[1], &done, 1) != 1)
            ::_exit(1);
        for (;;)
            ::pause();
    }
    char done = 0;
    REQUIRE(::read(written[0], &done, 1) == 1);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(written[0]);
    ::close(written[1]);
    const Wav wav = read_wav(file);
    CHECK(wav.samples.size() == 400 * 256);
    CHECK(wav.samples.back() == Approx(0.25f).margin(1e-4));
}

TEST_CASE("the voice of a simulated observer comes out of its file where it was put", "[unit]") {
    SimulatedSitting sitting(31);
    for (const double noise_dbfs : {-75.0, -60.0, -48.0}) {
        for (int trial = 0; trial < 4; ++trial) {
            CAPTURE(noise_dbfs, trial);
            const TemporaryFolder folder;
            SimulatedSoundSettings settings;
            settings.noise_dbfs = noise_dbfs;
            SimulatedAnswerRecorder recorder(sitting.clock, sitting.observer, 5, settings);
            recorder.keep_in(folder.path());
            const Trial asked{trial, 0, {}};
            const auto recording = recorder.begin(asked);
            const SessionTime onset = sitting.clock.now() + std::chrono::milliseconds(13);
            recording->response_screen_lit(onset);
            const SimulatedAnswer said = sitting.observer.answer_to(asked);
            recording->end(onset + said.after);
            const auto answer = recording->result();
            REQUIRE(answer);
            CHECK(answer->fault.empty());
            CHECK(warnings_about(*answer).empty());
            REQUIRE(answer->voice_onset);
            CHECK(std::abs(to_seconds(*answer->voice_onset - said.voice_after)) < 0.010);
            CHECK(answer->measured_rate_hz == Approx(48000.0 * 1.000025).epsilon(200e-6));
            CHECK(read_wav(folder.path() / answer->file).info.frames == answer->samples);
        }
    }
}

TEST_CASE("a voice that is too loud, and none at all, are said", "[unit]") {
    SimulatedSitting sitting(31);
    for (const bool is_loud : {true, false}) {
        const TemporaryFolder folder;
        SimulatedSoundSettings settings;
        settings.gain = is_loud ? 40.0 : 1e-3;
        settings.noise_dbfs = is_loud ? -60.0 : -40.0;
        SimulatedAnswerRecorder recorder(sitting.clock, sitting.observer, 5, settings);
        recorder.keep_in(folder.path());
        const auto recording = recorder.begin({0, 0, {}});
        recording->response_screen_lit(sitting.clock.now());
        recording->end(sitting.clock.now() + std::chrono::seconds(4));
        const auto answer = recording->result();
        REQUIRE(answer);
        const auto warnings = warnings_about(*answer);
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].find(is_loud ? "clipped" : "silent") == 0);
    }
}

TEST_CASE("an answer's level, peak, gaps and rate are those of its samples", "[unit]") {
    const TemporaryFolder folder;
    AnswerSink sink(folder.path(), free_answer_name(folder.path(), 2),
                    {"microphone", 8000, 16, from_seconds(0.01)});
    CHECK(free_answer_name(folder.path(), 2) == "answers/trial_03_2.wav");
    std::vector<float> block(800);
    for (std::size_t i = 0; i < block.size(); ++i)
        block[i] = i % 2 == 0 ? 0.25f : -0.25f;
    const SessionTime begun = SessionTime() + from_seconds(5.0);
    sink.add(block, begun);
    CHECK(sink.level().peak == 0.25f);
    CHECK(sink.level().rms == Approx(0.25f));
    CHECK_FALSE(sink.level().is_clipping);
    block[17] = -0.5f;
    sink.add(block, begun + from_seconds(0.1));
    CHECK(sink.level().peak == 0.5f);
    CHECK(sink.level().rms == Approx(std::sqrt((799.0 * 0.0625 + 0.25) / 800.0)));
    sink.add_gap(700);
    sink.count_overrun();
    block[17] = 0.25f;
    for (int i = 0; i < 20; ++i)
        sink.add(block, begun + from_seconds(0.2 + 0.0875 + 0.1 * i));
    sink.add({}, begun); // nothing
    const RecordedAnswer answer = sink.finish(begun + from_seconds(0.05), "the test ended");
    CHECK(answer.file == "answers/trial_03.wav");
    CHECK(answer.device == "microphone");
    CHECK(answer.sample_rate_hz == 8000.0);
    CHECK(answer.bits == 16);
    CHECK(answer.input_latency == from_seconds(0.01));
    CHECK(answer.samples == 22 * 800 + 700);
    CHECK(answer.overruns == 2);
    CHECK(answer.lost_samples == 700);
    CHECK(answer.peak_dbfs == Approx(20.0 * std::log10(0.5)).margin(0.01));
    CHECK(answer.clipped_samples == 0);
    CHECK(answer.fault == "the test ended");
    CHECK(answer.sha256 == hash_of_file(folder.path() / answer.file));
    CHECK(answer.measured_rate_hz == Approx(8000.0).epsilon(1e-6));
    CHECK(answer.onset_sample == Approx(400.0).margin(0.01));
    const Wav wav = read_wav(folder.path() / answer.file);
    REQUIRE(static_cast<std::int64_t>(wav.samples.size()) == answer.samples);
    CHECK(wav.info.samplerate == 8000);
    for (std::size_t i = 1600; i < 2300; ++i)
        REQUIRE(wav.samples[i] == 0.0f);
    CHECK(wav.samples[0] == Approx(0.25f).margin(1e-4));
    CHECK(wav.samples[817] == Approx(-0.5f).margin(1e-4));
    CHECK(wav.samples[2300] == Approx(0.25f).margin(1e-4));
}

TEST_CASE("samples at full scale clip, and the level says so as long as they come", "[unit]") {
    const TemporaryFolder folder;
    AnswerSink sink(folder.path(), free_answer_name(folder.path(), 0), {"microphone", 8000, 16, {}});
    std::vector<float> block(800, 0.1f);
    sink.add(block, SessionTime());
    CHECK_FALSE(sink.level().is_clipping);
    for (int i = 0; i < 5; ++i)
        block[static_cast<std::size_t>(100 + i)] = 1.0f;
    sink.add(block, SessionTime() + from_seconds(0.1));
    CHECK(sink.level().is_clipping);
    CHECK(sink.level().peak == 1.0f);
    block.assign(800, 0.1f);
    sink.add(block, SessionTime() + from_seconds(0.2));
    CHECK_FALSE(sink.level().is_clipping);
    CHECK(sink.finish(SessionTime(), {}).clipped_samples == 5);
}

TEST_CASE("a simulated voice has the level and the pitch that it is given, for its time", "[unit]") {
    SimulatedVoice voice;
    voice.noise_dbfs = -90.0;
    voice.voice_dbfs = -20.0;
    voice.begin_s = 0.5;
    voice.end_s = 2.5;
    constexpr double rate_hz = 8000.0;
    const std::vector<float> sound = simulated_sound(voice, rate_hz, 3.0, 7);
    REQUIRE(sound.size() == 24000);
    const auto rms = [&](double from_s, double to_s) {
        double sum = 0.0;
        const auto first = static_cast<std::size_t>(from_s * rate_hz),
                   last = static_cast<std::size_t>(to_s * rate_hz);
        for (std::size_t i = first; i < last; ++i)
            sum += static_cast<double>(sound[i]) * static_cast<double>(sound[i]) /
                   static_cast<double>(last - first);
        return std::sqrt(sum);
    };
    CHECK(20.0 * std::log10(rms(0.0, 0.5)) == Approx(-90.0).margin(0.5));
    CHECK(20.0 * std::log10(rms(2.5, 3.0)) == Approx(-90.0).margin(0.5));
    // Whole syllables swell between 0.3 and 1: of the mean square that is 0.65^2 + 0.35^2 / 2.
    CHECK(rms(0.75, 2.25) == Approx(0.1 * std::sqrt(0.65 * 0.65 + 0.5 * 0.35 * 0.35)).epsilon(0.02));
    // All that it has is at multiples of 120 Hz.
    const auto amplitude = [&](double hz) {
        double cosines = 0.0, sines = 0.0;
        for (std::size_t i = 6000; i < 18000; ++i) {
            const double turn = 2.0 * 3.14159265358979 * hz * static_cast<double>(i) / rate_hz;
            cosines += static_cast<double>(sound[i]) * std::cos(turn);
            sines += static_cast<double>(sound[i]) * std::sin(turn);
        }
        return std::hypot(cosines, sines) / 6000.0;
    };
    const double first = amplitude(120.0);
    const double wanted[] = {0.6, 0.8, 1.0, 1.0, 0.9, 0.7, 0.5, 0.35, 0.25, 0.2, 0.15, 0.1};
    for (int i = 1; i <= 12; ++i)
        CHECK(amplitude(120.0 * i) / first == Approx(wanted[i - 1] / 0.6).margin(0.02));
    CHECK(amplitude(60.0) < 0.02 * first);
    CHECK(amplitude(13 * 120.0) < 0.02 * first);
    // It begins and ends within 5 ms, evenly: halfway it has half of what it has a quarter of a second, which
    // is a syllable and thirty waves, later or earlier.
    for (const auto& [at, whole] : {std::pair(4020u, 6020u), {19'980u, 17'980u}})
        CHECK(sound[at] == Approx(0.5f * sound[whole]).margin(3e-4));
    CHECK(std::abs(sound[6020]) > 3e-3f);
    // Louder by its gain, up to full scale.
    voice.gain = 2.0;
    const std::vector<float> louder = simulated_sound(voice, rate_hz, 3.0, 7);
    for (const std::size_t i : {5000u, 9000u, 12345u})
        CHECK(louder[i] == Approx(2.0f * sound[i]));
    voice.gain = 1000.0;
    for (const float sample : simulated_sound(voice, rate_hz, 3.0, 7))
        REQUIRE(std::abs(sample) <= 1.0f);
}

TEST_CASE(
    "while a simulated observer speaks the level is that of the voice, before and after that of the room",
    "[unit]") {
    using namespace std::chrono_literals;
    SimulatedSitting sitting(31);
    const TemporaryFolder folder;
    const Trial trial{0, 0, {}};
    const SimulatedAnswer said = sitting.observer.answer_to(trial);
    for (const double gain : {1.0, 3.0, 4.0}) {
        SimulatedSoundSettings settings;
        settings.gain = gain;
        settings.noise_dbfs = -40.0;
        SimulatedAnswerRecorder recorder(sitting.clock, sitting.observer, 3, settings);
        recorder.keep_in(folder.path());
        const auto recording = recorder.begin(trial);
        sitting.clock.wait_until(sitting.clock.now() + 30s);
        CHECK(recording->level().peak == Approx(0.01f)); // nothing has been asked
        const SessionTime onset = sitting.clock.now();
        recording->response_screen_lit(onset);
        const auto level_at = [&](SessionTime at) {
            sitting.clock.wait_until(at);
            return recording->level();
        };
        CHECK(level_at(onset + said.voice_after - 1ns).peak == Approx(0.01f));
        for (const SessionTime at : {onset + said.voice_after, onset + said.voice_until - 1ns}) {
            const AudioLevel level = level_at(at);
            CHECK(level.peak == Approx(gain == 1.0 ? 0.3f : gain == 3.0 ? 0.9f : 1.0f));
            CHECK(level.rms == Approx(0.3f * level.peak));
            CHECK(level.is_clipping == (gain == 4.0));
        }
        const AudioLevel after = level_at(onset + said.voice_until);
        CHECK(after.peak == Approx(0.01f));
        CHECK_FALSE(after.is_clipping);
        CHECK(recording->level().rms == Approx(0.003f));
    }
}
