/// What programs that read EyeLink's text form need of it, as strict checks: one for each reader. Each gives
/// what that reader would take for samples, or a sentence on why it would fail.
#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace overt::testing {

struct ReadSample {
    double time = 0.0;
    std::optional<double> x, y; ///< of the left eye in a recording of both
    double pupil = 0.0;
};

struct AscReading {
    std::string failure; ///< empty: it reads the file
    std::vector<ReadSample> samples;
    std::vector<std::string> messages;
    double expected_samples = 0.0; ///< by the blocks' lengths, where the reader computes them
    int blocks = 0;
    double samples_after_merge = 0.0; ///< MNE: those that it finds again at evenly spaced times
};

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

inline std::vector<std::string> split_at_tabs(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '\t');)
        cells.push_back(cell);
    return cells;
}

inline std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
        words.push_back(word);
    return words;
}

inline std::optional<double> value_or_dot(const std::string& text) {
    const std::vector<std::string> words = words_of(text);
    return words.size() == 1 && words[0] != "." ? std::optional(std::stod(words[0])) : std::nullopt;
}

/// R's eyelinker: START, and an EVENTS line; one END after each START; what stands outside of blocks is left
/// out; all rows of samples with the same number of tab-separated cells, those of another are dropped; as
/// many cells as the header has columns; times of 31 bits, or with a point from the first on; a version line
/// it can take a number from; the first word of DISPLAY_COORDS's rest a number.
inline AscReading read_as_eyelinker(const std::string& text) {
    AscReading reading;
    const std::vector<std::string> lines = lines_of(text);
    bool has_events = false, in_block = false;
    std::size_t columns = 0;
    int ends = 0;
    for (const std::string& line : lines) {
        if (line.starts_with("EVENTS\t") || line.starts_with("SAMPLES\t")) {
            has_events |= line.starts_with("EVENTS");
            const bool both = line.find("\tLEFT\tRIGHT\t") != std::string::npos;
            columns = (both ? 7u : 4u) + (line.find("\tTRACKING") != std::string::npos ? 1u : 0u);
            if (!std::regex_search(line, std::regex(R"(RATE\s+[0-9]+\.[0-9]+)")))
                reading.failure = "a rate without a point";
        }
    }
    if (!has_events)
        reading.failure = "no EVENTS line";
    static const std::regex version(R"(\*\* EYELINK II.* v([0-9.]+) [A-Za-z].*)");
    if (std::none_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return std::regex_match(line, version); }))
        reading.failure = "no version";
    for (const std::string& line : lines) {
        if (line.starts_with("START\t")) {
            if (reading.blocks > 0 && ends != 1)
                reading.failure = "a START without its one END";
            in_block = true;
            ends = 0;
            ++reading.blocks;
        }
        if (line.starts_with("END\t")) {
            in_block = false;
            ++ends;
        }
        if (!in_block || line.empty()) {
            if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])))
                reading.failure = "a sample outside of a block";
            continue;
        }
        if (line.starts_with("MSG")) {
            const std::size_t blank = line.find(' ');
            if (blank == std::string::npos || std::stod(line.substr(4, blank - 4)) < 0.0)
                reading.failure = "a message it cannot take apart: " + line;
            reading.messages.push_back(line.substr(blank + 1));
        }
        if (!std::isdigit(static_cast<unsigned char>(line[0])))
            continue;
        const std::vector<std::string> cells = split_at_tabs(line);
        if (cells.size() != columns)
            reading.failure = "a row of another length: " + line;
        const double time = std::stod(cells.at(0));
        if (cells[0].find('.') == std::string::npos && time > 2147483647.0)
            reading.failure = "a whole number of more than 31 bits";
        reading.samples.push_back({time, value_or_dot(cells.at(1)), value_or_dot(cells.at(2)),
                                   value_or_dot(cells.at(3)).value_or(0.0)});
    }
    if (ends != 1)
        reading.failure = "no START, or not one END after it";
    return reading;
}

