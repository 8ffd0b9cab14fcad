/// EyeLink recordings for tests whose events are known: planted gaze as samples alone.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/events/planted_gaze.h"

namespace overt::testing {

/// What stands around the samples.
struct PlantedAsc {
    double rate_hz = 500.0;                 ///< of which intervals are whole milliseconds
    bool tells_resolution = true;           ///< that angles can be known
    bool has_events = false;                ///< those that were planted, as the tracker's own
    std::vector<int> trial_ids_ms = {};     ///< messages TRIALID, from the first sample
    std::vector<int> trial_results_ms = {}; ///< messages TRIAL_RESULT, the same
    std::vector<int> starts_ms = {};        ///< END and START once more, without a pause
};

inline std::int64_t whole_ms(TrackerTime at) { return at.time_since_epoch().count() / 1000; }

inline std::string planted_asc_text(const PlantedGaze& planted, const PlantedAsc& around) {
    std::string text = "** DATE: Thu Feb 29 23:59:59 2024\n** TYPE: EDF_FILE BINARY EVENT SAMPLE TAGGED\n"
                       "** VERSION: EYELINK II 1\n** EYELINK II CL v4.56 Aug 18 2010\n**\n\n";
    const std::int64_t first_ms = whole_ms(planted.samples.front().sampled_at);
    text += fmt::format("MSG\t{} DISPLAY_COORDS 0 0 1919 1079\n", first_ms - 20);
    const std::string eye = planted.samples.front().eye == Eye::left ? "LEFT" : "RIGHT";
    const auto start = [&](std::int64_t at_ms) {
        text += fmt::format("START\t{0} \t{1}\tSAMPLES\tEVENTS\nPRESCALER\t1\nVPRESCALER\t1\nPUPIL\tAREA\n"
                            "EVENTS\tGAZE\t{1}\tRATE\t{2:7.2f}\tTRACKING\tCR\tFILTER\t2\n"
                            "SAMPLES\tGAZE\t{1}\tRATE\t{2:7.2f}\tTRACKING\tCR\tFILTER\t2\n",
                            at_ms, eye, around.rate_hz);
    };
    const auto end = [&](std::int64_t at_ms) {
        text += fmt::format("END\t{} \tSAMPLES\tEVENTS{}\n", at_ms,
                            around.tells_resolution ? "\tRES\t  40.00\t  40.00" : "");
    };
    const auto is_one_of = [&](const std::vector<int>& times_ms, std::int64_t at_ms) {
        return std::find(times_ms.begin(), times_ms.end(), at_ms - first_ms) != times_ms.end();
    };
    start(first_ms);
    for (const GazeSample& sample : planted.samples) {
        const std::int64_t at_ms = whole_ms(sample.sampled_at);
        if (is_one_of(around.trial_results_ms, at_ms))
            text += fmt::format("MSG\t{} TRIAL_RESULT 0\n", at_ms);
        if (is_one_of(around.trial_ids_ms, at_ms))
            text += fmt::format("MSG\t{} TRIALID\n", at_ms);
        if (is_one_of(around.starts_ms, at_ms)) {
            end(at_ms);
            start(at_ms);
        }
        text += sample.gaze ? fmt::format("{}\t{:.3f}\t{:.3f}\t{:.1f}\t...\n", at_ms, sample.gaze->x_px,
                                          sample.gaze->y_px, sample.pupil_area)
                            : fmt::format("{}\t   .\t   .\t    0.0\t...\n", at_ms);
        for (const GazeEvent& event : planted.events)
            if (around.has_events && event.kind == GazeEvent::Kind::fixation &&
                event.end == sample.sampled_at)
                text += fmt::format("EFIX {}   {}\t{}\t{}\t  900.0\t  500.0\t   1000\n", eye.substr(0, 1),
                                    whole_ms(event.start), at_ms, event.duration.count() / 1000);
    }
    end(whole_ms(planted.samples.back().sampled_at) + 1);
    return text;
}

inline std::filesystem::path write_planted_asc(const std::filesystem::path& file, const PlantedGaze& planted,
                                               const PlantedAsc& around) {
    std::ofstream(file) << planted_asc_text(planted, around);
    return file;
}

} // namespace overt::testing
