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

/// R's eyelinker: START, EVENTS or SAMPLES in the same block; all rows of samples with the same number of
/// tab-separated cells, those of another are dropped; a version line it can take a number from.
inline AscReading read_as_eyelinker(const std::string& text) {
    AscReading reading;
    const std::vector<std::string> lines = lines_of(text);
    bool has_start = false, has_events = false, in_block = false;
    std::map<std::size_t, int> row_lengths;
    for (const std::string& line : lines) {
        has_start |= line.starts_with("START");
        has_events |= line.starts_with("EVENTS\t");
        if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])))
            ++row_lengths[split_at_tabs(line).size()];
    }
    if (!has_start)
        reading.failure = "no START";
    if (!has_events)
        reading.failure = "no EVENTS line";
    if (row_lengths.size() != 1)
        reading.failure = "rows of different lengths";
    static const std::regex version(R"(\*\* EYELINK II.* v([0-9.]+) [A-Za-z].*)");
    if (std::none_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return std::regex_match(line, version); }))
        reading.failure = "no version";
    for (const std::string& line : lines) {
        if (line.starts_with("START"))
            in_block = true;
        if (line.starts_with("END"))
            in_block = false;
        if (!in_block || line.empty())
            continue;
        if (line.starts_with("MSG")) {
            const std::size_t blank = line.find(' ');
            if (blank == std::string::npos || std::stod(line.substr(4, blank - 4)) < 0.0)
                reading.failure = "a message it cannot take apart: " + line;
            reading.messages.push_back(line.substr(blank + 1));
        }
        if (!std::isdigit(static_cast<unsigned char>(line[0])))
            continue;
        const std::vector<std::string> cells = split_at_tabs(line);
        reading.samples.push_back({std::stod(cells.at(0)), value_or_dot(cells.at(1)),
                                   value_or_dot(cells.at(2)), value_or_dot(cells.at(3)).value_or(0.0)});
    }
    return reading;
}

/// MNE: blocks of START to END only, each with a SAMPLES line that has a rate; a date it can parse; messages
/// whose first word is a number are taken for an offset; exactly n VALIDATE lines after a validation of n
/// points.
inline AscReading read_as_mne(const std::string& text) {
    AscReading reading;
    bool in_block = false, has_samples_line = false, has_date = false;
    int blocks = 0;
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
        } else if (words[0] == "END") {
            if (!in_block || !has_samples_line)
                reading.failure = "END without START, or a block without SAMPLES";
            in_block = false;
            ++blocks;
        } else if (words[0] == "SAMPLES" && in_block) {
            const auto rate = std::find(words.begin(), words.end(), "RATE");
            if (rate == words.end() || rate + 1 == words.end() || std::stod(*(rate + 1)) <= 0.0)
                reading.failure = "no rate";
            has_samples_line = true;
        } else if (words[0] == "MSG") {
            if (words.size() < 3)
                reading.failure = "an empty message";
            if (lines[i].find("!CAL VALIDATION") != std::string::npos) {
                const int points = std::stoi(words.at(4).substr(2));
                for (int n = 1; n <= points; ++n)
                    if (lines.at(i + static_cast<std::size_t>(n)).find("VALIDATE") == std::string::npos)
                        reading.failure = "a validation without its points";
            }
            const bool is_dropped =
                lines[i].find(';') != std::string::npos || lines[i].find("!V") != std::string::npos;
            if (in_block && !is_dropped)
                reading.messages.push_back(lines[i].substr(lines[i].find(' ') + 1));
        } else if (in_block && std::isdigit(static_cast<unsigned char>(words[0][0]))) {
            reading.samples.push_back({std::stod(words[0]), value_or_dot(words.at(1)),
                                       value_or_dot(words.at(2)), value_or_dot(words.at(3)).value_or(0.0)});
        }
    }
    if (blocks == 0 || in_block)
        reading.failure = "no whole block";
    if (!has_date)
        reading.failure = "no date";
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

/// PyGazeAnalyser, from a start message on: whole time stamps, messages as «MSG tab time blank text», events
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