/// How many samples MNE finds again where there are several blocks: it takes the nearest one, not more than
/// half a step away, to each of evenly spaced times from the first on.
inline double merged_as_mne(const std::vector<ReadSample>& samples, double rate_hz) {
    const double step = 1000.0 / rate_hz;
    double found = 0.0;
    std::size_t next = 0;
    for (std::size_t n = 0; next < samples.size(); ++n) {
        const double time = samples[0].time + static_cast<double>(n) * step;
        std::size_t after = next;
        while (after < samples.size() && samples[after].time < time - 0.5 * step)
            ++after;
        if (after < samples.size() && std::abs(samples[after].time - time) <= 0.5 * step) {
            ++found;
            ++after;
            while (after < samples.size() && samples[after].time == samples[after - 1].time)
                ++after;
        }
        next = after;
    }
    return found;
}

/// MNE: blocks of START to END only, as many of the one as of the other; a SAMPLES line that has a rate, and
/// PUPIL; a date it can parse; samples in the order of their times; in the first sample, a cell of 3, 5, 13
/// or 17 characters after the first place that does not begin with a digit is taken for the status; exactly n
/// VALIDATE lines after a validation of n points.
inline AscReading read_as_mne(const std::string& text) {
    AscReading reading;
    bool in_block = false, has_samples_line = false, has_date = false, has_pupil = false;
    int starts = 0;
    double rate_hz = 0.0;
    std::size_t columns = 0;
    const std::vector<std::string> lines = lines_of(text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::vector<std::string> words = words_of(lines[i]);
        if (words.empty())
            continue;
        static const std::regex date(R"(\*\* DATE: \w{3} \w{3} [ \d]\d \d\d:\d\d:\d\d \d{4})");
        has_date |= std::regex_match(lines[i], date);
        if (words[0] == "START") {
            in_block = true;
            has_samples_line = false;
            ++starts;
        } else if (words[0] == "END") {
            if (!in_block || !has_samples_line)
                reading.failure = "END without START, or a block without SAMPLES";
            in_block = false;
            ++reading.blocks;
        } else if (words[0] == "SAMPLES" && in_block) {
            const auto rate = std::find(words.begin(), words.end(), "RATE");
            if (rate == words.end() || rate + 1 == words.end() || std::stod(*(rate + 1)) <= 0.0)
                reading.failure = "no rate";
            else
                rate_hz = std::stod(*(rate + 1));
            const bool both = words.size() > 3 && words[2] == "LEFT" && words[3] == "RIGHT";
            columns = both ? 7 : 4;
            has_samples_line = true;
        } else if (words[0] == "PUPIL" && in_block) {
            has_pupil = true;
        } else if (words[0] == "MSG") {
            if (words.size() < 3)
                reading.failure = "an empty message";
            if (lines[i].find("!CAL VALIDATION") != std::string::npos) {
                const int points = std::stoi(words.at(4).substr(2));
                for (int n = 1; n <= points; ++n)
                    if (lines.at(i + static_cast<std::size_t>(n)).find("VALIDATE") == std::string::npos)
                        reading.failure = "a validation without its points";
            }
            const bool is_dropped = lines[i].find(';') != std::string::npos ||
                                    lines[i].find("!V") != std::string::npos ||
                                    lines[i].find("!MODE") != std::string::npos;
            if (in_block && !is_dropped)
                reading.messages.push_back(lines[i].substr(lines[i].find(' ') + 1));
        } else if (in_block && std::isdigit(static_cast<unsigned char>(words[0][0]))) {
            std::size_t kept = words.size();
            for (std::size_t cell = 3; cell < words.size() && reading.samples.empty(); ++cell) {
                const std::size_t length = words[cell].size();
                kept -= !std::isdigit(static_cast<unsigned char>(words[cell][0])) &&
                        (length == 3 || length == 5 || length == 13 || length == 17);
            }
            if (reading.samples.empty() && kept != columns)
                reading.failure = "other columns than the header says: " + lines[i];
            if (!reading.samples.empty() && std::stod(words[0]) < reading.samples.back().time)
                reading.failure = "a sample before the one before it";
            reading.samples.push_back({std::stod(words[0]), value_or_dot(words.at(1)),
                                       value_or_dot(words.at(2)), value_or_dot(words.at(3)).value_or(0.0)});
        }
    }
    if (reading.blocks == 0 || starts != reading.blocks)
        reading.failure = "not as many END as START";
    if (!has_date || !has_pupil)
        reading.failure = "no date, or no PUPIL";
    reading.samples_after_merge =
        starts > 1 ? merged_as_mne(reading.samples, rate_hz) : static_cast<double>(reading.samples.size());
    return reading;
}

