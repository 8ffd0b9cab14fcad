#include "experiment/record/asc/asc_conventions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "experiment/record/asc/asc_files.h"
#include "experiment/record/asc/asc_sample_words.h"
#include "experiment/record/asc/asc_stamps.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

constexpr double usual_least_pupil = 15.0, largest_pupil = 1e6;

/// How often a number stands for both coordinates of a place.
struct DoubledNumber {
    std::int64_t without_pupil = 0;    ///< in samples whose pupil is none by edf2asc's own rule
    std::int64_t with_equal_pupil = 0; ///< in samples whose pupil is the number, too
    std::int64_t of_events = 0;
};

/// Goes through a file's lines and counts what tells its conventions.
class ConventionFinder {
  public:
    void take(std::string_view line) {
        if (!line.empty() && line.back() == '\r')
            line.remove_suffix(1);
        if (line.empty() || line.size() > longest_asc_line)
            return;
        if (is_digit(line.front()))
            take_sample(line);
        else if (line.starts_with("EFIX") || line.starts_with("ESACC"))
            take_event(line);
        else if (line.starts_with("MSG"))
            take_message(line);
        else if (line.find("overt recorded this") != std::string_view::npos)
            is_own_export_ = true;
    }
    AscConventions found() const;

  private:
    void take_sample(std::string_view line);
    void take_eye(std::string_view x, std::string_view y, std::string_view pupil);
    void take_event(std::string_view line);
    void take_message(std::string_view line);
    void take_stamp(std::string_view word);
    DoubledNumber* doubled(double number);
    bool is_off_screen(double number) const {
        return number < 0.0 || (width_px_ > 0.0 && number > std::max(width_px_, height_px_));
    }
    std::optional<double> missing_number() const;
    double least_pupil() const;

    std::map<double, DoubledNumber> doubled_;   ///< by the number
    std::map<std::string, std::int64_t> words_; ///< that stand for both coordinates, and how often
    std::int64_t without_pupil_ = 0; ///< of eyes that have numbers for their places: below the rule
    std::int64_t small_pupils_ = 0, pupils_ = 0;
    double width_px_ = 0.0, height_px_ = 0.0; ///< of the screen; 0: not known
    bool is_own_export_ = false;              ///< of this program
    bool has_samples_ = false;
    bool any_rounded_ = false, all_rounded_ = true;
    std::optional<std::int64_t> last_us_;
    std::int64_t steps_ = 0, steps_us_ = 0;
};

DoubledNumber* ConventionFinder::doubled(double number) {
    constexpr std::size_t most_kept = 10'000; // gaze is hardly ever on the diagonal
    const auto found = doubled_.find(number);
    if (found != doubled_.end())
        return &found->second;
    return doubled_.size() < most_kept ? &doubled_[number] : nullptr;
}

void ConventionFinder::take_eye(std::string_view x, std::string_view y, std::string_view pupil) {
    const std::optional<double> x_px = number_of(x), y_px = number_of(y), size = number_of(pupil);
    constexpr std::size_t most_words = 100;
    if (!x_px && !y_px && x == y && !is_missing(x) && words_.size() < most_words)
        ++words_[std::string(x)];
    if (!x_px || !y_px || !size || std::abs(*x_px) > largest_coordinate_px)
        return;
    const bool has_pupil = *size >= usual_least_pupil;
    without_pupil_ += !has_pupil;
    if (*x_px == *y_px) {
        if (DoubledNumber* const number = doubled(*x_px)) {
            number->without_pupil += !has_pupil;
            number->with_equal_pupil += *size == *x_px;
        }
        if (!has_pupil)
            return;
    }
    pupils_ += has_pupil;
    small_pupils_ += *size > 0.0 && !has_pupil;
}

void ConventionFinder::take_sample(std::string_view line) {
    has_samples_ = true;
    const AscSampleWords words = split_at_blanks(line);
    take_stamp(words.time);
    if (words.count >= 3)
        take_eye(words.values[0], words.values[1], words.values[2]);
    constexpr std::size_t status_of_both = 5;
    if (words.count >= 6 && words.status.size() == status_of_both)
        take_eye(words.values[3], words.values[4], words.values[5]);
}

void ConventionFinder::take_stamp(std::string_view word) {
    constexpr std::int64_t longest_step_us = 50'000;
    const std::optional<std::int64_t> us = asc_time_us(word);
    if (!us)
        return;
    if (last_us_ && *us >= *last_us_ && *us - *last_us_ <= longest_step_us) {
        ++steps_;
        steps_us_ += *us - *last_us_;
    }
    last_us_ = *us;
    // Below, single precision has all half milliseconds.
    constexpr std::int64_t first_rounded_ms = std::int64_t{1} << 23;
    if (*us / 1000 < first_rounded_ms)
        return;
    const bool has_fraction = word.find_first_of(".,") != std::string_view::npos;
    any_rounded_ = true;
    all_rounded_ = all_rounded_ && has_fraction && *us % step_of_rounded_stamps_us(*us) == 0;
}

