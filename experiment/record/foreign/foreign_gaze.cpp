#include "experiment/record/foreign/foreign_gaze.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/foreign/foreign_asc.h"

namespace overt {
namespace {

struct TimeUnit {
    std::string_view name;
    double us;
};
constexpr std::array time_units{TimeUnit{"s", 1e6}, TimeUnit{"ms", 1e3}, TimeUnit{"us", 1.0},
                                TimeUnit{"ns", 1e-3}};

/// Trackers sample between these: no two units of time agree with one spacing of samples.
constexpr double slowest_hz = 15.0, fastest_hz = 4000.0;

double us_of_unit(const std::string& name, const std::filesystem::path& file) {
    for (const TimeUnit& unit : time_units)
        if (unit.name == name)
            return unit.us;
    throw InputError(
        fmt::format("{}: times in \"{}\": s, ms, us and ns are understood", file.string(), name));
}

/// By the spacing of the first samples.
double found_us_per_unit(const std::filesystem::path& file, const GazeColumns& columns) {
    ForeignTable table(file, columns.names);
    const std::size_t time = table.require(columns.time, "the time");
    const std::optional<std::size_t> kind = columns.kind.empty() ? std::nullopt : table.find(columns.kind);
    std::vector<double> spacings;
    std::optional<double> last;
    while (table.next() && spacings.size() < 2000) {
        if (kind && table.cell(*kind) != columns.samples_word)
            continue;
        const std::optional<double> at = number_in_cell(table.cell(time));
        if (at && last && *at > *last)
            spacings.push_back(*at - *last);
        if (at)
            last = at;
    }
    if (!spacings.empty()) {
        std::ranges::nth_element(spacings,
                                 spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2));
        const double spacing = spacings[spacings.size() / 2];
        for (const TimeUnit& unit : time_units)
            if (const double rate_hz = 1e6 / (spacing * unit.us);
                rate_hz >= slowest_hz && rate_hz <= fastest_hz)
                return unit.us;
    }
    throw InputError(
        fmt::format("{}: by the spacing of its samples, {} is in no unit of time that a tracker could have: "
                    "say it, --columns …,time_unit=s (or ms, us, ns)",
                    file.string(), columns.time));
}

std::optional<Eye> eye_in_cell(std::string_view cell) {
    if (cell == "left" || cell == "Left" || cell == "L" || cell == "l" || cell == "1")
        return Eye::left;
    if (cell == "right" || cell == "Right" || cell == "R" || cell == "r" || cell == "0")
        return Eye::right;
    return std::nullopt;
}

} // namespace

GazeFileReader::GazeFileReader(const std::filesystem::path& file, const GazeColumns& columns,
                               const ScreenGeometry& screen, double us_per_unit, RowReport report)
    : table_(file, columns.names), columns_(columns), screen_(screen), us_per_unit_(us_per_unit),
      report_(std::move(report)), time_(table_.require(columns.time, "the time")) {
    left_ = eye_at(columns.left, "the left eye");
    right_ = eye_at(columns.right, "the right eye");
    single_ = eye_at(columns.single, "gaze");
    eye_ = table_.require_named(columns.eye, "the eye");
    mark_ = table_.require_named(columns.mark, "marks");
    mark_value_ = table_.require_named(columns.mark_value, "marks' values");
    trial_ = table_.require_named(columns.trial, "trials");
    kind_ = table_.require_named(columns.kind, "kinds of rows");
    fine_time_ = table_.require_named(columns.fine_time, "the tracker's clock");
}

std::optional<GazeFileReader::EyeAt> GazeFileReader::eye_at(const GazeColumns::OfEye& eye,
                                                            const char* which) const {
    if (!eye.is_there())
        return std::nullopt;
    return EyeAt{table_.require(eye.x, which), table_.require(eye.y, which),
                 table_.require_named(eye.pupil, "the pupil"),
                 table_.require_named(eye.validity, "validity")};
}

void GazeFileReader::left_out(const std::string& why) {
    if (report_)
        report_(fmt::format("{}: {}", table_.place(), why));
}

