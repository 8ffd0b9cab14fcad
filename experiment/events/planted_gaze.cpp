#include "experiment/events/planted_gaze.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "experiment/base/random.h"
#include "experiment/events/main_sequence.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

constexpr double farthest_deg = 8.0;  ///< of fixations from the middle, to each side
constexpr double lid_s = 0.03;        ///< for which the lid moves
constexpr double lid_shift_deg = 3.0; ///< by which it draws the measured gaze down
constexpr double pursuit_turn_deg = 2.0;

/// A time in which the eye does one thing.
struct Part {
    double begin_s = 0.0, end_s = 0.0;
    glm::dvec2 from_deg{0.0}, to_deg{0.0};
    enum class Of : unsigned char { fixation, saccade, lid_down, lost, lid_up } of = Of::fixation;
};

class Planter {
  public:
    Planter(const PlantedGazeSettings& settings, const ScreenGeometry& screen)
        : settings_(settings), screen_(screen), random_(settings.seed, "planted gaze") {}

    PlantedGaze plant() {
        plan();
        sample();
        for (std::size_t begin = 0; begin < parts_.size();)
            begin = add_events(begin);
        std::stable_sort(planted_.events.begin(), planted_.events.end(),
                         [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });
        return std::move(planted_);
    }

  private:
    void append(Part::Of of, double lasts_s, glm::dvec2 to_deg) {
        const double begin_s = parts_.empty() ? 0.0 : parts_.back().end_s;
        const glm::dvec2 from_deg = parts_.empty() ? to_deg : parts_.back().to_deg;
        parts_.push_back({begin_s, begin_s + lasts_s, from_deg, to_deg, of});
    }

    void plan() {
        const double blink_chance =
            settings_.blinks_per_minute / 60.0 * 0.4; // a fixation and a saccade last 0.4 s
        append(Part::Of::fixation, random_.uniform(0.15, 0.6), glm::dvec2(0.0));
        while (parts_.back().end_s < settings_.duration_s) {
            if (random_.uniform() < blink_chance) {
                append(Part::Of::lid_down, lid_s, parts_.back().to_deg);
                append(Part::Of::lost, random_.uniform(0.1, 0.2), parts_.back().to_deg);
                append(Part::Of::lid_up, lid_s, parts_.back().to_deg);
            } else {
                const glm::dvec2 to_deg = next_place(parts_.back().to_deg);
                const double amplitude_deg = glm::length(to_deg - parts_.back().to_deg);
                append(Part::Of::saccade, to_seconds(saccade_duration({amplitude_deg})), to_deg);
            }
            append(Part::Of::fixation, random_.uniform(0.15, 0.6), parts_.back().to_deg);
        }
    }

    glm::dvec2 next_place(glm::dvec2 from_deg) {
        for (;;) {
            const double amplitude_deg =
                random_.uniform(settings_.shortest_saccade_deg, settings_.longest_saccade_deg);
            const double turn = random_.uniform(0.0, 2.0 * std::numbers::pi);
            const glm::dvec2 to_deg = from_deg + amplitude_deg * glm::dvec2(std::cos(turn), std::sin(turn));
            if (std::max(std::abs(to_deg.x), std::abs(to_deg.y)) <= farthest_deg)
                return to_deg;
        }
    }

    /// Where the pursued target is at a time, from where it would be if it stood still: to and fro at one
    /// speed.
    double pursued_deg(double at_s) const {
        if (settings_.pursuit_deg_s <= 0.0)
            return 0.0;
        const double period_s = 4.0 * pursuit_turn_deg / settings_.pursuit_deg_s;
        const double phase = at_s / period_s - std::floor(at_s / period_s);
        return pursuit_turn_deg * (phase < 0.5 ? 4.0 * phase - 1.0 : 3.0 - 4.0 * phase);
    }

    ScreenPoint place_of(glm::dvec2 gaze_deg) const {
        const auto px = [&](double deg, int axis) {
            return std::tan(to_radians({deg}).value) * screen_.viewing_distance_mm * screen_.screen_px[axis] /
                   screen_.screen_mm[axis];
        };
        return {screen_.centre().x_px + px(gaze_deg.x, 0), screen_.centre().y_px + px(gaze_deg.y, 1)};
    }

