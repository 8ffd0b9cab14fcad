/// What drivers of sound devices ask of PortAudio, and what they make of its answers: a sound system of the
/// test's own takes the library's place while there is one, for this program.
#include <cstdio>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <portaudio.h>
#include <unistd.h>

#include "devices/sound/beeper.h"
#include "devices/sound/port_audio_input.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "tests/support/counted_clock.h"
#include "tests/support/next_function.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// Two sound systems with a device that plays, one that records, and one that does both.
class SoundStandIn {
  public:
    SoundStandIn() { now = this; }
    ~SoundStandIn() { now = nullptr; }
    SoundStandIn(const SoundStandIn&) = delete;
    SoundStandIn& operator=(const SoundStandIn&) = delete;

    void note(std::string word) { asked.push_back(std::move(word)); }
    int call(const void* heard, void* played, unsigned long frames, const PaStreamCallbackTimeInfo& times,
             PaStreamCallbackFlags flags = 0) const {
        return callback(heard, played, frames, &times, flags, of);
    }

    PaDeviceInfo devices[3] = {device("Speakers", 0, 0, 2, 44100.0, 0.25),
                               device("USB Microphone", 1, 1, 0, 16000.0, 0.5),
                               device("Headset", 0, 2, 2, 48000.0, 0.125)};
    PaHostApiInfo systems[2] = {system("ALSA"), system("JACK")};
    int count = 3, input = 2, output = 0;
    PaError begun = paNoError, opened = paNoError, started = paNoError, active = 0;
    bool knows_latency = true, has_output_info = true;
    std::string says; ///< to standard error, at the beginning and when a stream is opened
    std::vector<std::string> asked;
    PaStreamCallback* callback = nullptr;
    void* of = nullptr;
    PaStreamInfo stream{1, 0.0625, 0.0, 0.0};
    static inline SoundStandIn* now = nullptr;

  private:
    static PaDeviceInfo device(const char* name, int system, int inputs, int outputs, double rate_hz,
                               double latency_s) {
        PaDeviceInfo info{};
        info.structVersion = 2;
        info.name = name;
        info.hostApi = system;
        info.maxInputChannels = inputs;
        info.maxOutputChannels = outputs;
        info.defaultLowInputLatency = latency_s;
        info.defaultLowOutputLatency = 2.0 * latency_s;
        info.defaultHighInputLatency = info.defaultHighOutputLatency = 9.0;
        info.defaultSampleRate = rate_hz;
        return info;
    }
    static PaHostApiInfo system(const char* name) {
        PaHostApiInfo info{};
        info.structVersion = 1;
        info.name = name;
        return info;
    }
};

std::string words_of(const PaStreamParameters* parameters) {
    return parameters
               ? fmt::format("device {} channels {} format {} latency {}{}", parameters->device,
                             parameters->channelCount, parameters->sampleFormat, parameters->suggestedLatency,
                             parameters->hostApiSpecificStreamInfo ? " more" : "")
               : "nothing";
}

} // namespace