bool GazeFileReader::is_valid(std::string_view cell) const {
    if (!columns_.valid.empty())
        return cell == columns_.valid;
    if (const std::optional<double> number = number_in_cell(cell))
        return columns_.greatest_validity ? *number <= *columns_.greatest_validity
                                          : *number >= columns_.least_validity;
    return cell == "Valid" || cell == "valid" || cell == "True" || cell == "true" || cell == "yes";
}

TrackerTime GazeFileReader::sample_time(TrackerTime at) {
    const std::optional<double> fine = number_in_cell(table_.cell(fine_time_));
    if (!fine)
        return at;
    // The mean of at most so many samples: rounding to ms leaves some 10 us, and clocks that drift are
    // followed.
    constexpr int most = 1000;
    // Farther apart than rounding ever is: the tracker's clock was set.
    constexpr double set_anew_us = 10'000.0;
    const double shift = static_cast<double>(at.time_since_epoch().count()) - *fine;
    if (samples_in_shift_ == 0 || std::abs(shift - fine_shift_us_) > set_anew_us) {
        samples_in_shift_ = 0;
        fine_shift_us_ = shift;
    }
    samples_in_shift_ = std::min(samples_in_shift_ + 1, most);
    fine_shift_us_ += (shift - fine_shift_us_) / samples_in_shift_;
    return TrackerTime{TrackerClock::duration(std::llround(*fine + fine_shift_us_))};
}

bool GazeFileReader::is_of_sample() const {
    if (kind_)
        return table_.cell(*kind_) == columns_.samples_word;
    // A mark may have a row of its own, in which the columns of gaze are empty, and lost gaze has its
    // validity.
    if (!mark_ || is_missing_cell(table_.cell(*mark_)))
        return true;
    for (const std::optional<EyeAt>& eye : {left_, right_, single_})
        if (eye && (!eye->validity || !is_missing_cell(table_.cell(*eye->validity)) ||
                    !is_missing_cell(table_.cell(eye->x))))
            return true;
    return false;
}

ScreenPoint GazeFileReader::on_screen(double x, double y) const {
    if (columns_.unit == "px")
        return {x, columns_.y_goes_up ? screen_.screen_px.y - y : y};
    if (columns_.unit == "normalised")
        return {x * screen_.screen_px.x, (columns_.y_goes_up ? 1.0 - y : y) * screen_.screen_px.y};
    // Degrees from the middle, to the right and, as angles usually are given, up.
    const glm::dvec2 px_per_mm{screen_.screen_px.x / screen_.screen_mm.x,
                               screen_.screen_px.y / screen_.screen_mm.y};
    constexpr double radians = 3.14159265358979323846 / 180.0;
    return {screen_.centre().x_px + std::tan(x * radians) * screen_.viewing_distance_mm * px_per_mm.x,
            screen_.centre().y_px - std::tan(y * radians) * screen_.viewing_distance_mm * px_per_mm.y};
}

void GazeFileReader::add_sample(TrackerTime at, Eye eye, const EyeAt& columns) {
    GazeSample sample{at, eye, std::nullopt, 0.0f};
    const std::string_view x_cell = table_.cell(columns.x), y_cell = table_.cell(columns.y);
    const bool is_lost = is_missing_cell(x_cell) || is_missing_cell(y_cell) ||
                         (columns.validity && !is_valid(table_.cell(*columns.validity)));
    if (!is_lost) {
        const std::optional<double> x = number_in_cell(x_cell), y = number_in_cell(y_cell);
        if (!x || !y)
            return left_out(fmt::format("{} is \"{}\", and no number",
                                        table_.columns()[x ? columns.y : columns.x], x ? y_cell : x_cell));
        if (!(columns_.zero_is_lost && *x == 0.0 && *y == 0.0))
            sample.gaze = on_screen(*x, *y);
    }
    if (columns.pupil)
        if (const std::optional<double> pupil = number_in_cell(table_.cell(*columns.pupil));
            pupil && *pupil > 0.0)
            sample.pupil_area = static_cast<float>(*pupil);
    ready_.push_back({at, sample, {}});
}