    GazeSample measured(const Part& part, double at_s) {
        const double share = (at_s - part.begin_s) / (part.end_s - part.begin_s);
        GazeSample sample;
        sample.eye = settings_.eye;
        if (part.of == Part::Of::lost)
            return sample;
        glm::dvec2 gaze_deg = part.to_deg;
        if (part.of == Part::Of::saccade)
            gaze_deg = part.from_deg + saccade_progress(share) * (part.to_deg - part.from_deg);
        if (part.of == Part::Of::lid_down || part.of == Part::Of::lid_up)
            gaze_deg.y +=
                lid_shift_deg * saccade_progress(part.of == Part::Of::lid_down ? share : 1.0 - share);
        gaze_deg.x += pursued_deg(at_s);
        gaze_deg += settings_.noise_deg * glm::dvec2(random_.normal(), random_.normal());
        sample.gaze = place_of(gaze_deg);
        sample.pupil_area = 1000.0f;
        return sample;
    }

    void sample() {
        const auto count = static_cast<std::size_t>(settings_.duration_s * settings_.rate_hz);
        const double most_jitter_s = 0.1 / settings_.rate_hz;
        std::size_t part = 0;
        for (std::size_t n = 0; n < count; ++n) {
            double at_s = static_cast<double>(n) / settings_.rate_hz;
            at_s += std::clamp(settings_.jitter_s * random_.normal(), -most_jitter_s, most_jitter_s);
            while (part + 1 < parts_.size() && at_s >= parts_[part].end_s)
                ++part;
            GazeSample taken = measured(parts_[part], at_s);
            taken.sampled_at = tracker_time(std::llround(1e6 * (1.0 + at_s)));
            planted_.samples.push_back(taken);
            parts_of_samples_.push_back(part);
        }
    }

    /// From the first to the last sample of the parts begin … end - 1.
    void add(Kind kind, std::size_t begin, std::size_t end) {
        const auto first = std::lower_bound(parts_of_samples_.begin(), parts_of_samples_.end(), begin) -
                           parts_of_samples_.begin();
        const auto behind = std::lower_bound(parts_of_samples_.begin(), parts_of_samples_.end(), end) -
                            parts_of_samples_.begin();
        if (first == behind)
            return;
        GazeEvent event;
        event.kind = kind;
        event.eye = settings_.eye;
        event.start = planted_.samples[static_cast<std::size_t>(first)].sampled_at;
        event.end = planted_.samples[static_cast<std::size_t>(behind) - 1].sampled_at;
        event.duration =
            event.end - event.start + tracker_time(std::llround(1e6 / settings_.rate_hz)).time_since_epoch();
        if (kind == Kind::fixation)
            event.place = place_of(parts_[begin].to_deg);
        if (kind == Kind::saccade) {
            event.place = place_of(parts_[begin].from_deg);
            event.arrival = place_of(parts_[end - 1].to_deg);
            event.amplitude_deg = screen_.angle_between(*event.place, *event.arrival).value;
        }
        planted_.events.push_back(event);
    }

    /// Gives the part after it.
    std::size_t add_events(std::size_t begin) {
        if (parts_[begin].of == Part::Of::lid_down) {
            add(Kind::saccade, begin, begin + 3);
            add(Kind::blink, begin + 1, begin + 2);
            return begin + 3;
        }
        add(parts_[begin].of == Part::Of::saccade ? Kind::saccade : Kind::fixation, begin, begin + 1);
        return begin + 1;
    }

    PlantedGazeSettings settings_;
    ScreenGeometry screen_;
    RandomStream random_;
    std::vector<Part> parts_;
    std::vector<std::size_t> parts_of_samples_; ///< by their number, never less than the one before it
    PlantedGaze planted_;
};

} // namespace

PlantedGaze plant_gaze(const PlantedGazeSettings& settings, const ScreenGeometry& screen) {
    return Planter(settings, screen).plant();
}

} // namespace overt
