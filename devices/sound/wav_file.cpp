#include "devices/sound/wav_file.h"

#include <fmt/format.h>
#include <sndfile.h>

#include "experiment/base/error.h"

namespace overt {

WavFile::WavFile(const std::filesystem::path& file, int sample_rate_hz, int bits) : file_(file) {
    if (std::filesystem::exists(file))
        throw RecordError(
            fmt::format("{}: there is such a file already; it is not overwritten.", file.string()));
    SF_INFO info{};
    info.samplerate = sample_rate_hz;
    info.channels = 1;
    info.format = SF_FORMAT_WAV | (bits == 24 ? SF_FORMAT_PCM_24 : SF_FORMAT_PCM_16);
    sound_ = sf_open(file.c_str(), SFM_WRITE, &info);
    if (!sound_)
        throw RecordError(fmt::format("{}: cannot be written: {}.", file.string(), sf_strerror(nullptr)));
    sf_command(sound_, SFC_SET_CLIPPING, nullptr, SF_TRUE);
    sf_command(sound_, SFC_SET_UPDATE_HEADER_AUTO, nullptr, SF_TRUE);
}

WavFile::~WavFile() {
    if (sound_)
        sf_close(sound_);
}

void WavFile::write(std::span<const float> samples) {
    const auto count = static_cast<sf_count_t>(samples.size());
    if (sf_write_float(sound_, samples.data(), count) != count)
        throw RecordError(fmt::format("{}: {}.", file_.string(), sf_strerror(sound_)));
}

void WavFile::close() {
    SNDFILE* const sound = sound_;
    sound_ = nullptr;
    if (const int fault = sf_close(sound); fault != 0)
        throw RecordError(fmt::format("{}: {}.", file_.string(), sf_error_number(fault)));
}

} // namespace overt
