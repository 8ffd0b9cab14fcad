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

std::string AscWriter::written(TrackerTime time) const {
    const TrackerTime from_base = time - std::chrono::milliseconds(layout_.base_ms);
    if (!layout_.fractional_times)
        return fmt::format("{}", asc_milliseconds(from_base));
    return written(from_base.time_since_epoch());
}

std::string AscWriter::written(TrackerClock::duration duration) const {
    const std::int64_t us = duration.count();
    if (!layout_.fractional_times || us % 1000 == 0)
        return fmt::format("{}", us / 1000);
    std::string text;
    append_scaled(text, us, 3);
    text.resize(text.find_last_not_of('0') + 1);
    return text;
}

void AscWriter::message(TrackerTime at, std::string_view text) {
    if (Words words(text); words.next() == "RECCFG") {
        words.next();
        if (const std::optional<double> rate_hz = number_of(words.next()); rate_hz && *rate_hz >= 1.0)
            layout_.rate_hz = *rate_hz;
    }
    file_.text() += fmt::format("MSG\t{} {}", written(at), ascii_of(text));
    end_line();
}

AscStart asc_start(std::string_view text, const AscLayout& layout) {
    AscStart start;
    start.pupil_is_diameter = layout.pupil_is_diameter;
    Words words(text);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (word == "LEFT")
            start.left = true;
        else if (word == "RIGHT")
            start.right = true;
        else if (word == "PUPIL")
            start.pupil_is_diameter = words.next() == "DIAMETER";
        else
            start.tracking += fmt::format(" {}", word);
    }
    if (!start.left && !start.right) {
        start.left = layout.has_left;
        start.right = layout.has_right;
    }
    return start;
}

void AscWriter::set_eyes(const AscStart& start) {
    layout_.has_left = start.left;
    layout_.has_right = start.right;
    layout_.has_status = start.tracking.find("TRACKING") != std::string::npos;
}

void AscWriter::start(TrackerTime at, const AscStart& start) {
    set_eyes(start);
    const std::string_view eyes = layout_.eye_names();
    line(fmt::format("START\t{} \t{}\tSAMPLES\tEVENTS", written(at), eyes));
    line("PRESCALER\t1");
    line("VPRESCALER\t1");
    line(start.pupil_is_diameter ? "PUPIL\tDIAMETER" : "PUPIL\tAREA");
    std::string tracking = ascii_of(start.tracking);
    std::replace(tracking.begin(), tracking.end(), ' ', '\t');
    for (const char* what : {"EVENTS", "SAMPLES"})
        line(fmt::format("{}\tGAZE\t{}\tRATE\t{:7.2f}{}", what, eyes, layout_.rate_hz, tracking));
}

void AscWriter::end(TrackerTime at, std::string_view resolution) {
    std::string x = ".", y = ".";
    if (const std::size_t blank = resolution.find(' '); blank != std::string_view::npos) {
        x = resolution.substr(0, blank);
        y = resolution.substr(blank + 1);
    } else if (layout_.px_per_deg_x && layout_.px_per_deg_y) {
        x = fmt::format("{:.2f}", *layout_.px_per_deg_x);
        y = fmt::format("{:.2f}", *layout_.px_per_deg_y);
    }
    line(fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t{:>7}\t{:>7}", written(at), x, y));
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

void AscWriter::samples(std::span<const GazeSample> samples) {
    const TrackerTime time = samples.front().sampled_at;
    if (layout_.fractional_times)
        append_scaled(file_.text(), time.time_since_epoch().count() - 1000 * layout_.base_ms, 3);
    else
        append_scaled(file_.text(), asc_milliseconds(time) - layout_.base_ms, 0);
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
    if (layout_.has_status)
        file_.text() += layout_.has_left && layout_.has_right ? "\t....." : "\t...";
    end_line();
}

void AscWriter::event_begin(const GazeEvent& event) {
    append_prefix(file_.text(), event, true);
    file_.text() += written(event.start);
    end_line();
}

void AscWriter::event_end(const GazeEvent& event) {
    std::string& text = file_.text();
    append_prefix(text, event, false);
    text += fmt::format("{}\t{}\t{}", written(event.start), written(event.end), written(event.duration));
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
                     written(event.start), values));
}

} // namespace overt