void GazeFileReader::add_marks(TrackerTime at) {
    const auto text_of = [](std::string_view cell) {
        return is_missing_cell(cell) ? std::string() : std::string(cell);
    };
    if (mark_) {
        std::string text = text_of(table_.cell(*mark_));
        if (const std::string value = text_of(table_.cell(mark_value_)); !text.empty() && !value.empty())
            text += " " + value;
        // A value that stays over samples is one mark; of a row of its own each is.
        const bool is_of_samples = !kind_ && !columns_.is_of_marks_alone();
        if (!text.empty() && !(is_of_samples && text == last_mark_))
            ready_.push_back({at, std::nullopt, {at, text, false}});
        last_mark_ = text;
    }
    if (trial_)
        if (const std::string text = text_of(table_.cell(*trial_)); text != last_trial_) {
            ready_.push_back({at, std::nullopt, {at, text, true}});
            last_trial_ = text;
        }
}

bool GazeFileReader::read_row() {
    if (!table_.next())
        return false;
    const std::optional<double> time = number_in_cell(table_.cell(time_));
    if (!time) {
        left_out(fmt::format("{} is \"{}\", and no time", table_.columns()[time_], table_.cell(time_)));
        return true;
    }
    if (const std::size_t point = table_.cell(time_).find_first_of(".,"); point != std::string_view::npos)
        decimals_ = std::max(decimals_, table_.cell(time_).size() - point - 1);
    const TrackerTime at{TrackerClock::duration(std::llround(*time * us_per_unit_))};
    if (kind_ && !columns_.messages_word.empty() && table_.cell(*kind_) == columns_.messages_word) {
        std::string_view text = table_.cell(std::size_t{3});
        if (constexpr std::string_view lead = "# Message: "; text.starts_with(lead))
            text.remove_prefix(lead.size());
        ready_.push_back({at, std::nullopt, {at, std::string(text), false}});
        return true;
    }
    add_marks(at);
    if (!is_of_sample())
        return true;
    const TrackerTime sampled = sample_time(at);
    if (left_)
        add_sample(sampled, Eye::left, *left_);
    if (right_)
        add_sample(sampled, Eye::right, *right_);
    if (single_) {
        const std::optional<Eye> eye =
            eye_ ? eye_in_cell(table_.cell(*eye_)) : std::optional(columns_.single_eye);
        if (eye)
            add_sample(sampled, *eye, *single_);
        else
            left_out(
                fmt::format("{} is \"{}\", and no eye (left or right)", columns_.eye, table_.cell(*eye_)));
    }
    return true;
}

TrackerClock::duration GazeFileReader::tick() const {
    const double us = us_per_unit_ * std::pow(10.0, -static_cast<double>(decimals_));
    return TrackerClock::duration(std::max<std::int64_t>(1, std::llround(us)));
}

bool GazeFileReader::next(ForeignItem& item) {
    while (ready_.empty())
        if (!read_row())
            return false;
    item = std::move(ready_.front());
    ready_.pop_front();
    return true;
}

ForeignGaze::ForeignGaze(std::vector<std::filesystem::path> files, const std::optional<GazeColumns>& given,
                         const ScreenGeometry& screen, const GazeReading& reading)
    : screen_(screen) {
    if (is_asc_file(files.front())) {
        if (given)
            throw InputError(
                fmt::format("{}: is the recording of an EyeLink, whose lines have no names: leave "
                            "out --columns",
                            files.front().string()));
        asc_ = std::make_unique<AscGaze>(files, reading);
        for (const auto& file : files)
            sources_.push_back({file, {}});
        return;
    }
    for (std::size_t i = 0; i < files.size(); ++i) {
        GazeColumns columns = i == 0 && given ? *given : known_gaze_columns(files[i], reading.takes_any_gaze);
        if (i == 0 && columns.is_of_marks_alone())
            throw InputError(
                fmt::format("{}: has marks and no gaze: name the table of gaze first", files[i].string()));
        for (const auto& more : columns.marks)
            if (std::ranges::find(files, more) == files.end())
                files.push_back(more);
        if (!columns.other_eye.empty() && std::ranges::find(files, columns.other_eye) == files.end())
            files.push_back(columns.other_eye);
        sources_.push_back({files[i], std::move(columns)});
    }
    if (sources_.front().columns.unit == "degrees" &&
        (screen.screen_mm.x <= 0.0 || screen.viewing_distance_mm <= 0.0))
        throw InputError(fmt::format("{}: places in degrees need the screen's size and distance in [display]",
                                     files.front().string()));
    for (Source& source : sources_)
        if (source.columns.time_unit.empty()) {
            const double us = source.columns.is_of_marks_alone()
                                  ? us_per_unit_
                                  : found_us_per_unit(source.file, source.columns);
            source.columns.time_unit = std::ranges::find(time_units, us, &TimeUnit::us)->name;
            if (&source == &sources_.front())
                us_per_unit_ = us;
        } else if (&source == &sources_.front())
            us_per_unit_ = us_of_unit(source.columns.time_unit, source.file);
}

