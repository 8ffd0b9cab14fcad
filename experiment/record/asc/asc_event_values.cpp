#include "experiment/record/asc/asc_event_values.h"

#include <array>

#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

constexpr std::size_t values_of_fixation = 3, values_of_saccade = 6;

class EventWords {
  public:
    EventWords(std::string_view rest, const AscConventions& conventions) : conventions_(conventions) {
        bool are_words = rest.find('\t') == std::string_view::npos;
        for (Columns columns(rest); !are_words && !columns.are_over() && count_ < words_.size();) {
            words_[count_++] = columns.next();
            // More numbers than one: the line has blanks between its values.
            const std::string_view first = Words(words_[count_ - 1]).next();
            are_words = first.size() < words_[count_ - 1].size() && number_of(first);
        }
        if (!are_words)
            return;
        count_ = 0;
        Words words(rest);
        for (std::string_view word = words.next(); !word.empty() && count_ < words_.size();
             word = words.next())
            words_[count_++] = word;
    }

    std::size_t count() const { return count_; }
    int unreadable() const { return unreadable_; }
    void skip(std::size_t values) { next_ += values; }

    std::optional<ScreenPoint> place() {
        const AscPoint place = place_of(words_[next_], words_[next_ + 1], conventions_);
        next_ += 2;
        unreadable_ += !place.is_valid;
        return place.point;
    }
    /// Of what cannot be less than 0. `is_known`: else it is missing, whatever stands there.
    std::optional<double> size(bool is_known) {
        const std::string_view word = words_[next_++];
        const std::optional<double> number = number_of(word);
        unreadable_ += !number && !is_missing(word) && word != conventions_.missing_word;
        return is_known && number >= 0.0 ? number : std::nullopt;
    }
    /// The same of a number that may be the file's missing one if its event's place is missing.
    std::optional<double> size_beside(const std::optional<ScreenPoint>& place) {
        const std::optional<double> number = size(true);
        return !place && number == conventions_.missing_number ? std::nullopt : number;
    }

  private:
    const AscConventions& conventions_;
    std::array<std::string_view, 2 * values_of_saccade> words_;
    std::size_t count_ = 0, next_ = 0;
    int unreadable_ = 0;
};

} // namespace

AscEventValues read_event_values(std::string_view rest, bool are_gaze, const AscConventions& conventions,
                                 GazeEvent& event) {
    if (event.kind == GazeEvent::Kind::blink)
        return {true};
    const bool is_fixation = event.kind == GazeEvent::Kind::fixation;
    const std::size_t values = is_fixation ? values_of_fixation : values_of_saccade;
    EventWords words(rest, conventions);
    if (words.count() < values)
        return {};
    const bool gaze_follows = !are_gaze && words.count() >= 2 * values;
    if (gaze_follows)
        words.skip(values);
    event.place = words.place();
    if (is_fixation) {
        event.pupil = words.size_beside(event.place);
    } else {
        event.arrival = words.place();
        // Of what it does not know edf2asc reckons millions of degrees.
        event.amplitude_deg = words.size(event.place && event.arrival);
        event.peak_velocity_deg_s = words.size_beside(event.place);
    }
    if (!are_gaze && !gaze_follows)
        event.place = event.arrival = std::nullopt;
    return {true, are_gaze || gaze_follows, words.unreadable()};
}

} // namespace overt