// They take the place of the library's for this program.
extern "C" {
PaError Pa_Initialize() {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_Initialize)>("Pa_Initialize")();
    SoundStandIn::now->note("begin");
    std::fputs(SoundStandIn::now->says.c_str(), stderr);
    return SoundStandIn::now->begun;
}
PaError Pa_Terminate() {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_Terminate)>("Pa_Terminate")();
    SoundStandIn::now->note("end");
    return paNoError;
}
PaDeviceIndex Pa_GetDeviceCount() {
    return SoundStandIn::now ? SoundStandIn::now->count
                             : next_function<decltype(Pa_GetDeviceCount)>("Pa_GetDeviceCount")();
}
PaDeviceIndex Pa_GetDefaultInputDevice() {
    return SoundStandIn::now
               ? SoundStandIn::now->input
               : next_function<decltype(Pa_GetDefaultInputDevice)>("Pa_GetDefaultInputDevice")();
}
PaDeviceIndex Pa_GetDefaultOutputDevice() {
    return SoundStandIn::now
               ? SoundStandIn::now->output
               : next_function<decltype(Pa_GetDefaultOutputDevice)>("Pa_GetDefaultOutputDevice")();
}
const PaDeviceInfo* Pa_GetDeviceInfo(PaDeviceIndex device) {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_GetDeviceInfo)>("Pa_GetDeviceInfo")(device);
    return device >= 0 && device < SoundStandIn::now->count && SoundStandIn::now->has_output_info
               ? &SoundStandIn::now->devices[device]
               : nullptr;
}
const PaHostApiInfo* Pa_GetHostApiInfo(PaHostApiIndex system) {
    return SoundStandIn::now ? &SoundStandIn::now->systems[system]
                             : next_function<decltype(Pa_GetHostApiInfo)>("Pa_GetHostApiInfo")(system);
}
PaError Pa_OpenStream(PaStream** stream, const PaStreamParameters* input, const PaStreamParameters* output,
                      double rate_hz, unsigned long frames, PaStreamFlags flags, PaStreamCallback* callback,
                      void* of) {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_OpenStream)>("Pa_OpenStream")(stream, input, output, rate_hz, frames,
                                                                       flags, callback, of);
    SoundStandIn& standing = *SoundStandIn::now;
    standing.note(fmt::format("open in {}, out {}, rate {} frames {} flags {}", words_of(input),
                              words_of(output), rate_hz, frames, flags));
    std::fputs(standing.says.c_str(), stderr);
    standing.callback = callback;
    standing.of = of;
    *stream = standing.opened == paNoError ? &standing : nullptr;
    return standing.opened;
}
PaError Pa_StartStream(PaStream* stream) {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_StartStream)>("Pa_StartStream")(stream);
    SoundStandIn::now->note(stream == SoundStandIn::now ? "start" : "start what is not open");
    return SoundStandIn::now->started;
}
PaError Pa_StopStream(PaStream* stream) {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_StopStream)>("Pa_StopStream")(stream);
    SoundStandIn::now->note(stream == SoundStandIn::now ? "stop" : "stop what is not open");
    return paNoError;
}
PaError Pa_CloseStream(PaStream* stream) {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_CloseStream)>("Pa_CloseStream")(stream);
    SoundStandIn::now->note(stream == SoundStandIn::now ? "close" : "close what is not open");
    std::fputs(SoundStandIn::now->says.c_str(), stderr);
    return paNoError;
}
PaError Pa_IsStreamActive(PaStream* stream) {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_IsStreamActive)>("Pa_IsStreamActive")(stream);
    return SoundStandIn::now->active;
}
const PaStreamInfo* Pa_GetStreamInfo(PaStream* stream) {
    if (!SoundStandIn::now)
        return next_function<decltype(Pa_GetStreamInfo)>("Pa_GetStreamInfo")(stream);
    return SoundStandIn::now->knows_latency && stream == SoundStandIn::now ? &SoundStandIn::now->stream
                                                                           : nullptr;
}
}

namespace {

const std::string opened_input =
    "open in device 1 channels 1 format 1 latency 0.5, out nothing, rate 16000 frames 256 flags 1";
const std::string opened_output =
    "open in nothing, out device 0 channels 1 format 1 latency 0.5, rate 44100 frames 0 flags 0";

/// What is written to standard error meanwhile.
template <class Action> std::string written_to_errors(Action action) {
    const TemporaryFolder folder;
    std::fflush(stderr);
    const int kept = ::dup(STDERR_FILENO);
    std::FILE* const file = std::fopen((folder.path() / "errors").c_str(), "w+");
    ::dup2(::fileno(file), STDERR_FILENO);
    action();
    std::fputs("|", stderr); // it is as it was
    std::fflush(stderr);
    ::dup2(kept, STDERR_FILENO);
    ::close(kept);
    std::fclose(file);
    return read_whole_file(folder.path() / "errors");
}

} // namespace

TEST_CASE("sound devices that record are listed with their system, the default one among them", "[unit]") {
    SoundStandIn system;
    const std::vector<SoundInputInfo> inputs = sound_inputs();
    REQUIRE(inputs.size() == 2);
    CHECK(inputs[0].name == "JACK: USB Microphone");
    CHECK_FALSE(inputs[0].is_default);
    CHECK(inputs[0].usual_rate_hz == 16000.0);
    CHECK(inputs[0].latency_s == 0.5);
    CHECK(inputs[1].name == "ALSA: Headset");
    CHECK(inputs[1].is_default);
    CHECK(inputs[1].usual_rate_hz == 48000.0);
    CHECK(inputs[1].latency_s == 0.125);
    CHECK(system.asked == std::vector<std::string>{"begin", "end"});
    CHECK(sound_input_called("")->name == "ALSA: Headset");
    CHECK(sound_input_called("Micro")->name == "JACK: USB Microphone");
    CHECK(sound_input_called("ALSA")->name == "ALSA: Headset");
    CHECK_FALSE(sound_input_called("Speakers"));
    system.input = 0; // plays only
    CHECK_FALSE(sound_input_called(""));
    system.count = 1;
    CHECK(sound_inputs().empty());
    system.begun = paNotInitialized;
    system.asked.clear();
    CHECK_THROWS_WITH(sound_inputs(), Contains("PortAudio: PortAudio not initialized"));
    CHECK(system.asked == std::vector<std::string>{"begin"});
}