void ConventionFinder::take_event(std::string_view line) {
    Words words(line);
    const bool is_saccade = words.next() == "ESACC";
    for (int i = 0; i < 4; ++i)
        words.next(); // eye, begin, end, duration
    for (int place = 0; place < (is_saccade ? 2 : 1); ++place) {
        const std::optional<double> x_px = number_of(words.next()), y_px = number_of(words.next());
        if (x_px && x_px == y_px)
            if (DoubledNumber* const number = doubled(*x_px))
                ++number->of_events;
    }
}

void ConventionFinder::take_message(std::string_view line) {
    Words words(line);
    words.next(), words.next();
    const std::string_view word = words.next();
    if (word != "DISPLAY_COORDS" && word != "GAZE_COORDS")
        return;
    words.next(), words.next();
    const std::optional<double> right = number_of(words.next()), bottom = number_of(words.next());
    if (right && bottom) {
        width_px_ = std::max(width_px_, *right);
        height_px_ = std::max(height_px_, *bottom);
    }
}

/// The one that most lost samples have: two at least, for one alone may be chance. A file of events alone has
/// none: there it is one off the screen that comes again.
std::optional<double> ConventionFinder::missing_number() const {
    std::optional<double> best;
    std::int64_t most = 1;
    for (const auto& [number, seen] : doubled_) {
        const std::int64_t lost = std::max(seen.without_pupil, seen.with_equal_pupil);
        const std::int64_t votes = !has_samples_                ? (is_off_screen(number) ? seen.of_events : 0)
                                   : 2 * lost >= without_pupil_ ? lost
                                                                : 0;
        if (votes > most) {
            most = votes;
            best = number;
        }
    }
    return best;
}

double ConventionFinder::least_pupil() const {
    if (is_own_export_ || small_pupils_ > pupils_)
        return 0.0;
    // Where nobody has a pupil it was not recorded, unless all samples are lost.
    const std::optional<double> missing = missing_number();
    const auto found = missing ? doubled_.find(*missing) : doubled_.end();
    const std::int64_t lost = found == doubled_.end() ? 0 : found->second.without_pupil;
    return pupils_ == 0 && lost < without_pupil_ ? 0.0 : usual_least_pupil;
}

AscConventions ConventionFinder::found() const {
    AscConventions conventions;
    conventions.missing_number = missing_number();
    std::int64_t most = 1;
    for (const auto& [word, count] : words_)
        if (count > most) {
            most = count;
            conventions.missing_word = word;
        }
    conventions.least_pupil = least_pupil();
    if (steps_ > 0 && steps_us_ > 0)
        conventions.rate_hz = 1e6 * static_cast<double>(steps_) / static_cast<double>(steps_us_);
    for (const double usual_hz : {250.0, 500.0, 1000.0, 2000.0})
        if (std::abs(conventions.rate_hz - usual_hz) < 0.05 * usual_hz)
            conventions.rate_hz = usual_hz;
    conventions.stamps_are_rounded = any_rounded_ && all_rounded_;
    return conventions;
}

} // namespace

AscConventions find_conventions(const AscFiles& files, const std::optional<std::string>& missing,
                                const std::function<void(std::int64_t, std::int64_t)>& progress) {
    ConventionFinder finder;
    files.read_lines([&](std::string_view line) { finder.take(line); }, progress);
    AscConventions conventions = finder.found();
    if (missing) {
        conventions.missing_number = number_of(*missing);
        conventions.missing_word = conventions.missing_number ? std::string() : *missing;
    }
    return conventions;
}

AscPoint place_of(std::string_view x, std::string_view y, const AscConventions& conventions) {
    const auto is_no_place = [&](std::string_view word) {
        return is_missing(word) || (!conventions.missing_word.empty() && word == conventions.missing_word);
    };
    const std::optional<double> x_px = number_of(x), y_px = number_of(y);
    if (is_no_place(x) || is_no_place(y))
        return {(is_no_place(x) || x_px) && (is_no_place(y) || y_px), std::nullopt};
    if (!x_px && !y_px && x == y)
        return {true, std::nullopt};
    if (!x_px || !y_px)
        return {};
    if (std::abs(*x_px) > largest_coordinate_px || std::abs(*y_px) > largest_coordinate_px)
        return {true, std::nullopt};
    if (conventions.missing_number == x_px && x_px == y_px)
        return {true, std::nullopt};
    return {true, ScreenPoint{*x_px, *y_px}};
}

AscEyeValues eye_values(std::string_view x, std::string_view y, std::string_view pupil,
                        const AscConventions& conventions) {
    const AscPoint place = place_of(x, y, conventions);
    const std::optional<double> size = number_of(pupil);
    const bool is_no_size = !size && (is_missing(pupil) || (!place.point && pupil == x));
    AscEyeValues values;
    values.is_valid = place.is_valid && (size || is_no_size) && std::abs(size.value_or(0.0)) <= largest_pupil;
    if (!values.is_valid || !place.point || !size)
        return values;
    values.is_raw = *size < 0.0 && size != conventions.missing_number;
    if (*size < std::max(conventions.least_pupil, 0.0))
        return values;
    values.gaze = place.point;
    values.pupil = static_cast<float>(*size);
    return values;
}

} // namespace overt
