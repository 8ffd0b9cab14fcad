#include "experiment/calibration/own_calibration.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/calibration/drift_from_samples.h"

namespace overt {

namespace {

/// Validation stands at other places than calibration: those of the same layout, drawn towards the middle.
constexpr double validation_shrinks = 0.75;
/// A target appears larger and shrinks to its size, which draws the eye to its middle.
constexpr double appears_larger = 3.0;
constexpr SessionDuration shrinks_for = std::chrono::milliseconds(400);
/// 30 sizes a second look smooth.
constexpr SessionDuration between_steps = std::chrono::milliseconds(33);
/// An eye does not leave for a new target sooner.
constexpr SessionDuration least_latency = std::chrono::milliseconds(100);
/// A target comes again that the fit to the others misses by this much, and by three times the usual.
constexpr double suspicious_deg = 1.5, suspicious_times = 3.0;

ScreenPoint to_even(ScreenPoint place) {
    return {2.0 * std::round(0.5 * place.x_px), 2.0 * std::round(0.5 * place.y_px)};
}

std::size_t index_of(Eye eye) { return static_cast<std::size_t>(eye); }

GazeSample corrected(GazeSample sample, const std::array<GazeFit, 2>& fits) noexcept {
    if (sample.gaze)
        sample.gaze = fits[index_of(sample.eye)](*sample.gaze);
    return sample;
}

} // namespace

std::vector<ScreenPoint> calibration_targets(int points, double area, const ScreenGeometry& screen) {
    // In half widths and heights of the area, x to the right, y down.
    std::vector<glm::dvec2> places;
    if (points == 3)
        places = {{0.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}};
    else
        places = {{0.0, 0.0}, {-1.0, -1.0}, {1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}};
    if (points >= 9)
        places.insert(places.end(), {{0.0, -1.0}, {-1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}});
    if (points >= 13)
        places.insert(places.end(), {{-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}});
    OVERT_EXPECTS(static_cast<int>(places.size()) == points);
    std::vector<ScreenPoint> targets;
    const glm::dvec2 half = 0.5 * area * glm::dvec2(screen.screen_px);
    for (const glm::dvec2& place : places)
        targets.push_back(
            to_even({screen.centre().x_px + half.x * place.x, screen.centre().y_px + half.y * place.y}));
    return targets;
}

std::vector<ScreenPoint> validation_targets(const CalibrationSettings& settings,
                                            const ScreenGeometry& screen) {
    return calibration_targets(settings.validation_points, validation_shrinks * settings.area, screen);
}

CalibratedTracker::CalibratedTracker(std::unique_ptr<EyeTracker> tracker, Clock& clock,
                                     const CalibrationSettings& settings, std::uint64_t seed)
    : tracker_(std::move(tracker)), clock_(&clock), settings_(settings), seed_(seed) {}

std::vector<Eye> CalibratedTracker::eyes() const {
    const TrackerDescription description = tracker_->description();
    return description.both_eyes ? std::vector{Eye::left, Eye::right} : std::vector{description.eye};
}

std::size_t CalibratedTracker::poll(std::span<TrackerItem> into) noexcept {
    const std::size_t taken = tracker_->poll(into);
    const auto correct = [&](std::optional<ScreenPoint>& place, Eye eye) {
        if (place)
            place = fits_[index_of(eye)](*place);
    };
    for (std::size_t i = 0; i < taken; ++i) {
        if (auto* sample = std::get_if<GazeSample>(&into[i]))
            *sample = corrected(*sample, fits_);
        else if (auto* event = std::get_if<TrackerEvent>(&into[i])) {
            correct(event->place, event->eye);
            correct(event->arrival, event->eye);
        }
    }
    return taken;
}

void CalibratedTracker::Corrected::measured(const GazeSample& sample) noexcept {
    listener->measured(corrected(sample, fits));
}

void CalibratedTracker::start_recording() {
    told_.fits = fits_;
    tracker_->start_recording();
}

bool CalibratedTracker::tell_samples_to(SampleListener* listener) {
    told_.listener = listener;
    return tracker_->tell_samples_to(listener ? &told_ : nullptr);
}

DriftOutcome CalibratedTracker::drift_check(ScreenPoint target) {
    return drift_from_samples(*this, *clock_, screen_, target);
}

void CalibratedTracker::reconnect() {
    tracker_->reconnect();
    fits_ = {};
}

void CalibratedTracker::take_samples(std::array<RestingGaze, 2>& eyes) {
    std::array<TrackerItem, 256> items;
    for (std::size_t taken = items.size(); taken == items.size();) {
        taken = poll(items);
        for (std::size_t i = 0; i < taken; ++i)
            if (const auto* sample = std::get_if<GazeSample>(&items[i]))
                eyes[index_of(sample->eye)].take(*sample);
    }
}

CalibratedTracker::Looked CalibratedTracker::look_at(SetupScreen& setup_screen, ScreenPoint target,
                                                     Eyes& found) {
    const RestingGaze::Settings resting{
        std::chrono::duration_cast<TrackerClock::duration>(from_seconds(settings_.fixation_s)),
        Degrees{settings_.fixation_reach_deg}};
    std::array<RestingGaze, 2> eyes_of{RestingGaze(setup_screen.geometry(), resting),
                                       RestingGaze(setup_screen.geometry(), resting)};
    setup_screen.beep(Beep::target_appears);
    const SessionTime onset =
        setup_screen.show_target(target, Degrees{appears_larger * settings_.target_deg});
    const SessionTime latest = onset + from_seconds(settings_.patience_s);
    SessionTime next_step = onset + between_steps;
    bool shrinks = true, is_asked = settings_.accept == TargetAcceptance::fixation;
    while (setup_screen.now() < latest && !setup_screen.is_cancelled() && !tracker_->lost()) {
        const double done = to_seconds(setup_screen.now() - onset) / to_seconds(shrinks_for);
        if (shrinks && setup_screen.now() >= next_step) {
            shrinks = done < 1.0;
            const double factor = appears_larger + (1.0 - appears_larger) * std::min(1.0, done);
            next_step =
                setup_screen.show_target(target, Degrees{factor * settings_.target_deg}) + between_steps;
        } else {
            setup_screen.wait(between_looks);
        }
        while (const std::optional<SetupKey> key = setup_screen.next_key()) {
            if (key->kind == SetupKey::Kind::escape)
                return Looked::cancelled;
            if (key->kind == SetupKey::Kind::backspace)
                return Looked::back;
            is_asked = is_asked || key->kind == SetupKey::Kind::space;
        }
        // Gaze that still rests on the target before is not taken for this one's.
        if (setup_screen.now() < onset + least_latency) {
            std::array<RestingGaze, 2> thrown_away = eyes_of;
            take_samples(thrown_away);
            continue;
        }
        take_samples(eyes_of);
        if (shrinks || !is_asked)
            continue;
        bool all_rest = true;
        for (const Eye eye : eyes()) {
            found[index_of(eye)] = eyes_of[index_of(eye)].rested();
            all_rest = all_rest && found[index_of(eye)];
        }
        if (all_rest)
            return Looked::rested;
    }
    return setup_screen.is_cancelled() || tracker_->lost() ? Looked::cancelled : Looked::missed;
}

bool CalibratedTracker::visit(SetupScreen& setup_screen, std::vector<Visit>& visits,
                              std::vector<std::size_t> order) {
    for (std::size_t i = 0; i < order.size();) {
        Eyes found;
        switch (look_at(setup_screen, visits[order[i]].target, found)) {
        case Looked::cancelled:
            return false;
        case Looked::back:
            i -= i > 0 ? 1 : 0;
            continue;
        case Looked::missed:
            break;
        case Looked::rested:
            visits[order[i]].gaze = found;
            break;
        }
        ++i;
    }
    return true;
}

bool CalibratedTracker::visit_all(SetupScreen& setup_screen, std::vector<Visit>& visits) {
    std::vector<std::size_t> order(visits.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    RandomStream random(seed_, "order of targets", 2 * set_ups_);
    random.shuffle(std::span(order));
    return visit(setup_screen, visits, order);
}

std::vector<CalibrationPair> CalibratedTracker::pairs_of(const std::vector<Visit>& visits, Eye eye) const {
    std::vector<CalibrationPair> pairs;
    for (const Visit& visit : visits)
        if (const std::optional<RestedGaze>& gaze = visit.gaze[index_of(eye)])
            pairs.push_back({gaze->median, visit.target});
    return pairs;
}

std::vector<std::size_t> CalibratedTracker::to_visit_again(const std::vector<Visit>& visits,
                                                           const ScreenGeometry& screen) const {
    std::vector<std::size_t> again;
    for (std::size_t i = 0; i < visits.size(); ++i)
        for (const Eye eye : eyes())
            if (!visits[i].gaze[index_of(eye)])
                again.push_back(i);
    for (const Eye eye : eyes()) {
        std::vector<std::size_t> seen;
        for (std::size_t i = 0; i < visits.size(); ++i)
            if (visits[i].gaze[index_of(eye)])
                seen.push_back(i);
        const std::vector<Degrees> misses = misses_left_out(pairs_of(visits, eye), settings_.model, screen);
        if (misses.empty())
            continue;
        std::vector<Degrees> sorted = misses;
        std::ranges::sort(sorted);
        const double usual = sorted[sorted.size() / 2].value;
        for (std::size_t i = 0; i < misses.size(); ++i)
            if (misses[i].value > std::max(suspicious_deg, suspicious_times * usual))
                again.push_back(seen[i]);
    }
    std::ranges::sort(again);
    again.erase(std::unique(again.begin(), again.end()), again.end());
    return again;
}

ValidationResult CalibratedTracker::result_of(const std::vector<Visit>& visits,
                                              const ScreenGeometry& screen) const {
    ValidationResult result;
    for (const Visit& visit : visits) {
        for (const Eye eye : eyes()) {
            ValidatedTarget target;
            target.eye = eye;
            target.target = visit.target;
            if (const std::optional<RestedGaze>& gaze = visit.gaze[index_of(eye)]) {
                target.gaze = gaze->median;
                target.error = screen.angle_between(gaze->median, visit.target);
                target.rms_s2s = gaze->rms_s2s;
                target.sd = gaze->sd;
            }
            result.targets.push_back(target);
        }
    }
    result.sum_up();
    return result;
}

SetupOutcome CalibratedTracker::set_up(SetupScreen& setup_screen) {
    ++set_ups_;
    screen_ = setup_screen.geometry();
    fits_ = {};
    const auto visits_to = [](const std::vector<ScreenPoint>& targets) {
        std::vector<Visit> visits;
        for (const ScreenPoint target : targets)
            visits.push_back({target, {}});
        return visits;
    };
    const auto ended = [&](SetupOutcome::Kind kind, std::string message) {
        tracker_->stop_recording();
        setup_screen.clear();
        setup_screen.beep(Beep::calibration_bad);
        if (tracker_->lost())
            throw DeviceError("the eye tracker was lost while it was calibrated");
        return SetupOutcome{kind, {}, {}, std::move(message)};
    };
    tracker_->start_recording();
    std::vector<Visit> visits = visits_to(calibration_targets(settings_.points, settings_.area, screen_));
    if (!visit_all(setup_screen, visits))
        return ended(SetupOutcome::Kind::cancelled, "cancelled");
    if (!visit(setup_screen, visits, to_visit_again(visits, screen_)))
        return ended(SetupOutcome::Kind::cancelled, "cancelled");
    std::string method;
    std::size_t rested = 0; // targets of the eye that is fitted
    try {
        Fits fits;
        for (const Eye eye : eyes()) {
            const std::vector<CalibrationPair> pairs = pairs_of(visits, eye);
            rested = pairs.size();
            fits[index_of(eye)] = GazeFit(pairs, settings_.model, screen_);
            method = fmt::format("{} of {} points", fits[index_of(eye)].description(), settings_.points);
        }
        fits_ = fits;
    } catch (const InputError& error) {
        return ended(SetupOutcome::Kind::failed, fmt::format("gaze rested at {} of {} targets: {}", rested,
                                                             settings_.points, error.what()));
    }
    visits = visits_to(validation_targets(settings_, screen_));
    if (!visit_all(setup_screen, visits)) {
        fits_ = {};
        return ended(SetupOutcome::Kind::cancelled, "cancelled in the validation");
    }
    const ValidationResult result = result_of(visits, screen_);
    const auto missed =
        std::ranges::count_if(result.targets, [](const auto& target) { return !target.gaze; });
    if (2 * missed > static_cast<std::ptrdiff_t>(result.targets.size())) {
        fits_ = {};
        return ended(SetupOutcome::Kind::failed,
                     "gaze rested at fewer than half of the validation's targets");
    }
    tracker_->stop_recording();
    setup_screen.clear();
    setup_screen.beep(Beep::calibration_good);
    return {SetupOutcome::Kind::done, result, method,
            missed == 0 ? std::string()
                        : fmt::format("{} of the validation not seen", counted(missed, "target", "targets"))};
}

} // namespace overt
