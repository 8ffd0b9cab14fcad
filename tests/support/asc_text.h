/// EyeLink recordings for tests, made up line by line.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace overt::testing {

struct AscExample {
    bool left = true, right = false;
    double rate_hz = 500.0;
    bool float_times = false;
    std::string line_end = "\n";
    bool has_header = true, has_layout = true, has_blocks = true, has_status = true, has_events = true,
         has_samples = true, has_trial_ids = true;
    bool head_target = false;
    int trials = 2, samples = 60;
};

/// The n-th sample's place by the example's own rule, to a tenth of a pixel.
inline double example_x(int trial, int n, bool left) {
    return 100.0 * (trial + 1) + 0.1 * n + (left ? 0.0 : 20.5);
}
inline double example_y(int n) { return 700.0 - 0.3 * n; }
/// Samples 20 to 29 are a blink.
inline bool example_is_lost(int n) { return n >= 20 && n < 30; }
/// Microseconds of the tracker's clock.
inline std::int64_t example_us(const AscExample& example, int trial, int n) {
    return 5'000'000 + 2'000'000 * trial + static_cast<std::int64_t>(1e6 / example.rate_hz) * n;
}

inline std::string asc_text(const AscExample& example) {
    std::string text;
    const auto add = [&](const std::string& line) { text += line + example.line_end; };
    const auto time = [&](std::int64_t us) {
        return example.float_times ? fmt::format("{:.1f}", 1e-3 * static_cast<double>(us))
                                   : fmt::format("{}", us / 1000);
    };
    const std::string eyes = example.left ? (example.right ? "LEFT\tRIGHT" : "LEFT") : "RIGHT";
    const std::string letters = example.left ? (example.right ? "LR" : "L") : "R";
    if (example.has_header) {
        add("** CONVERTED FROM somewhere.edf");
        add("** DATE: Thu Feb 29 23:59:59 2024");
        add("** TYPE: EDF_FILE BINARY EVENT SAMPLE TAGGED");
        add("** VERSION: EYELINK II 1");
        add("** EYELINK II CL v4.56 Aug 18 2010");
        add("**");
        add("");
        add("MSG\t4000 DISPLAY_COORDS 0 0 1023 767");
        add(">>>>>>> CALIBRATION (HV3,P-CR) FOR LEFT: <<<<<<<<<");
        add("MSG\t4100 !CAL eye check box: (L,R,T,B)");
        add("\t  -80     7   -84     8");
        add("MSG\t4200 !CAL VALIDATION HV3 L LEFT  GOOD ERROR 0.31 avg. 0.75 max  OFFSET 0.17 deg. "
            "6.0,-0.9 pix.");
    }
    for (int trial = 0; trial < example.trials; ++trial) {
        const std::int64_t start_us = example_us(example, trial, 0);
        if (example.has_trial_ids)
            add(fmt::format("MSG\t{} TRIALID {}", start_us / 1000 - 5, trial + 1));
        if (example.has_layout) {
            add(fmt::format("MSG\t{} RECCFG CR {:.0f} 2 1 {}", start_us / 1000 - 3, example.rate_hz,
                            letters));
            add(fmt::format("MSG\t{} GAZE_COORDS 0.00 0.00 1023.00 767.00", start_us / 1000 - 3));
        }
        if (example.has_blocks)
            add(fmt::format("START\t{} \t{}\tSAMPLES\tEVENTS", start_us / 1000, eyes));
        if (example.has_layout) {
            add("PRESCALER\t1");
            add("PUPIL\tAREA");
            add(fmt::format("EVENTS\tGAZE\t{}\tRATE\t{:7.2f}\tTRACKING\tCR\tFILTER\t2", eyes,
                            example.rate_hz));
            add(fmt::format("SAMPLES\tGAZE\t{}\t{}RATE\t{:7.2f}\tTRACKING\tCR\tFILTER\t2", eyes,
                            example.head_target ? "HTARGET\t" : "", example.rate_hz));
        }
        for (int n = 0; n < example.samples; ++n) {
            const std::int64_t us = example_us(example, trial, n);
            if (n == 10)
                add(fmt::format("MSG\t{} PRESENTATION_ONSET", us / 1000));
            if (example.has_events && n == 15)
                add(fmt::format("SFIX {}   {}", letters.substr(0, 1), us / 1000));
            if (example.has_samples) {
                std::string line = time(us);
                for (const bool left : {true, false}) {
                    if (left ? !example.left : !example.right)
                        continue;
                    line += example_is_lost(n)
                                ? std::string("\t   .\t   .\t    0.0")
                                : fmt::format("\t{:7.1f}\t{:7.1f}\t{:7.1f}", example_x(trial, n, left),
                                              example_y(n), 900.0 + n);
                }
                if (example.has_status)
                    line += letters == "LR" ? "\t....." : "\t...";
                if (example.head_target)
                    line += "\t 1234.0\t 2345.0\t  600.0\t.............";
                add(line);
            }
            if (example.has_events && n == 19)
                add(fmt::format("EFIX {}   {}\t{}\t{}\t  512.8\t  394.5\t   1063", letters.substr(0, 1),
                                example_us(example, trial, 15) / 1000, us / 1000,
                                us / 1000 - example_us(example, trial, 15) / 1000 + 2));
            if (example.has_events && n == 31) {
                const auto blink = example_us(example, trial, 20) / 1000,
                           end = example_us(example, trial, 29) / 1000;
                add(fmt::format("SSACC {}  {}", letters.substr(0, 1), blink));
                add(fmt::format("SBLINK {} {}", letters.substr(0, 1), blink));
                add(fmt::format("EBLINK {} {}\t{}\t{}", letters.substr(0, 1), blink, end, end - blink + 2));
                add(fmt::format("ESACC {}  {}\t{}\t{}\t  512.8\t  -39.5\t  509.2\t  380.4\t   0.46\t     57",
                                letters.substr(0, 1), blink, us / 1000, us / 1000 - blink + 2));
            }
        }
        const std::int64_t end_ms = example_us(example, trial, example.samples) / 1000 + 1;
        if (example.has_blocks)
            add(fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  35.24\t  35.17", end_ms));
        add(fmt::format("INPUT\t{}\t127", end_ms + 1));
        add(fmt::format("BUTTON\t{}\t5\t1", end_ms + 1));
        add(fmt::format("MSG\t{} TRIAL_RESULT 0", end_ms + 2));
    }
    return text;
}

inline std::filesystem::path write_asc(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

} // namespace overt::testing