TEST_CASE("a microphone is opened with one channel at its rate, and its sound comes in blocks with its times",
          "[unit]") {
    SoundStandIn system;
    CountedClock clock;
    SoundRing ring(8);
    {
        PortAudioInput input("Micro", 16000, clock, ring);
        CHECK(system.asked == std::vector<std::string>{"begin", opened_input, "start"});
        CHECK(input.name() == "JACK: USB Microphone");
        CHECK(input.latency() == 62500us);
        std::vector<float> sound(600);
        for (std::size_t i = 0; i < sound.size(); ++i)
            sound[i] = static_cast<float>(i);
        CHECK(system.call(sound.data(), nullptr, 600, {7.0, 7.25, 0.0}, paInputOverflow) == paContinue);
        const SessionTime first = clock.time - 250ms;
        SoundBlock block;
        const std::uint32_t counts[] = {256, 256, 88};
        for (int i = 0; i < 3; ++i) {
            CAPTURE(i);
            REQUIRE(ring.try_pop(block));
            CHECK(block.first_sample == 256 * i);
            CHECK(block.at == first + i * 16ms);
            CHECK(block.is_after_overflow == (i == 0));
            REQUIRE(block.count == counts[i]);
            CHECK(block.sound().front() == static_cast<float>(256 * i));
            CHECK(block.sound().back() == static_cast<float>(256 * i + static_cast<int>(counts[i]) - 1));
        }
        CHECK_FALSE(ring.try_pop(block));
        // What the system does not know, or cannot be, is not taken for a time.
        const struct {
            double taken_s, now_s;
            SessionDuration age;
        } ages[] = {{0.0, 3.0, 10ms}, {-1.0, 3.0, 10ms},   {4.0, 3.0, 10ms}, {3.0, 8.0, 10ms},
                    {3.0, 9.0, 10ms}, {3.0, 7.75, 4750ms}, {3.0, 3.0, 0ms},  {0.5, 1.0, 500ms}};
        std::int64_t before = 600;
        for (const auto& age : ages) {
            CAPTURE(age.taken_s, age.now_s);
            CHECK(system.call(sound.data(), nullptr, 160, {age.taken_s, age.now_s, 0.0}) == paContinue);
            REQUIRE(ring.try_pop(block));
            CHECK(block.first_sample == before);
            CHECK(block.at == clock.time - age.age);
            CHECK_FALSE(block.is_after_overflow);
            CHECK(block.count == 160);
            CHECK_FALSE(ring.try_pop(block));
            before += 160;
        }
        // Flags other than that samples of the input were lost say nothing of it.
        system.call(sound.data(), nullptr, 1, {}, paInputUnderflow | paOutputOverflow | paPrimingOutput);
        REQUIRE(ring.try_pop(block));
        CHECK_FALSE(block.is_after_overflow);
        CHECK(block.count == 1);
        // A full ring drops blocks, whose samples count.
        system.call(sound.data(), nullptr, 0, {});
        CHECK_FALSE(ring.try_pop(block));
        for (int i = 0; i < 10; ++i)
            system.call(sound.data(), nullptr, 256, {});
        for (int i = 0; i < 8; ++i) {
            REQUIRE(ring.try_pop(block));
            CHECK(block.first_sample == before + 1 + 256 * i);
        }
        CHECK_FALSE(ring.try_pop(block));
        system.call(sound.data(), nullptr, 256, {});
        REQUIRE(ring.try_pop(block));
        CHECK(block.first_sample == before + 1 + 2560);
        system.asked.clear();
    }
    CHECK(system.asked == std::vector<std::string>{"close", "end"});
}