ForeignGaze::~ForeignGaze() = default;

std::vector<std::filesystem::path> ForeignGaze::files() const {
    std::vector<std::filesystem::path> files;
    for (const Source& source : sources_)
        files.push_back(source.file);
    return files;
}

void ForeignGaze::read(const std::function<void(const ForeignItem&)>& take) const {
    if (asc_)
        return asc_->read(take);
    struct Open {
        GazeFileReader reader;
        ForeignItem item{};
        bool has = false;
    };
    std::vector<Open> open;
    for (const Source& source : sources_) {
        open.push_back({GazeFileReader(source.file, source.columns, screen_,
                                       us_of_unit(source.columns.time_unit, source.file), {})});
        open.back().has = open.back().reader.next(open.back().item);
    }
    for (;;) {
        Open* earliest = nullptr;
        for (Open& one : open)
            if (one.has && (!earliest || one.item.at < earliest->item.at))
                earliest = &one;
        if (!earliest)
            return;
        take(earliest->item);
        earliest->has = earliest->reader.next(earliest->item);
    }
}

GazeSurvey ForeignGaze::survey(const RowReport& report) const {
    if (asc_)
        return asc_->survey(screen_.screen_px, report);
    GazeSurvey survey;
    survey.columns = sources_.front().columns;
    for (const Source& source : sources_) {
        survey.remarks.insert(survey.remarks.end(), source.columns.remarks.begin(),
                              source.columns.remarks.end());
        GazeFileReader reader(source.file, source.columns, screen_,
                              us_of_unit(source.columns.time_unit, source.file),
                              [&](const std::string& line) {
                                  ++survey.rows_left_out;
                                  if (report)
                                      report(line);
                              });
        std::optional<TrackerTime> last;
        std::vector<std::int64_t> spacings;
        for (ForeignItem item; reader.next(item);) {
            if (!item.sample) {
                survey.marks.push_back(item.mark);
                continue;
            }
            if (last && item.at < *last)
                throw InputError(
                    fmt::format("{}: its time goes back, from {} to {} us: sort the rows by {}, or import "
                                "each run of the tracker's clock by itself",
                                reader.table().place(), last->time_since_epoch().count(),
                                item.at.time_since_epoch().count(), source.columns.time));
            if (last && item.at > *last)
                if (spacings.size() < 100000)
                    spacings.push_back((item.at - *last).count());
            survey.first = survey.samples == 0 ? item.at : std::min(survey.first, item.at);
            survey.last = survey.samples == 0 ? item.at : std::max(survey.last, item.at);
            last = item.at;
            ++survey.samples;
            survey.without_gaze += !item.sample->gaze;
            (item.sample->eye == Eye::left ? survey.has_left : survey.has_right) = true;
        }
        if (!spacings.empty() && survey.rate_hz <= 0.0) {
            std::ranges::nth_element(spacings,
                                     spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2));
            survey.rate_hz = 1e6 / static_cast<double>(spacings[spacings.size() / 2]);
            survey.tick = reader.tick();
        }
    }
    std::ranges::stable_sort(survey.marks, {}, &GazeMark::at);
    const std::string name = sources_.front().file.string();
    if (survey.samples == 0)
        throw InputError(fmt::format("{}: has no sample of gaze", name));
    if (survey.rows_left_out > survey.samples)
        throw InputError(fmt::format(
            "{}: {} rows could not be read, and {} samples were: see the first of them above, and "
            "say with --columns which column is which",
            name, survey.rows_left_out, survey.samples));
    return survey;
}

} // namespace overt
