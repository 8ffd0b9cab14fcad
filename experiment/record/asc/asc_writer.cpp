#include "experiment/record/asc/asc_writer.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "experiment/base/number_text.h"
#include "experiment/base/utf8_text.h"
#include "experiment/record/asc/asc_words.h"
#include "experiment/record/tables/joined_cells.h"

namespace overt {
namespace {

/// As wide as edf2asc has it, and with no more decimals than needed: in samples and places at least one, for
/// readers take a number without a point for something else.
void append_number(std::string& text, double number, int decimals, int least_decimals) {
    constexpr std::size_t width = 7;
    std::string digits;
    append_fixed(digits, number, decimals);
    for (int extra = decimals - least_decimals; extra > 0 && digits.back() == '0'; --extra)
        digits.pop_back();
    if (digits.back() == '.')
        digits.pop_back();
    // MNE takes a cell of five characters that begins with no digit, in the first sample, for the status.
    if (digits.size() == 5 && digits.front() == '-' && least_decimals > 0)
        digits += '0';
    text += '\t';
    text.append(width - std::min(width, digits.size()), ' ');
    text += digits;
}

void append_place(std::string& text, const std::optional<ScreenPoint>& place) {
    if (!place) {
        text += "\t   .\t   .";
        return;
    }
    append_number(text, place->x_px, pixel_decimals, 1);
    append_number(text, place->y_px, pixel_decimals, 1);
}

void append_or_dot(std::string& text, const std::optional<double>& number, int least_decimals) {
    if (number)
        append_number(text, *number, pixel_decimals, least_decimals);
    else
        text += "\t      .";
}

/// Nine characters: what follows is told by its place.
std::string_view prefix(GazeEvent::Kind kind, bool begins) {
    switch (kind) {
    case GazeEvent::Kind::fixation:
        return begins ? "SFIX {}   " : "EFIX {}   ";
    case GazeEvent::Kind::saccade:
        return begins ? "SSACC {}  " : "ESACC {}  ";
    default:
        return begins ? "SBLINK {} " : "EBLINK {} ";
    }
}

void append_prefix(std::string& text, const GazeEvent& event, bool begins) {
    text += fmt::format(fmt::runtime(prefix(event.kind, begins)), event.eye == Eye::left ? 'L' : 'R');
}

} // namespace

std::int64_t asc_milliseconds(TrackerTime time) {
    return std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

void AscWriter::end_line() {
    file_.text() += '\n';
    ++lines_;
    file_.flush_if_full();
}

void AscWriter::line(std::string_view text) {
    file_.text() += text;
    end_line();
}

// Tabs stay: they are part of the table.
void AscWriter::note(std::string_view text) {
    for (std::size_t tab = text.find('\t'); tab != std::string_view::npos; tab = text.find('\t')) {
        file_.text() += ascii_of(text.substr(0, tab)) + '\t';
        text.remove_prefix(tab + 1);
    }
    line(ascii_of(text));
}

void AscWriter::message(std::int64_t ms, std::string_view text) {
    if (Words words(text); words.next() == "RECCFG") {
        words.next();
        if (const std::optional<double> rate_hz = number_of(words.next()); rate_hz && *rate_hz >= 1.0)
            layout_.rate_hz = *rate_hz;
    }
    file_.text() += fmt::format("MSG\t{} {}", ms - layout_.base_ms, ascii_of(text));
    end_line();
}

void AscWriter::start(std::int64_t ms, std::string_view recorded) {
    if (!recorded.empty()) {
        layout_.has_left = recorded.find("LEFT") != std::string_view::npos;
        layout_.has_right = recorded.find("RIGHT") != std::string_view::npos;
    }
    const std::string_view eyes = layout_.eye_names();
    line(fmt::format("START\t{} \t{}\tSAMPLES\tEVENTS", ms - layout_.base_ms, eyes));
    line("PRESCALER\t1");
    line("VPRESCALER\t1");
    line(layout_.pupil_is_diameter ? "PUPIL\tDIAMETER" : "PUPIL\tAREA");
    for (const char* what : {"EVENTS", "SAMPLES"})
        line(
            fmt::format("{}\tGAZE\t{}\tRATE\t{:7.2f}\tTRACKING\tCR\tFILTER\t2", what, eyes, layout_.rate_hz));
}

void AscWriter::end(std::int64_t ms, std::string_view resolution) {
    std::string x = ".", y = ".";
    if (const std::size_t blank = resolution.find(' '); blank != std::string_view::npos) {
        x = resolution.substr(0, blank);
        y = resolution.substr(blank + 1);
    } else if (layout_.px_per_deg_x && layout_.px_per_deg_y) {
        x = fmt::format("{:.2f}", *layout_.px_per_deg_x);
        y = fmt::format("{:.2f}", *layout_.px_per_deg_y);
    }
    line(fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t{:>7}\t{:>7}", ms - layout_.base_ms, x, y));
}

void AscWriter::eye(const GazeSample* sample) {
    std::string& text = file_.text();
    if (!sample || !sample->gaze) {
        // A pupil of zero is what tells some readers that there is no gaze.
        text += "\t   .\t   .\t    0.0";
        return;
    }
    append_place(text, sample->gaze);
    append_number(text, shortest_decimal(sample->pupil_area), pupil_decimals, 1);
}

void AscWriter::append_stamp(TrackerTime time) {
    if (layout_.fractional_times)
        append_scaled(file_.text(), time.time_since_epoch().count() - 1000 * layout_.base_ms, 3);
    else
        append_scaled(file_.text(), written_ms(time), 0);
}

void AscWriter::samples(std::span<const GazeSample> samples) {
    append_stamp(samples.front().sampled_at);
    const auto of = [&](Eye eye) -> const GazeSample* {
        for (const GazeSample& sample : samples)
            if (sample.eye == eye)
                return &sample;
        return nullptr;
    };
    if (layout_.has_left)
        eye(of(Eye::left));
    if (layout_.has_right)
        eye(of(Eye::right));
    file_.text() += layout_.has_left && layout_.has_right ? "\t....." : "\t...";
    end_line();
}

void AscWriter::event_begin(const GazeEvent& event) {
    append_prefix(file_.text(), event, true);
    append_stamp(event.start);
    end_line();
}

void AscWriter::event_end(const GazeEvent& event) {
    std::string& text = file_.text();
    append_prefix(text, event, false);
    append_stamp(event.start);
    text += '\t';
    append_stamp(event.end);
    text += '\t';
    if (layout_.fractional_times)
        append_scaled(text, event.duration.count(), 3);
    else
        append_scaled(text, event.duration.count() / 1000, 0);
    if (event.kind == GazeEvent::Kind::fixation) {
        append_place(text, event.place);
        append_or_dot(text, event.pupil, 0);
    } else if (event.kind == GazeEvent::Kind::saccade) {
        append_place(text, event.place);
        append_place(text, event.arrival);
        append_or_dot(text, event.amplitude_deg, 2);
        append_or_dot(text, event.peak_velocity_deg_s, 0);
    }
    end_line();
}

void AscWriter::port(const GazeEvent& event) {
    std::string values = ascii_of(event.text);
    for (char& c : values)
        c = c == ' ' ? '\t' : c;
    line(fmt::format("{}\t{}\t{}", event.kind == GazeEvent::Kind::button ? "BUTTON" : "INPUT",
                     written_ms(event.start), values));
}

} // namespace overt