/// pymovements: plain ASCII; regular expressions for samples (a point in each number), for RECCFG, and for
/// START and END with its resolution, from which it computes how many samples there should be.
inline AscReading read_as_pymovements(const std::string& text) {
    AscReading reading;
    if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 126; })) {
        reading.failure = "not ASCII";
        return reading;
    }
    static const std::regex sample(R"((\d+[.]?\d*)\s+(-?\d*[.]\d*)\s+(-?\d*[.]\d*)\s+(\d*[.]\d*)\s+.*)"),
        setup(R"(MSG\s+\d+[.]?\d*\s+RECCFG\s+[A-Z]+\s+(\d+)\s+[012]\s+[012]\s+(L|R|LR)\s*)"),
        coordinates(R"(MSG\s+\d+[.]?\d*\s+GAZE_COORDS\s+([\d.]+) ([\d.]+) ([\d.]+) ([\d.]+)\s*)"),
        start(R"(START\s+(\d+[.]?\d*)\s+(RIGHT|LEFT)\s+(.*))"),
        end(R"(END\s+(\d+[.]?\d*)\s+\s+(.*)\s+RES\s+([\d\.]*)\s+([\d\.]*)\s*)");
    double rate_hz = 0.0, started = 0.0;
    bool has_setup = false;
    std::smatch match;
    for (const std::string& line : lines_of(text)) {
        if (std::regex_match(line, match, setup)) {
            has_setup = true;
            rate_hz = std::stod(match[1]);
        } else if (std::regex_match(line, coordinates)) {
            if (!has_setup)
                reading.failure = "GAZE_COORDS before RECCFG";
        } else if (std::regex_match(line, match, start)) {
            started = std::stod(match[1]);
        } else if (std::regex_match(line, match, end)) {
            reading.expected_samples += 1e-3 * rate_hz * (std::stod(match[1]) - started);
        } else if (line.starts_with("END")) {
            reading.failure = "an END without resolution";
        } else if (std::regex_match(line, match, sample)) {
            const auto number = [&](int i) {
                return match[i] == "." ? std::nullopt : std::optional(std::stod(match[i]));
            };
            reading.samples.push_back({std::stod(match[1]), number(2), number(3), number(4).value_or(0.0)});
        } else if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0]))) {
            reading.failure = "a sample it does not see: " + line;
        }
    }
    if (!has_setup)
        reading.failure = "no RECCFG";
    return reading;
}

/// PyGazeAnalyser, from a start message on: whole time stamps, messages as "MSG tab time blank text", events
/// with nine characters before their numbers, lost samples known by a pupil of 0.
inline AscReading read_as_pygaze_analyser(const std::string& text, const std::string& start_message) {
    AscReading reading;
    bool has_started = false;
    const auto whole = [&](const std::string& number) {
        const std::vector<std::string> words = words_of(number);
        if (words.size() != 1 || words[0].find_first_not_of("0123456789") != std::string::npos)
            reading.failure = "no whole number: " + number;
        else
            return std::stod(words[0]);
        return 0.0;
    };
    for (const std::string& line : lines_of(text)) {
        has_started |= line.find(start_message) != std::string::npos;
        if (!has_started)
            continue;
        const bool is_begin =
            line.starts_with("SFIX") || line.starts_with("SSACC") || line.starts_with("SBLINK");
        const bool is_end =
            line.starts_with("EFIX") || line.starts_with("ESACC") || line.starts_with("EBLINK");
        if (line.starts_with("MSG")) {
            const std::size_t blank = line.find(' ');
            whole(line.substr(4, blank - 4));
            reading.messages.push_back(line.substr(blank + 1));
        } else if (is_begin) {
            whole(line.substr(9));
        } else if (is_end) {
            const std::vector<std::string> cells = split_at_tabs(line.substr(9));
            for (const std::size_t i : {0u, 1u, 2u})
                whole(cells.at(i));
        } else if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0]))) {
            const std::vector<std::string> cells = split_at_tabs(line);
            ReadSample sample{whole(cells.at(0)), value_or_dot(cells.at(1)), value_or_dot(cells.at(2)),
                              std::stod(cells.at(3))};
            if (sample.pupil != 0.0 && (!sample.x || !sample.y))
                reading.failure = "a place that is missing beside a pupil";
            reading.samples.push_back(sample);
        }
    }
    if (!has_started)
        reading.failure = "no start message";
    return reading;
}

} // namespace overt::testing
