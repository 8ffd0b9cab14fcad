#include "experiment/session/answer_check.h"

#include <fmt/format.h>

namespace overt {

std::vector<std::string> warnings_about(const RecordedAnswer& answer) {
    std::vector<std::string> warnings;
    if (!answer.fault.empty())
        warnings.push_back("broke off: " + answer.fault);
    if (answer.clipped_samples > 0)
        warnings.push_back(fmt::format("clipped: {} samples at full scale; turn the microphone down",
                                       answer.clipped_samples));
    if (!answer.voice_onset && answer.samples > 0)
        warnings.push_back(
            fmt::format("silent: no voice above the noise of {:.0f} dBFS, the loudest sample is at "
                        "{:.0f} dBFS",
                        answer.noise_dbfs, answer.peak_dbfs));
    if (answer.samples == 0 && answer.fault.empty())
        warnings.emplace_back("empty: the sound device gave no sample");
    if (answer.overruns > 0)
        warnings.push_back(fmt::format("{} overruns, {} samples lost", answer.overruns, answer.lost_samples));
    return warnings;
}

} // namespace overt
