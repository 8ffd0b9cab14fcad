#include "experiment/checks/design_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "experiment/checks/design_balance.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/observer_groups.h"
#include "experiment/design/schedule.h"
#include "experiment/design/trial_plan.h"
#include "experiment/design/trial_queue.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/stimulus/frame_memory.h"

namespace overt {

namespace {

std::vector<AnimationFacts::Recording> recordings_in(const MotionSettings& motion) {
    std::vector<AnimationFacts::Recording> recordings;
    for (const std::string_view whose : whose_courses(motion.courses)) {
        AnimationFacts::Recording& recording =
            recordings.emplace_back(std::string(whose), 0, std::numeric_limits<double>::infinity(), 0.0);
        std::set<int> trials;
        for (const RecordedCourse& course : motion.courses) {
            if (course.whose != whose)
                continue;
            trials.insert(course.trial);
            recording.shortest_s = std::min(recording.shortest_s, course.lasts_s);
            recording.longest_s = std::max(recording.longest_s, course.lasts_s);
        }
        recording.trials = static_cast<int>(trials.size());
    }
    return recordings;
}

AnimationFacts animation_facts(const Protocol& protocol, const MotionSettings& animation) {
    const PageCycle cycle = make_page_cycle(animation, protocol.display.refresh_hz);
    AnimationFacts facts;
    facts.id = animation.id;
    facts.motion = animation;
    facts.frames = animation.frame_count;
    facts.distinct_poses = static_cast<int>(animation.pictures().size());
    facts.shown_frames = animation.shown_frame_count();
    facts.refreshes_per_frame = refreshes_per_frame(animation.frame_rate_hz, protocol.display.refresh_hz);
    facts.refreshes = cycle.total_refreshes;
    facts.duration_s = cycle.total_refreshes / protocol.display.refresh_hz;
    facts.periods = static_cast<double>(facts.shown_frames) / animation.steps_per_period();
    facts.recordings = recordings_in(animation);
    return facts;
}

VisualAngles visual_angles(const Protocol& protocol) {
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const ScreenPoint centre = geometry.centre();
    /// Of an area, along its middle row and its middle column.
    const auto size_deg = [&](ScreenPoint middle, glm::dvec2 px) {
        const glm::dvec2 half = 0.5 * px;
        const auto& [x, y] = middle;
        return glm::dvec2(geometry.angle_between({x - half.x, y}, {x + half.x, y}).value,
                          geometry.angle_between({x, y - half.y}, {x, y + half.y}).value);
    };
    const glm::dvec2 image_px(geometry.image_px), screen = size_deg(centre, geometry.screen_px);
    const ScreenPoint middle = geometry.screen_from_image(0.5 * image_px);
    const glm::dvec2 image = size_deg(middle, image_px);
    VisualAngles angles;
    angles.screen_width_deg = screen.x;
    angles.screen_height_deg = screen.y;
    angles.image_width_deg = image.x;
    angles.image_height_deg = image.y;
    angles.image_right_deg = std::copysign(geometry.angle_between(centre, {middle.x_px, centre.y_px}).value,
                                           middle.x_px - centre.x_px);
    angles.image_up_deg = std::copysign(geometry.angle_between(centre, {centre.x_px, middle.y_px}).value,
                                        centre.y_px - middle.y_px);
    // The camera stands before the middle of its picture, wherever that is shown.
    angles.camera_fov_deg = protocol.views.front().vertical_fov_deg.value_or(size_deg(centre, image_px).y);
    angles.px_per_deg = geometry.px_per_deg_at_centre();
    return angles;
}

/// What a trial by steps adds to a session: steps as they are drawn for it, gaze that comes at once, and
/// words and answers as long as is assumed of all.
void add_steps(SessionLength& length, const Protocol& protocol, const TrialPlan& plan, double question_s,
               double answer_s) {
    bool was_watched = false;
    for (const PlannedStep& step : plan.steps) {
        const double drawn_s = step.drawn_s.value_or(step.gaze() ? step.gaze()->for_s : 0.0);
        const double own_s = step.ends_by_answer() ? std::min(drawn_s, answer_s) : drawn_s;
        if (step.is_watched) {
            length.animations_s += own_s + (was_watched ? 0.0 : 2.0 * protocol.screens.recording_lead_s);
        } else if (step.kind == StepKind::text) {
            length.questions_s += step.drawn_s.value_or(question_s);
        } else if (step.kind == StepKind::drift_check) {
            length.drift_checks_s += protocol.screens.drift_target_s;
        } else if (step.kind == StepKind::answer) {
            length.answers_s += std::min(answer_s, step.drawn_s.value_or(answer_s));
        } else {
            length.animations_s += own_s;
        }
        was_watched = step.is_watched;
    }
}

/// Of the observer with these trials, if nothing fails.
SessionLength session_length(const Protocol& protocol, const Schedule& schedule,
                             std::span<const AnimationFacts> motions, const DesignAssumptions& assumptions) {
    const ScreenSettings& screens = protocol.screens;
    const double question_s = std::max(screens.task_min_s, assumptions.question_s);
    const auto shown_s = [&](const SessionStep& step) {
        return motions[static_cast<std::size_t>(step.trial.stimulus.motion)].duration_s +
               2.0 * screens.recording_lead_s;
    };
    const double answer_s = std::clamp(assumptions.answer_s, screens.response_min_s, screens.response_max_s);
    SessionLength length;
    length.calibration_s = assumptions.calibration_s;
    // What is read before the first trial: consent, and the pages of [instructions].
    length.instructions_s = assumptions.text_s * static_cast<double>(protocol.instructions.pages.size() +
                                                                     (protocol.consent.text.empty() ? 0 : 1));
    TrialQueue queue(protocol, schedule);
    while (const std::optional<SessionStep> step = queue.next()) {
        switch (step->kind) {
        case SessionStep::Kind::feedback:
        case SessionStep::Kind::instructions:
            length.instructions_s += assumptions.text_s;
            break;
        case SessionStep::Kind::practice:
            length.practice_s += question_s + screens.drift_target_s + shown_s(*step) + answer_s;
            if (!protocol.practice[static_cast<std::size_t>(step->trial.index)].feedback.empty())
                length.practice_s += assumptions.question_s;
            break;
        case SessionStep::Kind::pause:
            // No key ends a self-paced one before its least time.
            length.breaks_s += protocol.breaks.pace == BreakPace::self
                                   ? std::max(protocol.breaks.duration_s, protocol.breaks.min_s)
                                   : protocol.breaks.duration_s;
            ++length.breaks;
            break;
        case SessionStep::Kind::trial:
            if (!protocol.tasks[static_cast<std::size_t>(step->trial.task)].steps.empty()) {
                add_steps(length, protocol, plan_trial(protocol, schedule.seed, step->trial, false),
                          question_s, answer_s);
                queue.tell({});
                break;
            }
            length.questions_s += question_s;
            length.drift_checks_s += screens.drift_target_s;
            length.animations_s += shown_s(*step);
            length.answers_s += answer_s;
            queue.tell({});
            break;
        }
    }
    return length;
}

MemoryNeed memory_need(const Protocol& protocol) {
    constexpr double bytes_per_map_px = 4.0; // a triangle's number
    MemoryNeed need;
    need.pages_per_stimulus_bytes = most_pages(protocol) * page_bytes(protocol);
    const int at_once = protocol.slots.size() > 1 ? most_stimuli_at_once(protocol) : 1;
    need.next_fits = 2.0 * at_once * need.pages_per_stimulus_bytes <= 1e6 * protocol.display.frame_store_mb;
    for (std::size_t motion = 0; motion < protocol.motions.size(); ++motion)
        if (is_streamed(protocol, static_cast<int>(motion)))
            need.streamed_pages_kept = pages_with_room(protocol);
    const ViewSettings& view = protocol.views.front();
    need.maps_per_object_bytes =
        bytes_per_map_px * poses_of(protocol).count() * view.width_px * view.height_px;
    return need;
}

std::string order_in_words(const BlockSettings& block) {
    std::string words(name_of(block.order));
    if (block.order == OrderMethod::blocked)
        words += fmt::format(" by {}, levels {}", block.by, name_of(block.levels));
    if (block.order == OrderMethod::weighted)
        words += fmt::format(" by {}{}", block.by, block.draws ? ", drawn with replacement" : "");
    if (block.repetitions > 1)
        words += fmt::format(", {} times{}", block.repetitions,
                             block.repetition_order == RepetitionOrder::mixed ? ", mixed" : "");
    if (block.continues)
        words += ", with the block before";
    return words;
}

/// What the planned observers have: trials, blocks, groups.
void add_observers(DesignReport& report, const Protocol& protocol) {
    for (const BlockSettings& block : protocol.blocks)
        report.blocks.push_back(block.id);
    for (int block = 0; block < block_count(protocol); ++block)
        report.block_facts.push_back(
            {block_at(protocol, block).id, order_in_words(block_at(protocol, block)), 0});
    for (const GroupSettings& group : protocol.groups)
        report.groups.push_back({group.id, group.cap, 0, 0});
    report.fewest_trials = std::numeric_limits<int>::max();
    for (const Observer& observer : planned_observers(protocol)) {
        int trials = 0;
        for (const BlockPlan& plan : block_plans(protocol, observer.number, 0)) {
            const int length = length_of(protocol, plan);
            BlockFacts& facts = report.block_facts[static_cast<std::size_t>(plan.block)];
            facts.trials = std::max(facts.trials, length);
            trials += length;
        }
        report.trials_per_observer = std::max(report.trials_per_observer, trials);
        report.fewest_trials = std::min(report.fewest_trials, trials);
        if (const int group = group_place(protocol, observer.number).group; group >= 0) {
            GroupFacts& facts = report.groups[static_cast<std::size_t>(group)];
            ++facts.observers;
            facts.trials = trials;
        }
    }
}

/// The observer who sits longest, among those who differ.
SessionLength longest_session(const Protocol& protocol, ScheduleMaker& maker, std::uint64_t seed,
                              std::span<const AnimationFacts> motions, const DesignAssumptions& assumptions) {
    SessionLength longest;
    const std::size_t different = std::max<std::size_t>(1, protocol.groups.size());
    std::vector<Observer> observers = planned_observers(protocol);
    observers.resize(std::min(observers.size(), different));
    for (const Observer& observer : observers) {
        const SessionLength length =
            session_length(protocol, maker.make(observer, seed), motions, assumptions);
        if (length.total_s() > longest.total_s())
            longest = length;
    }
    return longest;
}

} // namespace

std::vector<Observer> planned_observers(const Protocol& protocol) {
    std::vector<Observer> observers;
    // More than the caps of the groups take there cannot be.
    const int count =
        std::min(protocol.schedule.observers, group_capacity(protocol).value_or(protocol.schedule.observers));
    for (int number = 1; number <= count; ++number)
        observers.push_back({fmt::format("{:02}", number), number});
    return observers;
}

DesignReport make_design_report(const Protocol& protocol, const std::vector<Observer>& observers,
                                std::uint64_t example_seed, const DesignAssumptions& assumptions,
                                bool takes_seed) {
    DesignReport report;
    report.name = protocol.name;
    report.title = protocol.title;
    report.tasks = ids_of(protocol.tasks);
    report.objects = ids_of(protocol.objects);
    report.materials = ids_of(protocol.materials);
    report.factors = factors_of(protocol);
    add_observers(report, protocol);
    report.practice_trials = static_cast<int>(protocol.practice.size());
    report.observers = protocol.schedule.observers;
    report.slots = ids_of(protocol.slots);
    report.display = protocol.display;
    report.view = protocol.views.front();
    report.stereo = protocol.stereo;
    for (const Slot& slot : protocol.slots)
        if (slot.entry >= 0)
            report.slot_places.push_back({slot.id, slot_geometry(protocol, slot)});
    for (const MotionSettings& motion : protocol.motions)
        report.motions.push_back(animation_facts(protocol, motion));
    report.angles = visual_angles(protocol);
    report.assumptions = assumptions;
    report.is_seed_fixed = protocol.schedule.seed.has_value() && !takes_seed;
    report.is_seed_given = takes_seed;
    const std::uint64_t seed = takes_seed ? example_seed : protocol.schedule.seed.value_or(example_seed);
    ScheduleMaker maker(protocol);
    report.session = longest_session(protocol, maker, seed, report.motions, assumptions);
    const SessionLength& length = report.session;
    report.trials = design_in_words(
        protocol, (length.questions_s + length.drift_checks_s + length.animations_s + length.answers_s) /
                      std::max(1, report.trials_per_observer));
    report.memory = memory_need(protocol);
    const Presentations presentations = count_presentations(protocol, maker, seed);
    report.incidence = presentations.cells;
    for (const Observer& observer : observers) {
        report.schedules.push_back(maker.make(observer, seed));
        if (const int group = group_place(protocol, observer.number).group; group >= 0)
            report.schedule_groups.push_back(protocol.groups[static_cast<std::size_t>(group)].id);
    }
    report.warnings = balance_warnings(protocol, presentations);
    for (std::string& warning : aliased_factor_warnings(report.factors, presentations))
        report.warnings.push_back(std::move(warning));
    report.rotations = rotation_facts(protocol);
    for (std::string& warning : rotation_warnings(report.rotations))
        report.warnings.push_back(std::move(warning));
    if (std::any_of(report.schedules.begin(), report.schedules.end(),
                    [](const Schedule& schedule) { return !schedule.is_even; }))
        report.warnings.emplace_back(
            "the limits leave too many orders to count and too few to meet by chance: they are "
            "kept, but orders come from a chain of random exchanges and are only nearly equally "
            "probable");
    return report;
}

} // namespace overt
