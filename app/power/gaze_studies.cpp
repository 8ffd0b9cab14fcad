#include "app/power/gaze_studies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/design/schedule.h"
#include "experiment/design/trial_plan.h"
#include "experiment/protocol/all_stimuli.h"

namespace overt {

namespace {

/// Of the search for the outline: rings within the reach, and directions of each.
constexpr int rings = 6, directions = 16;

template <class Entries> int index_of(const Entries& entries, const std::string& id) {
    const auto found = std::ranges::find(entries, id, [](const auto& entry) { return entry.id; });
    return found == entries.end() ? -1 : static_cast<int>(found - entries.begin());
}

ObservedEffect planted(const PowerEffect& effect, const Protocol& protocol, const ObservedScene& scene) {
    ObservedEffect planted;
    SimulatedEffect holds;
    const auto hold_in = [&](const std::string& column, const std::string& level) {
        const auto list = std::ranges::find(stimulus_lists, column, &StimulusList::name);
        if (column == "task")
            planted.task = index_of(protocol.tasks, level);
        else if (list != stimulus_lists.end())
            holds.entries[static_cast<std::size_t>(list - stimulus_lists.begin())] = level;
        else
            holds.where.push_back({column, level, {}});
    };
    hold_in(effect.column, effect.level);
    for (const StudyKey& key : effect.within)
        hold_in(key.column, key.value);
    planted.entries = chosen_by(protocol, holds);
    if (effect.measure == PowerMeasure::area) {
        planted.area = area_in(scene, effect.area);
        OVERT_EXPECTS(planted.area >= 0);
        planted.odds = effect.size;
    }
    if (effect.measure == PowerMeasure::cc)
        planted.spot_share = effect.size;
    return planted;
}

ObservedScene planned_scene(const Experiment& experiment, std::span<const PowerEffect> effects,
                            const GazeStudySettings& settings) {
    const Protocol& protocol = experiment.protocol;
    for (const Object& object : experiment.objects) {
        if (!object.has_mesh())
            throw InputError(fmt::format("object \"{}\" has no mesh, and gaze on it cannot be simulated: "
                                         "give it a mesh, or plan with objects that have one.",
                                         object.id));
    }
    ObservedScene scene = make_observed_scene(protocol, experiment.objects, screen_geometry_of(protocol));
    scene.effects.clear();
    scene.share_sd = settings.head_share_sd;
    for (const PowerEffect& effect : effects) {
        scene.effects.push_back(planted(effect, protocol, scene));
        if (effect.column != "task")
            continue;
        const std::vector<double> same =
            scene.tasks[static_cast<std::size_t>(index_of(protocol.tasks, effect.against))].shares;
        for (ObservedTask& task : scene.tasks)
            if (task.id == effect.level || effect.test == PowerTest::factor)
                task.shares = same;
    }
    return scene;
}

} // namespace

GazeStudySettings gaze_study_settings(const Protocol& protocol) {
    return {protocol.simulated_observers.head_share_sd, protocol.tracker.simulated_accuracy_deg, {}};
}

GazeStudies::GazeStudies(const Experiment& experiment, std::vector<PowerEffect> effects,
                         const GazeStudySettings& settings)
    : experiment_(experiment), factors_(factors_of(experiment.protocol)), effects_(std::move(effects)),
      settings_(settings), scene_(planned_scene(experiment, effects_, settings)), turns_(turns_of(scene_)),
      spread_of_log_(effects_.size(), 0.0) {
    const Protocol& protocol = experiment.protocol;
    for (const ViewedObject& viewed : all_viewed_objects(protocol)) {
        const auto i = static_cast<std::size_t>(viewed.object);
        const Object& shown = experiment.objects[i];
        const SceneView& scene = shown.scene(viewed.view);
        targets_.push_back(std::make_unique<GazeTargets>(scene_.objects[targets_.size()], scene_));
        StudyObject object;
        object.id = shown.id;
        object.part_names = shown.mesh->part_names;
        object.areas = Areas(shown.mesh->part_names);
        object.camera = scene.view.camera;
        object.axis_point = scene.bounds.centre();
        object.screen = scene_.screen;
        ObjectSurface surface;
        surface.scale = object_scale(object.camera, object.axis_point, object.screen,
                                     unit_of_lengths(protocol.objects[i]));
        if (surface.scale) {
            object.mm_per_unit = surface.scale->mm_per_unit;
            object.mm_per_deg = surface.scale->mm_per_deg;
        }
        frame_.objects.push_back(std::move(object));
        surfaces_.push_back(std::move(surface));
    }
    for (const Factor& factor : factors_.all())
        for (const FactorLevel& level : factor.levels)
            levels_[factor.name].push_back(level.name);
}

void GazeStudies::plant_spread(std::size_t effect, double spread, double of_log) {
    scene_.effects[effect].spread = spread;
    spread_of_log_[effect] = of_log;
}

/// The scene with this observer's own effects.
ObservedScene GazeStudies::scene_of(std::uint64_t observer_seed) const {
    ObservedScene scene = scene_;
    for (std::size_t i = 0; i < effects_.size(); ++i) {
        if (!(effects_[i].sd > 0.0))
            continue;
        const double own = effects_[i].sd * RandomStream(observer_seed, "effect on an observer", i).normal();
        ObservedEffect& effect = scene.effects[i];
        if (effects_[i].measure == PowerMeasure::area)
            effect.odds *= std::exp(own);
        else if (effects_[i].measure == PowerMeasure::wss)
            effect.spread += own * spread_of_log_[i];
        else
            effect.spot_share = std::clamp(effect.spot_share + own, 0.0, 1.0);
    }
    return scene;
}

StudyResults GazeStudies::study(std::uint64_t seed, int observers,
                                const std::function<bool(const Trial&)>& wanted) const {
    const Protocol& protocol = experiment_.protocol;
    StudyResults results = frame_;
    ScheduleMaker schedules(protocol);
    GazeScript script(scene_, observer_);
    const int digits = observers > 99 ? 3 : 2;
    for (int number = 1; number <= observers; ++number) {
        RandomStream seeds(seed, "seeds of observers", static_cast<std::uint64_t>(number));
        const std::uint64_t high = seeds.next_bits(), own = high << 32 | seeds.next_bits();
        StudySession session;
        session.observer = fmt::format("{:0{}}", number, digits);
        results.sessions.push_back(std::move(session));
        const ObservedScene planned = scene_of(own);
        for (const Trial& trial : schedules.make({results.sessions.back().observer, number}, own).trials) {
            const std::vector<LookedAt> shows = shows_of(trial, own, planned, script);
            for (int place = 0; place < static_cast<int>(trial.shown_count()); ++place)
                if (!wanted || wanted(trial.only({place})))
                    add_presentation(trial, place, own, shows, results);
        }
    }
    return results;
}

std::vector<GazeStudies::LookedAt> GazeStudies::shows_of(const Trial& trial, std::uint64_t seed,
                                                         const ObservedScene& planned,
                                                         GazeScript& script) const {
    std::vector<LookedAt> shows;
    const auto add = [&](const std::vector<int>& places, SessionDuration begin, SessionDuration end) {
        LookedAt show{places, begin, end, {}, {}};
        for (const int place : places) {
            const auto [stimulus, slot] = trial.shown(static_cast<std::size_t>(place));
            show.shown.push_back({targets_[scene_.index_of({stimulus, slot})].get(),
                                  scene_.screen_of_slot(slot), gaze_plan(planned, seed, trial.task, stimulus),
                                  &turns_[static_cast<std::size_t>(stimulus.motion)], nullptr, slot});
        }
        script.compose(scene_, show.shown, observer_, seed,
                       script_number(trial.index, static_cast<int>(shows.size())));
        show.fixations = script.fixations();
        shows.push_back(std::move(show));
    };
    const Protocol& protocol = experiment_.protocol;
    if (protocol.tasks[static_cast<std::size_t>(trial.task)].steps.empty()) {
        std::vector<int> all(trial.shown_count());
        std::iota(all.begin(), all.end(), 0);
        add(all, {}, from_seconds(protocol.motion_of(trial.stimulus).duration_s));
        return shows;
    }
    SessionDuration now{};
    for (const PlannedStep& step : plan_trial(protocol, seed, trial, false).steps) {
        const bool lights = step.kind == StepKind::show && !step.places.empty();
        if (!lights && shows.empty())
            continue; // before the first
        const SessionDuration end = now + from_seconds(step.drawn_s.value_or(0.0));
        if (lights)
            add(step.places, now, end);
        now = end;
    }
    return shows;
}

void GazeStudies::add_presentation(const Trial& trial, int place, std::uint64_t seed,
                                   const std::vector<LookedAt>& shows, StudyResults& results) const {
    const Trial seen = trial.only({place});
    const std::size_t object = scene_.index_of(seen.shown(0));
    StudyTrial shown;
    shown.session = static_cast<int>(results.sessions.size()) - 1;
    shown.object = static_cast<int>(object);
    shown.number = trial.index + 1;
    shown.keys = {{"observer", results.sessions.back().observer}};
    for (const Factor& factor : factors_.all())
        if (!factor.levels.empty())
            shown.keys.push_back(
                {factor.name, factor.levels[static_cast<std::size_t>(factors_.level_of(factor, seen))].name});
    shown.first_fixation = results.fixations.size();

    RandomStream random(seed, "calibration offset", static_cast<std::uint64_t>(trial.index));
    const double x = random.normal(), y = random.normal();
    const glm::dvec2 offset_px =
        settings_.accuracy_deg * glm::dvec2(x, y) * px_per_deg_at_centre(scene_.screen);
    std::optional<SessionDuration> onset;
    for (const LookedAt& show : shows) {
        const auto lit = std::ranges::find(show.places, place);
        if (lit == show.places.end())
            continue;
        const ObservedPresentation& on = show.shown[static_cast<std::size_t>(lit - show.places.begin())];
        onset = onset.value_or(show.onset);
        shown.presentation_s = to_seconds(show.end - *onset);
        const SessionDuration lasts = show.end - show.onset;
        for (const ScriptedFixation& fixation : show.fixations) {
            // The first was under way at the onset.
            if (fixation.begin <= SessionDuration{} || fixation.begin >= lasts)
                continue;
            const SessionDuration until = std::min(fixation.end, lasts),
                                  middle = (fixation.begin + until) / 2;
            const ScreenPoint meant = place_of(fixation, middle, show.shown);
            const ScreenPoint gaze{meant.x_px + offset_px.x, meant.y_px + offset_px.y};
            // Of several slots gaze belongs to the one in whose image it lies.
            if (trial.shown_count() > 1 && !on.screen.is_inside_image(on.screen.image_from_screen(gaze)))
                continue;
            StudyFixation found =
                fixation_at(on, object, gaze, on.turn->angle_at(middle - fixation.light_delay));
            found.trial = static_cast<int>(results.trials.size());
            found.onset_s = to_seconds(show.onset - *onset + fixation.begin);
            found.duration_s = to_seconds(until - fixation.begin);
            results.fixations.push_back(found);
        }
    }
    shown.fixations = results.fixations.size() - shown.first_fixation;
    results.trials.push_back(std::move(shown));
}

StudyFixation GazeStudies::fixation_at(const ObservedPresentation& on, std::size_t object, ScreenPoint gaze,
                                       const ObjectPose& angle) const {
    StudyFixation found;
    found.place = gaze;
    const std::optional<SurfacePoint> point =
        surface_near(*on.targets, on.screen, on.screen.image_from_screen(gaze), angle);
    if (!point) {
        found.why = NotCounted::not_on_surface;
        return found;
    }
    found.triangle = point->triangle;
    found.barycentric = point->barycentric;
    found.position = point->position;
    found.part = point->part;
    found.on_surface = 1.0;
    if (const auto& scale = surfaces_[object].scale)
        found.sigma_mm = sigma_mm(settings_.sigma, *scale, point->depth);
    return found;
}

/// What is under the gaze, or nearest to it within the mean error of a validation: of two normal errors, that
/// is the root of pi / 2 times their standard deviation.
std::optional<SurfacePoint> GazeStudies::surface_near(const GazeTargets& targets,
                                                      const ScreenGeometry& screen, glm::dvec2 image,
                                                      const ObjectPose& angle) const {
    const auto at = [&](glm::dvec2 place) {
        return screen.is_inside_image(place) ? targets.surface_at(place, angle) : std::nullopt;
    };
    if (std::optional<SurfacePoint> point = at(image))
        return point;
    const glm::dvec2 reach_px =
        settings_.accuracy_deg * std::sqrt(0.5 * std::numbers::pi) * px_per_deg_at_centre(scene_.screen);
    for (int ring = 1; ring <= rings; ++ring) {
        for (int i = 0; i < directions; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / directions;
            const glm::dvec2 off =
                static_cast<double>(ring) / rings * reach_px * glm::dvec2(std::cos(turn), std::sin(turn));
            if (std::optional<SurfacePoint> point = at(image + off))
                return point;
        }
    }
    return std::nullopt;
}

} // namespace overt
