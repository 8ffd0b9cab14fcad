/// PortAudio, begun and ended. Only for files of this room.
#pragma once

#include <cstdio>

#include <fcntl.h>
#include <fmt/format.h>
#include <portaudio.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {

/// Standard error goes nowhere while this lives: ALSA and JACK name there each device that they did not
/// find.
class QuietErrors {
  public:
    QuietErrors() : kept_(::dup(STDERR_FILENO)) {
        std::fflush(stderr);
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        ::dup2(nowhere, STDERR_FILENO);
        ::close(nowhere);
    }
    ~QuietErrors() {
        std::fflush(stderr);
        ::dup2(kept_, STDERR_FILENO);
        ::close(kept_);
    }
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    int kept_;
};

/// While one lives, PortAudio can be called. Throws DeviceError.
class SoundSystem {
  public:
    SoundSystem() {
        const QuietErrors quiet;
        if (const PaError error = Pa_Initialize(); error != paNoError)
            throw DeviceError(fmt::format("PortAudio: {}", Pa_GetErrorText(error)));
    }
    ~SoundSystem() { Pa_Terminate(); }
    SoundSystem(const SoundSystem&) = delete;
    SoundSystem& operator=(const SoundSystem&) = delete;
};

} // namespace overt