TEST_CASE("a microphone that is not there or does not begin is refused, and nothing stays open", "[unit]") {
    SoundStandIn system;
    CountedClock clock;
    SoundRing ring(8);
    CHECK_THROWS_WITH(PortAudioInput("Trombone", 16000, clock, ring),
                      Contains("no sound device called \"Trombone\" that records. There are:\n  JACK: USB "
                               "Microphone\n  ALSA: Headset"));
    CHECK(system.asked == std::vector<std::string>{"begin", "end"});
    system.input = paNoDevice;
    CHECK_THROWS_WITH(PortAudioInput("", 16000, clock, ring), "there is no sound device that records");
    system.count = 1;
    CHECK_THROWS_WITH(PortAudioInput("Trombone", 16000, clock, ring), Contains("There are: none"));
    system.count = 3;
    system.opened = paInvalidSampleRate;
    system.asked.clear();
    CHECK_THROWS_WITH(PortAudioInput("Micro", 16000, clock, ring),
                      "JACK: USB Microphone: records no 16000 samples a second: Invalid sample rate");
    CHECK(system.asked == std::vector<std::string>{"begin", opened_input, "end"});
    system.opened = paNoError;
    system.started = paDeviceUnavailable;
    system.asked.clear();
    CHECK_THROWS_WITH(PortAudioInput("Micro", 16000, clock, ring), Contains("Device unavailable"));
    CHECK(system.asked == std::vector<std::string>{"begin", opened_input, "start", "close", "end"});
    system.started = paNoError;
    system.knows_latency = false;
    CHECK(PortAudioInput("Micro", 16000, clock, ring).latency() == SessionDuration());
}

TEST_CASE("what sound systems say of devices that they did not find is not shown", "[unit]") {
    SoundStandIn system;
    system.says = "unknown PCM cards.pcm.rear";
    CountedClock clock;
    SoundRing ring(8);
    CHECK(written_to_errors([] { CHECK(sound_inputs().size() == 2); }) == "|");
    CHECK(written_to_errors([] { const Beeper beeper; }) == "|");
    std::fputs("", stderr);
    CHECK(written_to_errors([&] {
              const PortAudioInput input("Micro", 16000, clock, ring);
              std::fputs("before ", stderr);
              system.says = "";
          }) == "before |");
    // No descriptor is left over: the next one is the same again and again.
    const int next = ::dup(STDERR_FILENO);
    ::close(next);
    for (int i = 0; i < 3; ++i)
        sound_inputs();
    const int again = ::dup(STDERR_FILENO);
    ::close(again);
    CHECK(again == next);
}

TEST_CASE("beeps are played through the default output, which rests after two seconds of silence", "[unit]") {
    SoundStandIn system;
    {
        Beeper beeper;
        CHECK(beeper.name() == "ALSA: Speakers");
        CHECK(system.asked == std::vector<std::string>{"begin", opened_output, "start"});
        system.asked.clear();
        system.active = 1;
        beeper.play(Beep::answered);
        CHECK(system.asked.empty());
        // The samples are those of the beep at the device's rate.
        BeepSound sound(44100.0);
        sound.start(Beep::answered);
        std::vector<float> wanted(4410), got(4410, 2.0f);
        sound.fill(wanted);
        CHECK(system.call(nullptr, got.data(), 4410, {}) == paContinue);
        CHECK(got == wanted);
        // Two seconds of silence are not too much, one sample more is.
        std::vector<float> rest(88200, 2.0f);
        CHECK(system.call(nullptr, rest.data(), 88200, {}) == paContinue);
        CHECK(rest == std::vector<float>(88200, 0.0f));
        CHECK(system.call(nullptr, rest.data(), 1, {}) == paComplete);
        system.active = 0;
        beeper.play(Beep::wrong);
        CHECK(system.asked == std::vector<std::string>{"stop", "start"});
        CHECK(system.call(nullptr, rest.data(), 1, {}) == paContinue);
        system.active = paBadStreamPtr; // not known: begun anew
        beeper.play(Beep::wrong);
        CHECK(system.asked == std::vector<std::string>{"stop", "start", "stop", "start"});
        system.asked.clear();
    }
    CHECK(system.asked == std::vector<std::string>{"close", "end"});
}

TEST_CASE("an output that is not there or does not begin is refused, and nothing stays open", "[unit]") {
    SoundStandIn system;
    const auto refused = [&](const std::string& why, const std::vector<std::string>& asked) {
        system.asked.clear();
        CHECK_THROWS_WITH(Beeper(), why);
        CHECK(system.asked == asked);
    };
    system.output = paNoDevice;
    refused("there is no sound device that plays", {"begin", "end"});
    system.output = 0;
    system.has_output_info = false;
    refused("there is no sound device that plays", {"begin", "end"});
    system.has_output_info = true;
    system.opened = paInvalidChannelCount;
    refused("ALSA: Speakers does not play: Invalid number of channels", {"begin", opened_output, "end"});
    system.opened = paNoError;
    system.started = paDeviceUnavailable;
    refused("ALSA: Speakers does not play: Device unavailable",
            {"begin", opened_output, "start", "close", "end"});
    system.begun = paInsufficientMemory;
    refused("PortAudio: Insufficient memory", {"begin"});
}
